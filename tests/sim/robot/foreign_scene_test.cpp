// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#include "core/error.hpp"
#include "sim/recorder/recorded_drive.hpp"
#include "sim/robot/drive_simulation.hpp"
#include "tests/sim/robot/drive_scenes.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

namespace mapscore::sim::testing {
namespace {

using ::testing::HasSubstr;

const Drive kDrive = drive_along({{0, 0, 0}, {1, 0.2, 0.5}});
const char* kFloor = "<geom type='plane' size='4 4 0.1'/>";

DriveLog drive_through(const std::string& text) {
  return simulate_drive(drive_world(text), robot_file(), kDrive);
}

void expect_same(const DriveLog& a, const DriveLog& b) {
  ASSERT_EQ(a.samples.size(), b.samples.size());
  EXPECT_EQ(a.samples.back().T_world_base.matrix(), b.samples.back().T_world_base.matrix());
}

// Options, joints, motors and contact settings of the scene stay behind.
TEST(ForeignScene, OptionsOfTheSceneDoNotReachTheDrive) {
  const DriveLog plain = drive_through(mjcf(kFloor));
  expect_same(plain, drive_through(mjcf(kFloor,
                                        "<option timestep='0.00001' gravity='0 0 9.81' "
                                        "integrator='Euler' density='1000' wind='3 0 0'>"
                                        "<flag contact='disable'/></option>")));
  expect_same(plain, drive_through("<mujoco><compiler angle='radian'/><worldbody>"
                                   "<geom type='plane' size='4 4 .1' friction='0 0 0' "
                                   "solref='0.5 1' priority='0' contype='4' conaffinity='8'/>"
                                   "<body name='arm_1' pos='-3 0 1'><joint name='j' type='hinge'/>"
                                   "<geom size='0.1 0.2' type='capsule'/></body></worldbody>"
                                   "<actuator><motor joint='j'/></actuator>"
                                   "<keyframe><key qpos='1' ctrl='1'/></keyframe></mujoco>"));
}

TEST(ForeignScene, LooseThingsStandStill) {
  const std::string ball =
      "<body name='ball_1' pos='0.5 0 2'><freejoint/><geom size='0.1'/></body>";
  expect_same(drive_through(mjcf(kFloor)), drive_through(mjcf(kFloor + ball)));
}

TEST(ForeignScene, HeightFieldsAndMeshesCarryTheRobot) {
  const std::string field =
      "<asset><hfield name='h' nrow='9' ncol='9' size='4 4 0.01 0.1'/></asset>";
  EXPECT_NEAR(drive_through(mjcf("<geom type='hfield' hfield='h'/>", field))
                  .samples.back()
                  .T_world_base.translation()
                  .z(),
              0.0, 0.001);
  const std::string slab =
      "<asset><mesh name='m' vertex='-4 -4 -.1 4 -4 -.1 4 4 -.1 -4 4 -.1 -4 -4 0 4 -4 0 4 4 0 -4 4 "
      "0'/></asset>";
  EXPECT_NEAR(drive_through(mjcf("<geom type='mesh' mesh='m'/>", slab))
                  .samples.back()
                  .T_world_base.translation()
                  .z(),
              0.0, 0.001);
}

// A room in one mesh: an open box of 6 m whose hull would swallow the robot.
TEST(ForeignScene, ARoomInOneMeshIsHollow) {
  const std::string room =
      "<asset><mesh name='room' inertia='shell' "
      "vertex='-3 -3 0  3 -3 0  3 3 0  -3 3 0  -3 -3 2  3 -3 2  3 3 2  -3 3 2' "
      "face='0 1 2 0 2 3  0 4 1 1 4 5  1 5 2 2 5 6  2 6 3 3 6 7  3 7 0 0 7 4'/></asset>";
  const World world = drive_world(
      mjcf("<body name='room_1'><geom type='mesh' mesh='room' contype='0' conaffinity='0'/></body>",
           room));
  EXPECT_GT(simulate_drive(world, robot_file(), kDrive).distance_m, 0.9);
  try {
    (void)simulate_drive(world, robot_file(), drive_along({{0, 0, 0}, {2.9, 0, 0}}));
    FAIL() << "drove into the wall";
  } catch (const Error& error) {
    EXPECT_THAT(error.what(), HasSubstr("waypoint 2 (2.900, 0.000 m): the robot would stand in "
                                        "`room_1`"));
  }
}

// Hidden hulls collide in place of what is drawn; glass collides although cameras look through.
TEST(ForeignScene, HiddenHullsAndGlassAreInTheWay) {
  const std::string hull =
      "<body name='crate_1' pos='0.8 0 0.3'><geom type='box' size='0.01 0.01 0.01' group='1' "
      "contype='0' conaffinity='0'/><geom type='box' size='0.2 0.2 0.3' group='3'/></body>";
  const std::string glass =
      "<body name='pane_1' pos='0.8 0 0.3'><geom type='box' size='0.01 0.5 0.3' contype='0' "
      "conaffinity='0' rgba='1 1 1 0.1'/></body>";
  EXPECT_THROW((void)drive_through(mjcf(kFloor + hull)), Error);
  EXPECT_THROW((void)drive_through(mjcf(kFloor + glass)), Error);
}

}  // namespace
}  // namespace mapscore::sim::testing
