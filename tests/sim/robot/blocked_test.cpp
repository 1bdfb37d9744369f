// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#include "core/error.hpp"
#include "sim/recorder/recorded_drive.hpp"
#include "sim/robot/drive_simulation.hpp"
#include "tests/sim/robot/drive_scenes.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace mapscore::sim::testing {
namespace {

using ::testing::AllOf;
using ::testing::AnyOf;
using ::testing::HasSubstr;
using ::testing::Not;

constexpr const char* kWall =
    "<body name='wall_3'><geom type='box' pos='2 0 1' size='0.05 1 1'/></body>";
// Its top is above the lidar's plane and below the mast's end; its legs are out of the way.
constexpr const char* kTable =
    "<body name='table_7' pos='2 0 0'><geom type='box' pos='0 0 0.73' size='0.6 0.9 0.02'/>"
    "<geom type='box' pos='0.5 0.8 0.35' size='0.03 0.03 0.35'/></body>";

std::string refusal(const World& world, const Drive& drive, const DriveSettings& settings = {}) {
  try {
    (void)simulate_drive(world, robot_file(), drive, settings);
  } catch (const Error& error) {
    EXPECT_THAT(error.what(), Not(HasSubstr("\n")));
    return error.what();
  }
  return "not refused";
}

TEST(BlockedDrive, AStartInsideAWallNamesTheWall) {
  EXPECT_THAT(refusal(floor_world(kWall), drive_along({{2.1, 0.2, 0}, {0, 0, 0}})),
              AllOf(HasSubstr("waypoint 1 (2.100, 0.200 m), the start"), HasSubstr("`wall_3`")));
}

TEST(BlockedDrive, AWaypointInFurnitureNamesBoth) {
  EXPECT_THAT(refusal(floor_world(kTable), drive_along({{0, 0, 0}, {1, 0, 0}, {2, 0, 0}})),
              AllOf(HasSubstr("waypoint 3 (2.000, 0.000 m)"), HasSubstr("stand in `table_7`")));
}

TEST(BlockedDrive, AWallAcrossALegIsFoundBeforeDriving) {
  EXPECT_THAT(refusal(floor_world(kWall), drive_along({{0, 0, 0}, {0, 0.5, 0}, {3, 0.5, 0}})),
              AllOf(HasSubstr("waypoint 3 (3.000, 0.500 m) cannot be reached: `wall_3` stands in "
                              "the way at (1.9"),
                    Not(HasSubstr("stop"))));
}

// Without the check beforehand the robot drives up to it and stops by itself, untouched.
TEST(BlockedDrive, LookingAheadItStopsBeforeTouching) {
  DriveSettings settings;
  settings.check_way_first = false;
  for (const char* thing : {kWall, kTable}) {
    EXPECT_THAT(refusal(floor_world(thing), drive_along({{0, 0, 0}, {4, 0, 0}}), settings),
                AllOf(HasSubstr("waypoint 2 (4.000, 0.000 m) cannot be reached"),
                      HasSubstr("made the robot stop"), Not(HasSubstr("touched"))));
  }
}

TEST(BlockedDrive, NoFloorIsRefused) {
  EXPECT_THAT(refusal(floor_world(), drive_along({{0, 0, 0}, {7, 0, 0}})),
              AllOf(HasSubstr("waypoint 2"), HasSubstr("no floor")));
  DriveSettings settings;
  settings.check_way_first = false;
  EXPECT_THAT(
      refusal(floor_world(), drive_along({{4, 0, 0}, {7, 0, 0}}), settings),
      AllOf(HasSubstr("drive: the robot"), HasSubstr("move the waypoints, or the start, away")));
}

// Lower than the bumper, and its casters cannot climb it sideways. Either of its edges may hold.
TEST(BlockedDrive, ASillThatHoldsTheRobotUpIsNamed) {
  const World world = floor_world(
      "<body name='sill_1'><geom type='box' pos='1 0 0.0095' size='0.05 2 0.0095'/></body>");
  EXPECT_THAT(
      refusal(world, drive_along({{0, 0, 0}, {1, 0, 0}, {1, 0, 1.5}})),
      AllOf(HasSubstr("waypoint 3"), AnyOf(HasSubstr("`sill_1` holds the robot up at (0.9"),
                                           HasSubstr("`sill_1` holds the robot up at (1.0"))));
}

TEST(BlockedDrive, RobotsThatCannotDriveAreRefused) {
  const World world = floor_world();
  try {
    (void)simulate_drive(world, data_file("robot.xml"), drive_along({{0, 0, 0}, {1, 0, 0}}));
    FAIL() << "a post drove";
  } catch (const Error& error) {
    EXPECT_THAT(error.what(), HasSubstr("no hinge joint `wheel_left`"));
  }
}

TEST(BlockedDrive, SettingsOutOfRangeAreRefused) {
  const World world = floor_world();
  DriveSettings odd_rate;
  odd_rate.control_hz = 70;
  EXPECT_THAT(refusal(world, drive_along({{0, 0, 0}}), odd_rate), HasSubstr("control_hz"));
  DriveSettings ticks;
  ticks.encoder_ticks_per_turn = 0;
  EXPECT_THAT(refusal(world, drive_along({{0, 0, 0}}), ticks), HasSubstr("ticks_per_turn"));
  EXPECT_THAT(refusal(world, drive_along({})), HasSubstr("no waypoints"));
}

}  // namespace
}  // namespace mapscore::sim::testing
