// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#include "eval/results/scene_counts.hpp"
#include "tests/eval/lab/tiny_experiment.hpp"
#include "tests/support/expect_error.hpp"

namespace mapscore::eval {
namespace {

using mapscore::testing::expect_error;
using mapscore::testing::TemporaryFolder;
using testing::study_of;

TEST(StudyStore, GivesBackTheStudyAndItsTable) {
  const TemporaryFolder folder;
  ResultStore store = ResultStore::open(folder.path() / "results.sqlite");
  Study study = study_of("sweep: {faults.misregistration.magnitude_m: [0, 0.01]}\nseeds: 2\n");
  study.base_folder = folder.path() / "configs";
  const ClassTable table = mapscore::testing::tiny_info().table;
  write_study(store, {study, table, "hash", "recordings/tiny"}, folder.path());
  const StudyRecord record = read_study(store, folder.path());
  EXPECT_EQ(to_yaml(record.study), to_yaml(study));
  EXPECT_EQ(std::filesystem::path(record.study.base_folder).lexically_normal(),
            study.base_folder.lexically_normal());
  EXPECT_EQ(record.recording_hash, "hash");
  EXPECT_EQ(record.recording, "recordings/tiny");
  ASSERT_EQ(record.table.classes.size(), table.classes.size());
  for (std::size_t i = 0; i < table.classes.size(); ++i) {
    EXPECT_EQ(record.table.classes[i].name, table.classes[i].name);
    EXPECT_EQ(record.table.classes[i].detect, table.classes[i].detect);
    EXPECT_EQ(record.table.classes[i].colour.r, table.classes[i].colour.r);
  }
  ASSERT_EQ(record.table.instances.size(), table.instances.size());
  EXPECT_EQ(record.table.class_of(2), table.class_of(2));
}

TEST(StudyStore, OpensTheRecordingOfTheTrialsAndNoOther) {
  const TemporaryFolder folder;
  mapscore::testing::write_tiny_recording(folder.path() / "tiny");
  StudyRecord record;
  record.recording = "../tiny";
  record.recording_hash = Recording::open(folder.path() / "tiny").content_hash();
  EXPECT_EQ(recording_of(record, folder.path() / "results").content_hash(), record.recording_hash);
  record.recording_hash = "another";
  expect_error("is another recording than that of the study's trials",
               [&] { (void)recording_of(record, folder.path() / "results"); });
}

ClassTable table_of(const std::vector<std::string>& names) {
  ClassTable table;
  for (const std::string& name : names)
    table.classes.push_back({static_cast<ClassId>(table.classes.size()), name, {}, true});
  return table;
}

Study two_scenes() {
  return parse_study(
      "methods: {direct: {segmentation: {direct: {}}}}\n"
      "scenes: {home: {recording: a}, hall: {recording: b}}\n",
      "study.yaml");
}

TEST(StudyStore, ScenesHaveTheClassesOfAllByTheirNames) {
  const TemporaryFolder folder;
  ResultStore store = ResultStore::open(folder.path() / "results.sqlite");
  const StudyRecord written =
      record_of(two_scenes(), {{{"home", "h1", "a", {}}, table_of({"cup", "chair"})},
                               {{"hall", "h2", "b", {}}, table_of({"chair", "lamp"})}});
  write_study(store, written, folder.path());
  const StudyRecord record = read_study(store, folder.path());
  ASSERT_EQ(record.table.classes.size(), 4u);
  EXPECT_EQ(record.table.classes[3].name, "lamp");
  EXPECT_EQ(record.hashes().of("hall"), "h2");
  EXPECT_EQ(record.recording_hash, written.recording_hash);
  Counts of_hall = zero_counts(3, {.tolerances = {1}, .asked = {.thin = true, .labels = true}});
  of_hall[2].labels->named_as = {3, 4, 5};  // lamps taken for background, chairs and lamps
  of_hall[1].predicted = 5;                 // chair
  of_hall[2].predicted = 7;                 // lamp
  const Counts joined = in_table(record, "hall", of_hall);
  ASSERT_EQ(joined.size(), 4u);
  EXPECT_EQ(joined[1], of_hall[0]) << "the hall has no cup";
  EXPECT_EQ(joined[2].predicted, 5);
  EXPECT_EQ(joined[3].predicted, 7);
  EXPECT_EQ(joined[3].labels->named_as, (std::vector<std::int64_t>{3, 0, 4, 5}));
  expect_error("scene 'attic'", [&] { (void)in_table(record, "attic", of_hall); });
  write_study(store, {study_of(""), table_of({"cup"}), "hash", "tiny"}, folder.path());
  EXPECT_TRUE(read_study(store, folder.path()).scenes.empty());
}

TEST(StudyStore, AClassIsDetectedInAllScenesOrNone) {
  ClassTable without = table_of({"cup"});
  without.classes[1].detect = false;
  expect_error("scenes.hall: class cup is not detected there", [&] {
    (void)record_of(two_scenes(), {{{"home", "h1", "a", {}}, table_of({"cup"})},
                                   {{"hall", "h2", "b", {}}, without}});
  });
}

TEST(StudyStore, RefusesAStoreWithoutAStudy) {
  const TemporaryFolder folder;
  ResultStore store = ResultStore::open(folder.path() / "results.sqlite");
  expect_error("holds no study", [&] { (void)read_study(store, folder.path()); });
  store.set_text("study", to_yaml(study_of("")));
  store.set_text("classes", "{broken");
  expect_error("record of its study is not readable",
               [&] { (void)read_study(store, folder.path()); });
}

TEST(StudyStore, RefusesAClassTableWhoseIdsAreNoPlaces) {
  const TemporaryFolder folder;
  ResultStore store = ResultStore::open(folder.path() / "results.sqlite");
  const ClassTable table = mapscore::testing::tiny_info().table;
  write_study(store, {study_of(""), table, "hash", "recordings/tiny"}, folder.path());
  const std::string good = store.text("classes");
  for (const auto& [from, to] :
       {std::pair{"\"id\":1,", "\"id\":65535,"}, {"\"class\":1", "\"class\":9"}}) {
    std::string bad = good;
    ASSERT_NE(bad.find(from), std::string::npos) << good;
    store.set_text("classes", bad.replace(bad.find(from), std::string(from).size(), to));
    expect_error("result store: ", [&] { (void)read_study(store, folder.path()); });
  }
}

TEST(StudyStore, DetectedSetIsTheClassFilesOrTheStudys) {
  const ClassTable table = mapscore::testing::tiny_info().table;  // crate is detected, wall is not
  const auto detected = [&](const std::string& lines) {
    const ClassTable set = detected_table(study_of(lines), table);
    return std::vector<bool>{set.detected(0), set.detected(1), set.detected(2)};
  };
  EXPECT_EQ(detected(""), (std::vector<bool>{false, true, false}));
  EXPECT_EQ(detected("detect: [wall]\n"), (std::vector<bool>{false, false, true}));
  EXPECT_EQ(detected("detect: all\n"), (std::vector<bool>{false, true, true}));
  expect_error("no class 'cup'", [&] { (void)detected("detect: [cup]\n"); });
  EXPECT_EQ(detected("class_titles: {crate: box}\n"), detected(""));
  expect_error("class_titles: there is no class 'crat'; did you mean 'crate'?",
               [&] { (void)detected("class_titles: {crat: box}\n"); });
}

}  // namespace
}  // namespace mapscore::eval
