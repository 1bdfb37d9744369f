// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#include "eval/results/store.hpp"

#include "tests/eval/results/stored_results.hpp"
#include "tests/support/expect_error.hpp"

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <map>

namespace mapscore::eval {
namespace {

using mapscore::testing::expect_error;
using testing::bytes_of;
using ::testing::Key;
using ::testing::Pair;
using testing::result_of;
using testing::run_sql;
using ::testing::UnorderedElementsAre;
using Store = testing::StoreTest;

TEST_F(Store, GivesBackWhatWasAdded) {
  const TrialResult result = result_of(10);
  {
    ResultStore store = ResultStore::open(file("a.sqlite"));
    store.add("key", "description", result);
    store.set_text("study", "it's a study\n");
  }
  const ResultStore store = ResultStore::open_existing(file("a.sqlite"));
  const auto found = store.find("key");
  ASSERT_TRUE(found);
  EXPECT_EQ(found->counts, result.counts);
  EXPECT_EQ(found->accounting, result.accounting);
  EXPECT_EQ(store.text("study"), "it's a study\n");
  EXPECT_EQ(store.text("nothing"), "");
  EXPECT_TRUE(store.builds().contains("key"));
  EXPECT_FALSE(store.builds().contains("other"));
  EXPECT_FALSE(store.find("other"));
}

TEST_F(Store, GivesBackLabelsWhereTheyWereScored) {
  TrialResult result = result_of(10);
  for (ClassCounts& c : result.counts) {
    c.labels = LabelCounts{1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, {0, 0, 0, 5, 0}};
    c.labels->scores.add(0.25, true, 3);
    c.labels->pixels.add(1.0, false, 7);
  }
  result.counts.back().labels = LabelCounts{};
  ResultStore store = ResultStore::open(file("a.sqlite"));
  store.add("with", "", result);
  EXPECT_EQ(store.find("with")->counts, result.counts);
}

TEST_F(Store, GivesBackInstancesWhereTheyWereScored) {
  TrialResult result = result_of(10);
  for (ClassCounts& c : result.counts) {
    c.instances = InstanceCounts{1, 2, 3, 4, 5, {{900, 6, {}}, {20, 7, {}}}};
    for (InstanceStep& step : c.instances->steps)
      for (std::size_t t = 0; t < step.true_predicted.size(); ++t)
        step.true_predicted[t] = step.score + static_cast<std::int64_t>(t);
  }
  ResultStore store = ResultStore::open(file("a.sqlite"));
  store.add("with", "", result);
  store.add("without", "", result_of(10));
  EXPECT_EQ(store.find("with")->counts, result.counts);
  EXPECT_EQ(store.find("without")->counts, result_of(10).counts);
}

TEST_F(Store, GivesBackHowPosesWereTracked) {
  TrialResult with = result_of(10), zero = result_of(10);
  with.accounting.frames_left_out = 4;
  with.accounting.tracking = TrackingCounts{1, 2, 3, 4, 5, 6, 7, 8, 9, 10};
  zero.accounting.tracking = TrackingCounts{};
  ResultStore store = ResultStore::open(file("a.sqlite"));
  store.add("with", "", with);
  store.add("zero", "", zero);
  store.add("without", "", result_of(10));
  EXPECT_EQ(store.find("with")->accounting, with.accounting);
  EXPECT_EQ(store.find("zero")->accounting, zero.accounting);
  EXPECT_EQ(store.find("without")->accounting, result_of(10).accounting);
  EXPECT_EQ(to_json(result_of(10)).find("tracking"), std::string::npos)
      << "other trials are stored as before";
  EXPECT_EQ(to_json(result_of(10)).find("left_out"), std::string::npos);
}

/// As it was written before results were packed: every count, a list for each step.
TEST_F(Store, ReadsRowsOfPlainJsonFromBefore) {
  const char* text =
      R"({"accounting":{"detections":2,"frames":1,"hits_beyond_span":0,"map_voxels":8,"points":7,)"
      R"("skipped_eroded_away":0,"skipped_no_points":0,"skipped_no_seed_point":0,)"
      R"("skipped_seed_off_object":0},"classes":[{"accuracy":{"bins":[3,0,0,1],"count":5,)"
      R"("limits_m":[0.01],"sum_nm":2000000,"unreached":1,"within":[4]},"at_tolerance":[[1,5,6]],)"
      R"("boxes":{"at_25":0,"at_50":0,"at_75":0,"boxes":1,"boxes_unseen":0,"iou_sum_billionth":0},)"
      R"("completeness":{"bins":[],"count":0,"limits_m":[],"sum_nm":0,"unreached":0,"within":[]},)"
      R"("curve":{"squared_error_billionth":9,"steps":[[900,4,3,2,1],[7,1,0,0,0]],"visible":11},)"
      R"("false_floating":0,"false_leak":0,"false_near":0,"found":3,"found_4":0,)"
      R"("missed_mislabelled":0,"missed_unlabelled":0,"missed_unmapped":0,"predicted":5,)"
      R"("true_predicted":4,"visible":11,"visible_4":0}]})";
  TrialResult expected;
  expected.accounting.frames = 1;
  expected.accounting.detections = 2;
  expected.accounting.points = 7;
  expected.accounting.map_voxels = 8;
  ClassCounts& c = expected.counts.emplace_back();
  c.predicted = 5, c.true_predicted = 4, c.visible = 11, c.found = 3;
  c.at_tolerance = {{1, 5, 6}};
  c.accuracy = DistanceTally(DistanceTally::Parts{{0.01}, {4}, 5, 1, 2000000, {3, 0, 0, 1}});
  c.curve = {11, 9, {{900, 4, 3, 2, 1}, {7, 1, 0, 0, 0}}};
  c.boxes.detections = 1;
  ResultStore::open(file("a.sqlite")).set_text("study", "");
  run_sql(
      file("a.sqlite"),
      fmt::format("INSERT INTO trials (key, description, result) VALUES ('key', '', '{}')", text));
  ResultStore store = ResultStore::open(file("a.sqlite"));
  EXPECT_EQ(store.find("key")->counts, expected.counts);
  EXPECT_EQ(store.find("key")->accounting, expected.accounting);
  ResultStore other = ResultStore::open(file("b.sqlite"));
  EXPECT_EQ(other.merge(store), 1);
  EXPECT_EQ(other.find("key")->counts, expected.counts);
}

TEST_F(Store, RefusesResultsThatAreNoStream) {
  ResultStore store = ResultStore::open(file("a.sqlite"));
  store.add("key", "", result_of(10));
  for (const char* damage : {"x''", "x'789c'", "x'00'", "substr(result, 1, length(result) - 9)"}) {
    run_sql(file("a.sqlite"), std::string("UPDATE trials SET result = ") + damage);
    expect_error("a.sqlite: ", [&] { (void)store.find("key"); });
  }
}

TEST_F(Store, KeepsFailuresUntilTheTrialIsAdded) {
  ResultStore store = ResultStore::open(file("a.sqlite"));
  store.add_failure("one", "first");
  store.add_failure("one", "second");
  store.add_failure("two", "other");
  using Failures = std::map<std::string, std::string>;
  EXPECT_EQ(store.failures(), (Failures{{"one", "second"}, {"two", "other"}}));
  store.add("one", "", result_of(1));
  EXPECT_EQ(store.failures(), (Failures{{"two", "other"}}));
}

TEST_F(Store, ATrialOfManyClassesThatHoldNothingIsSmall) {
  TrialResult result = result_of(10);
  for (int n = 0; n < 40; ++n) result.counts.push_back(zero_counts(1, {}).front());
  const std::string text = to_json(result);
  EXPECT_EQ(result_from_json(text).counts, result.counts);
  EXPECT_LT(text.size(), to_json(result_of(10)).size() + 2000);
}

TEST_F(Store, KeepsTheFirstResultOfAKey) {
  ResultStore store = ResultStore::open(file("a.sqlite"));
  store.add("key", "first", result_of(1));
  store.add("key", "second", result_of(2));
  EXPECT_EQ(store.find("key")->counts, result_of(1).counts);
}

TEST_F(Store, ReplacesTheResultOfAnotherBuild) {
  ResultStore::open(file("a.sqlite"), "before").add("key", "first", result_of(1));
  ResultStore store = ResultStore::open(file("a.sqlite"), "after");
  EXPECT_THAT(store.builds(), UnorderedElementsAre(Pair("key", "before")));
  store.add("key", "second", result_of(2));
  EXPECT_EQ(store.find("key")->counts, result_of(2).counts);
  EXPECT_THAT(store.builds(), UnorderedElementsAre(Pair("key", "after")));
}

/// A store as mapscore wrote it before trials told their build.
void write_store_without_builds(const std::filesystem::path& file, const TrialResult& result) {
  run_sql(file,
          "CREATE TABLE texts (name TEXT PRIMARY KEY, value TEXT NOT NULL);"
          "CREATE TABLE trials (key TEXT PRIMARY KEY, description TEXT NOT NULL, "
          "result TEXT NOT NULL);"
          "INSERT INTO texts VALUES ('format_version', '1');"
          "INSERT INTO trials VALUES ('old', '', '" +
              to_json(result) + "')");
}

TEST_F(Store, TrialsWithoutABuildAreOfAnother) {
  write_store_without_builds(file("a.sqlite"), result_of(1));
  {
    const std::string before = bytes_of(file("a.sqlite"));
    const ResultStore read = ResultStore::open_existing(file("a.sqlite"));
    EXPECT_EQ(read.find("old")->counts, result_of(1).counts);
    EXPECT_THAT(read.builds(), UnorderedElementsAre(Pair("old", "")));
    EXPECT_TRUE(bytes_of(file("a.sqlite")) == before);

    ResultStore other = ResultStore::open(file("b.sqlite"), "now");
    EXPECT_EQ(other.merge(read), 1);
    EXPECT_THAT(other.builds(), UnorderedElementsAre(Pair("old", "")));
  }
  ResultStore store = ResultStore::open(file("a.sqlite"), "now");
  store.add("new", "", result_of(2));
  EXPECT_THAT(store.builds(), UnorderedElementsAre(Pair("old", ""), Pair("new", "now")));
  store.add("old", "", result_of(3));
  const ResultStore again = ResultStore::open_existing(file("a.sqlite"));
  EXPECT_EQ(again.find("old")->counts, result_of(3).counts);
  EXPECT_THAT(again.builds(), UnorderedElementsAre(Pair("old", "now"), Pair("new", "now")));
}

TEST_F(Store, OpenedAgainWithTheSameTextsKeepsItsBytes) {
  {
    ResultStore store = ResultStore::open(file("a.sqlite"));
    store.add("key", "description", result_of(1));
    store.set_text("study", "text");
  }
  const std::string before = bytes_of(file("a.sqlite"));
  {
    ResultStore store = ResultStore::open(file("a.sqlite"));
    store.set_text("study", "text");
  }
  EXPECT_TRUE(bytes_of(file("a.sqlite")) == before);
}

TEST_F(Store, MergeTakesWhatIsNotThere) {
  ResultStore a = ResultStore::open(file("a.sqlite"));
  ResultStore b = ResultStore::open(file("b.sqlite"));
  a.add("one", "", result_of(1));
  b.add("one", "", result_of(100));
  b.add("two", "", result_of(2));
  EXPECT_EQ(a.merge(b), 1);
  EXPECT_THAT(a.builds(), UnorderedElementsAre(Key("one"), Key("two")));
  EXPECT_EQ(a.find("one")->counts, result_of(1).counts);
  EXPECT_EQ(a.find("two")->counts, result_of(2).counts);
  EXPECT_EQ(a.merge(b), 0);
}

TEST_F(Store, MergeTakesOfThisBuildWhatAnotherMade) {
  ResultStore a = ResultStore::open(file("a.sqlite"), "before");
  ResultStore b = ResultStore::open(file("b.sqlite"), "after");
  a.add("one", "", result_of(1));
  b.add("one", "", result_of(100));
  EXPECT_EQ(b.merge(a), 0);
  EXPECT_EQ(b.find("one")->counts, result_of(100).counts);
  EXPECT_EQ(ResultStore::open(file("a.sqlite"), "after").merge(b), 1);
  EXPECT_EQ(a.find("one")->counts, result_of(100).counts);
}

}  // namespace
}  // namespace mapscore::eval
