// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#include "eval/study/grid.hpp"
#include "eval/study/study.hpp"
#include "tests/support/expect_error.hpp"
#include "tests/support/tiny_recording.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>

namespace mapscore::eval {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;

Study study(const std::string& more, const std::vector<std::string>& flags = {}) {
  return parse_study("scene: a.xml\nmethods: {d: {segmentation: {direct: {}}}}\n" + more,
                     "demo.yaml", flags);
}

TEST(ExplorationSettings, StudiesWithoutItKeepTheirKeys) {
  const Study plain = study("trajectory: {waypoints_m_deg: [[0, 0, 0]]}\n");
  EXPECT_THAT(to_key_yaml(plain), Not(HasSubstr("exploration")));
  EXPECT_FALSE(explores(plain));
  EXPECT_FALSE(on_wheels(plain));
}

TEST(ExplorationSettings, WhoExploresNeedsNoWaypointsAndDrivesOnWheels) {
  const Study one = study("exploration: {planner: {lawn_mower: {lane_m: 0.7}}, budget_m: 20}\n");
  EXPECT_TRUE(explores(one));
  EXPECT_TRUE(on_wheels(one));
  EXPECT_EQ(std::get<LawnMower>(one.exploration.planner).lane_m, 0.7);
  EXPECT_EQ(one.exploration.budget_m, 20);
  EXPECT_EQ(parse_study(to_yaml(one), "demo.yaml"), one);
}

TEST(ExplorationSettings, WhoExploresIsNotPutAtPoses) {
  const std::string planner = "exploration: {planner: random}\n";
  mapscore::testing::expect_error(
      "demo.yaml:4: trajectory.drive: is poses, and who explores drives on wheels; write wheels",
      [&] { (void)study(planner + "trajectory: {drive: poses}\n"); });
  mapscore::testing::expect_error("flag trajectory.drive=poses",
                                  [&] { (void)study(planner, {"trajectory.drive=poses"}); });
  EXPECT_TRUE(std::holds_alternative<WheelDrive>(study(planner).trajectory.drive));
  EXPECT_NO_THROW((void)study("trajectory: {waypoints_m_deg: [[0, 0, 0]], drive: poses}\n"));
}

TEST(ExplorationSettings, PlannersAreSwept) {
  const Study swept =
      study("sweep: {exploration.planner: [next_best_view, nearest_frontier]}\nseeds: 3\n");
  EXPECT_TRUE(explores(swept));
  EXPECT_EQ(trials(swept).size(), 6u);
  EXPECT_TRUE(
      std::holds_alternative<NearestFrontier>(resolve(swept, cells(swept)[1]).exploration.planner));
}

TEST(ExplorationSettings, OneSceneMayHaveAStartOfItsOwn) {
  const Study two = parse_study(
      "scenes:\n  a: {scene: a.xml}\n"
      "  b: {scene: b.xml, exploration: {start_m_deg: [1, 2, 90]}}\n"
      "exploration: {planner: random}\nmethods: {d: {segmentation: {direct: {}}}}\n",
      "demo.yaml");
  EXPECT_FALSE(with_scene(two, "a").exploration.start_m_deg);
  const Study b = with_scene(two, "b");
  ASSERT_TRUE(b.exploration.start_m_deg);
  EXPECT_EQ((*b.exploration.start_m_deg)[2], 90.0);
  EXPECT_TRUE(explores(b));
}

TEST(ExplorationSettings, WhatCannotActIsRefused) {
  const mapscore::testing::TemporaryFolder folder;
  const std::filesystem::path file = folder.path() / "demo.yaml";
  std::ofstream(file) << "recording: a\nmethods: {d: {segmentation: {direct: {}}}}\n"
                         "exploration: {planner: random}\n";
  mapscore::testing::expect_error("demo.yaml:3: exploration: cannot act beside recording",
                                  [&] { (void)load_study(file); });
  mapscore::testing::expect_error("exploration.planner drives its waypoints",
                                  [] { (void)study("exploration: {planner: waypoints}\n"); });
  mapscore::testing::expect_error(
      "exploration.budget_m", [] { (void)study("exploration: {planner: random, budget_m: 0}\n"); });
}

}  // namespace
}  // namespace mapscore::eval
