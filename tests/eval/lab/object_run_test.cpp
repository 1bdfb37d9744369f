// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#include "eval/lab/object_run.hpp"

#include "core/error.hpp"
#include "core/whole_file.hpp"
#include "eval/lab/runner.hpp"
#include "tests/eval/lab/tiny_experiment.hpp"

#include <gmock/gmock.h>

namespace mapscore::eval {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;
using testing::study_of;

class TinyObjects : public testing::TinyExperiment {
 protected:
  /// All frames of the tiny recording, from a known map on.
  [[nodiscard]] ObjectFile mapped(const std::string& lines, const ObjectFile& known = {},
                                  ObjectRunOptions options = {}) {
    options.map.visibility.min_pixels = 30;  // of 64 x 48
    const Study study = study_of(lines + "map_origin_m: [0, 0, 0]\n");
    const Plan planned = plan(study);
    const Task task = planned.tasks[planned.trials[planned.trials.size() - 1].task];  // last method
    PoseSources poses(recording());
    ObjectRun run(task, recording(), table(), poses, options);
    run.start_from(known);
    for (int frame = 0; frame < recording().frame_count(); ++frame)
      run.advance(recording().read(frame, run.depth_of(frame), {.depth_label = true}));
    scores_ = score_objects(run.map().objects(), run.truth(false), table().classes.size())[1];
    return run.file();
  }
  /// Of the crates of the last run.
  [[nodiscard]] const ObjectCounts& scores() const { return scores_; }

 private:
  ObjectCounts scores_;
};

MapObject crate_at(const Eigen::Vector3d& centre) {
  MapObject crate;
  crate.class_id = 1;
  crate.box.T_frame_box.translation() = centre;
  crate.box.size_m.setConstant(0.4);
  crate.observations = 10;
  return crate;
}

TEST_F(TinyObjects, TheCrateIsFoundWhereItStands) {
  const ObjectFile file = mapped("");
  ASSERT_EQ(file.objects.size(), 1u);
  EXPECT_EQ(file.objects.front().observations, 4);
  EXPECT_EQ(scores().found, 1);
  EXPECT_LT(scores().centre_max_m, 0.22);  // half its depth: the back is never seen
}

TEST_F(TinyObjects, BoxesOfAllPiecesReachToTheWall) {
  ObjectRunOptions all;
  all.piece_m = 1000.0;
  all.map.update.rule = BoxUpdate::hull;
  const std::string shifted = "faults: {misregistration: {magnitude_m: 0.1}}\n";
  const auto far_x = [](const ObjectFile& file) {
    return file.objects.at(0).box.bounds().max().x();
  };
  EXPECT_GT(far_x(mapped(shifted, {}, all)), 2.9);  // the wall's 3.011
  EXPECT_LT(far_x(mapped(shifted)), 2.1);
}

TEST_F(TinyObjects, WhatWasTakenAwayGoesAndWhatIsHiddenStays) {
  ObjectFile known;
  known.objects = {crate_at({1.6, -0.4, 0.5}),   // before the wall, where nothing is
                   crate_at({3.4, 0.0, 0.5}),    // behind the wall
                   crate_at({-2.0, 0.0, 0.5})};  // behind the robot
  ObjectRunOptions options;
  options.map.max_age = 4;
  const ObjectFile file = mapped("", known, options);
  std::vector<double> x;
  for (const MapObject& object : file.objects) x.push_back(object.box.centre().x());
  EXPECT_THAT(
      x, ::testing::ElementsAre(::testing::DoubleNear(3.4, 1e-9), ::testing::DoubleNear(-2.0, 1e-9),
                                ::testing::DoubleNear(1.7, 0.2)));
  EXPECT_EQ(file.objects[0].misses, 0);
  options.map.max_age = 5;  // one frame more than there are
  EXPECT_EQ(mapped("", known, options).objects.at(0).age, 4);
}

TEST_F(TinyObjects, EdgeAlignedSegmentsWholeFrames) {
  EXPECT_EQ(mapped("  aligned: {segmentation: {edge_aligned: {}}}\n").objects.size(), 1u);
}

TEST_F(TinyObjects, SimulatedPerceptionSeesTheCrate) {
  (void)mapped("perception: {simulated: {}}\n");
  EXPECT_EQ(scores().found, 1);
  EXPECT_EQ(scores().falsely(), 0);
}

TEST_F(TinyObjects, KnownObjectsEnterTheKeyByTheirContentNotTheirPath) {
  const auto key = [&](const std::string& name, double x_m) {
    ObjectFile file;
    file.objects = {crate_at({x_m, 0.9, 0.5})};
    file.objects.front().id = 1;
    const std::string path = (folder() / name).string();
    write_whole_file(path, object_text(file, table()));
    return plan(study_of("perception: {simulated: {objects: " + path + "}}\n")).tasks[0].key;
  };
  const std::string first = key("a.yaml", 3.0);
  EXPECT_EQ(key("b.yaml", 3.0), first);
  EXPECT_NE(key("a.yaml", 2.9), first);
  EXPECT_NE(plan(study_of("perception: {simulated: {}}\n")).tasks[0].key, first);
}

TEST_F(TinyObjects, SimulatedPerceptionOfAFileSeesItsObjects) {
  ObjectFile file;
  file.objects = {crate_at({3.0, 0.9, 0.5})};  // a piece of the wall
  file.objects.front().id = 1;
  const std::string path = (folder() / "known.yaml").string();
  write_whole_file(path, object_text(file, table()));
  const ObjectFile seen = mapped("perception: {simulated: {objects: " + path + "}}\n");
  ASSERT_EQ(seen.objects.size(), 1u);
  EXPECT_NEAR(seen.objects.front().box.centre().x(), 3.0, 0.1);
  try {
    (void)mapped("perception: {simulated: {objects: /nowhere/known.yaml}}\n");
    FAIL() << "no such file";
  } catch (const Error& error) {
    EXPECT_THAT(error.what(), HasSubstr("known.yaml"));
    EXPECT_THAT(error.what(), Not(HasSubstr("\n")));
  }
}

TEST_F(TinyObjects, AStudyOfSimulatedPerceptionRuns) {
  const auto voxels = [&](const std::string& lines) {
    const Plan planned = plan(study_of(lines));
    ResultStore store = ResultStore::open(folder() / "perception.sqlite");
    (void)run_plan(planned, recording(), table(), store, {});
    return store.find(planned.tasks[planned.trials[0].task].key)->accounting.map_voxels;
  };
  EXPECT_GT(voxels("perception: {simulated: {}}\n"), 0);
  EXPECT_EQ(voxels("perception: {simulated: {min_pixels: 1000000}}\n"), 0);
}

TEST(PerceptionKey, OldKeysStayAndSimulatedIsReadBack) {
  EXPECT_THAT(to_key_yaml(study_of("")), Not(HasSubstr("perception")));
  const Study study = study_of("perception: {simulated: {boxes: surfaces, tolerance_m: 0.02}}\n");
  EXPECT_THAT(to_key_yaml(study), HasSubstr("perception"));
  EXPECT_EQ(std::get<SimulatedPerception>(study.perception).boxes, PerceivedBoxes::surfaces);
  EXPECT_EQ(parse_study(to_yaml(study), "study.yaml"), study);
}

}  // namespace
}  // namespace mapscore::eval
