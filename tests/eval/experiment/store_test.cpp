// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#include "eval/experiment/store.hpp"

#include "eval/experiment/result_json.hpp"
#include "tests/eval/recording/expect_error.hpp"
#include "tests/support/tiny_recording.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>
#include <iterator>

namespace mapscore::eval {
namespace {

using mapscore::testing::expect_error;
using ::testing::UnorderedElementsAre;

std::string bytes_of(const std::filesystem::path& file) {
  std::ifstream stream(file, std::ios::binary);
  return {std::istreambuf_iterator<char>(stream), {}};
}

/// A result in which no two numbers are equal.
TrialResult result_of(std::int64_t number) {
  const auto next = [&] { return number++; };
  TrialResult result;
  result.counts = zero_counts(2, {});
  for (ClassCounts& c : result.counts) {
    for (auto* count : {&c.predicted, &c.true_predicted, &c.visible, &c.found, &c.false_near,
                        &c.false_leak, &c.false_floating, &c.missed_mislabelled,
                        &c.missed_unlabelled, &c.missed_unmapped, &c.visible_4, &c.found_4})
      *count = next();
    c.at_tolerance = {{1, next(), next()}};
    c.accuracy = DistanceTally({0.01, 0.02});
    c.accuracy.add(0.001 * static_cast<double>(next()));
    c.curve = {next(), next(), {{900, next(), next(), next(), next()}, {7, next(), 0, 0, next()}}};
    c.boxes = {next(), next(), next(), next(), next(), next()};
  }
  Accounting& a = result.accounting;
  for (auto* count : {&a.frames, &a.detections, &a.skipped_no_points, &a.skipped_no_seed_point,
                      &a.skipped_seed_off_object, &a.skipped_eroded_away, &a.points, &a.map_voxels,
                      &a.hits_beyond_span})
    *count = next();
  return result;
}

class Store : public ::testing::Test {
 protected:
  [[nodiscard]] std::filesystem::path file(const char* name) const { return folder_.path() / name; }

 private:
  mapscore::testing::TemporaryFolder folder_;
};

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
  EXPECT_TRUE(store.contains("key"));
  EXPECT_FALSE(store.contains("other"));
  EXPECT_FALSE(store.find("other"));
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

TEST_F(Store, KeepsTheFirstResultOfAKey) {
  ResultStore store = ResultStore::open(file("a.sqlite"));
  store.add("key", "first", result_of(1));
  store.add("key", "second", result_of(2));
  EXPECT_EQ(store.find("key")->counts, result_of(1).counts);
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
  EXPECT_THAT(a.keys(), UnorderedElementsAre("one", "two"));
  EXPECT_EQ(a.find("one")->counts, result_of(1).counts);
  EXPECT_EQ(a.find("two")->counts, result_of(2).counts);
  EXPECT_EQ(a.merge(b), 0);
}

TEST_F(Store, RefusesWhatIsNoStore) {
  expect_error("run `mapscore sweep` first",
               [&] { (void)ResultStore::open_existing(file("none.sqlite")); });
  std::ofstream(file("text.sqlite")) << "not a database, but long enough to have a header\n";
  expect_error("check free space, permissions and that it is a store",
               [&] { (void)ResultStore::open(file("text.sqlite")); });
  expect_error("that it is a store",
               [&] { (void)ResultStore::open_existing(file("text.sqlite")); });
}

TEST_F(Store, RefusesAnotherFormat) {
  ResultStore::open(file("a.sqlite")).set_text("format_version", "999");
  expect_error("format 999", [&] { (void)ResultStore::open(file("a.sqlite")); });
  expect_error("another format", [&] { (void)ResultStore::open_existing(file("a.sqlite")); });
}

TEST_F(Store, RefusesAFolderThatCanNotBe) {
  std::ofstream(file("in_the_way")) << "";
  expect_error("cannot be written",
               [&] { (void)ResultStore::open(file("in_the_way") / "a.sqlite"); });
}

TEST(ResultJson, RefusesWhatIsNotAResult) {
  EXPECT_EQ(result_from_json(to_json(result_of(3))).counts, result_of(3).counts);
  for (const char* text : {"", "{}", "{\"accounting\": 3}", "[1, 2"})
    expect_error("stored result", [&] { (void)result_from_json(text); });
}

}  // namespace
}  // namespace mapscore::eval
