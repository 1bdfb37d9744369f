// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#ifdef MAPSCORE_SIMULATOR

#include "eval/explore/standing_floor.hpp"

#include "files/file_bytes.hpp"
#include "tests/support/tiny_recording.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>

namespace mapscore::eval {
namespace {

namespace fs = std::filesystem;

/// A floor of 4 m x 2 m, and a wall across it at x = 0 with a gap about y = 0.
sim::DriveModel drive_in(double gap_m) {
  const mapscore::testing::TemporaryFolder folder;
  const double half = 0.5 * (1.0 - 0.5 * gap_m);
  const auto wall = [&](const char* name, double y) {
    return "<body name='" + std::string(name) + "'><geom type='box' pos='0 " + std::to_string(y) +
           " .5' size='.05 " + std::to_string(half) + " .5'/></body>";
  };
  write_file(folder.path() / "scene.xml",
             "<mujoco><worldbody><body name='floor_1'><geom type='box' pos='0 0 -.05' size='2 1 "
             ".05'/></body>" +
                 wall("wall_1", 1.0 - half) + wall("wall_2", half - 1.0) + "</worldbody></mujoco>");
  const fs::path robot = fs::path(MAPSCORE_SOURCE_DIR) / "scenes/robot.xml";
  const sim::World world = sim::World::load({folder.path() / "scene.xml", std::nullopt, robot}, {});
  return sim::make_drive_model(world, robot, 0.02);
}

const Eigen::AlignedBox2d kBounds{Eigen::Vector2d(-2.2, -1.2), Eigen::Vector2d(2.2, 1.2)};

bool holds(const std::vector<Eigen::Vector2d>& places, double x, double y) {
  return std::ranges::any_of(
      places, [&](const Eigen::Vector2d& p) { return (p - Eigen::Vector2d(x, y)).norm() < 1e-9; });
}

TEST(StandingFloor, AGapWideEnoughConnectsBothSides) {
  const StandingFloor floor(drive_in(0.8), kBounds);
  const auto places = floor.connected_to({-1.0, 0.0});
  EXPECT_TRUE(holds(places, 1.0, 0.0));
  EXPECT_TRUE(holds(places, 0.0, 0.0));
  EXPECT_FALSE(holds(places, -0.25, 0.7));  // 0.2 m from the wall
  EXPECT_FALSE(holds(places, -1.95, 0.9));  // a wheel beside the floor
  EXPECT_EQ(floor.largest(), places);
}

TEST(StandingFloor, AGapTooNarrowParts) {
  const StandingFloor floor(drive_in(0.4), kBounds);
  const auto places = floor.connected_to({-1.0, 0.0});
  EXPECT_TRUE(holds(places, -0.3, 0.0));
  EXPECT_FALSE(holds(places, 1.0, 0.0));
  EXPECT_EQ(floor.connected_to({1.0, 0.0}).size(), places.size());  // it is symmetric
  EXPECT_TRUE(floor.connected_to({0.0, 0.6}).empty());              // in the wall
}

TEST(StandingFloor, RoomIsTakenOffEverySide) {
  const StandingFloor floor(drive_in(0.8), kBounds), roomy = floor.with_room(2);
  const auto all = floor.connected_to({1.0, 0.0}), with_room = roomy.connected_to({1.0, 0.0});
  for (const Eigen::Vector2d& p : with_room)
    for (const double dx : {-0.1, 0.0, 0.1})
      for (const double dy : {-0.1, 0.0, 0.1}) EXPECT_TRUE(holds(all, p.x() + dx, p.y() + dy));
  EXPECT_TRUE(holds(with_room, 1.0, 0.0));
  EXPECT_LT(with_room.size(), all.size());
}

TEST(StandingFloor, ThinnedToACoarserLatticeUnlessTooFewAreLeft) {
  const StandingFloor floor(drive_in(0.8), kBounds);
  const auto all = floor.largest(), thin = floor.thinned(all, 0.5, 4);
  EXPECT_TRUE(holds(thin, 1.0, 0.5));
  EXPECT_TRUE(holds(thin, 0.0, 0.0));
  EXPECT_FALSE(holds(thin, 1.0, 0.45));
  EXPECT_EQ(floor.thinned(all, 0.5, 1000000), all);
}

TEST(RobotExtent, IsTheBumperAndTheHead) {
  const RobotExtent extent = extent_of(drive_in(0.8));
  EXPECT_NEAR(extent.radius_m, 0.221, 1e-6);
  EXPECT_NEAR(extent.height_m, 1.192, 1e-6);
}

}  // namespace
}  // namespace mapscore::eval

#endif
