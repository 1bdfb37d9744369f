// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#include "eval/results/store.hpp"
#include "tests/eval/results/stored_results.hpp"
#include "tests/support/expect_error.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace mapscore::eval {
namespace {

using mapscore::testing::expect_error;
using testing::result_of;

TEST(ResultJson, RefusesWhatIsNoCount) {
  TrialResult result = result_of(10);
  result.counts[0].instances = InstanceCounts{1, 2, 3, 4, 5, {{900, 6, {}}, {20, 7, {}}}};
  const std::string good = to_json(result);
  const auto with = [&](const std::string& from, const std::string& to) {
    std::string bad = good;
    EXPECT_NE(bad.find(from), std::string::npos) << from << " in " << good;
    return bad.replace(bad.find(from), from.size(), to);
  };
  for (const char* key : {"predicted", "frames", "unreached", "sum_nm", "squared_error_billionth",
                          "boxes_unseen", "instances_void"})
    for (const char* value : {"-1", "1.5", "1e300", "18446744073709551615", "1000000000000000001",
                              "null", "\"7\"", "true"}) {
      const std::string name = fmt::format("\"{}\":", key);
      expect_error("is no count; delete the store and sweep again",
                   [&] { (void)result_from_json(with(name, name + value + ",\"x\":")); });
    }
  TrialResult twice = result_of(10);
  twice.counts[1] = twice.counts[0];
  std::string alike = to_json(twice);
  ASSERT_TRUE(alike.ends_with(",0]}")) << alike;
  expect_error("there is no class 7 before",
               [&] { (void)result_from_json(alike.replace(alike.size() - 3, 1, "7")); });
  for (const char* list : {"bins", "within"}) {
    const std::string name = fmt::format("\"{}\":[", list);
    expect_error("-1 is no count", [&] { (void)result_from_json(with(name, name + "-1,")); });
  }
  expect_error("is no thousandth", [&] { (void)result_from_json(with("[[900,", "[[1001,")); });
  for (const char* place : {"[900,", "[901,"})
    expect_error("steps do not fall", [&] { (void)result_from_json(with("[20,", place)); });
}

TEST(ResultJson, LeavesOutZeros) {
  TrialResult result = result_of(10);
  result.counts[1] = zero_counts(1, {{}, {0.01, 0.02}, {}}).front();
  result.counts[1].visible = 7;
  DistanceTally& far = result.counts[0].completeness = DistanceTally({0.01});
  for (const double distance_m : {0.0, 0.002, 0.9, 0.9015, 3.0}) far.add(distance_m);
  const std::string text = to_json(result);
  EXPECT_EQ(result_from_json(text).counts, result.counts);
  EXPECT_NE(text.find("\"bins\":[1,0,1,["), std::string::npos) << text;
  std::string bad = text;
  bad.replace(bad.find("[1,0,1,["), 8, "[1,0,1,[99999999999");
  expect_error("too many bins", [&] { (void)result_from_json(bad); });
}

TEST(ResultJson, RefusesWhatIsNotAResult) {
  EXPECT_EQ(result_from_json(to_json(result_of(3))).counts, result_of(3).counts);
  for (const char* text : {"", "{}", "{\"accounting\": 3}", "[1, 2"})
    expect_error("stored result", [&] { (void)result_from_json(text); });
}

}  // namespace
}  // namespace mapscore::eval
