// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#include "sim/robot/drive_session.hpp"

#include "sim/robot/clearance.hpp"
#include "sim/robot/drive_simulation.hpp"
#include "tests/sim/robot/drive_scenes.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace mapscore::sim::testing {
namespace {

WayState drive(DriveSession& session, std::vector<Drive::Waypoint> way) {
  session.follow(std::move(way));
  WayState state = WayState::driving;
  while (state == WayState::driving) state = session.step();
  return state;
}

void expect_equal(const DriveLog& a, const DriveLog& b) {
  ASSERT_EQ(a.samples.size(), b.samples.size());
  for (std::size_t n = 0; n < a.samples.size(); ++n) {
    EXPECT_EQ(a.samples[n].stamp_s, b.samples[n].stamp_s);
    EXPECT_EQ(a.samples[n].T_world_base.matrix(), b.samples[n].T_world_base.matrix()) << n;
    EXPECT_EQ(a.samples[n].T_odom_base.matrix(), b.samples[n].T_odom_base.matrix()) << n;
  }
  EXPECT_EQ(a.distance_m, b.distance_m);
}

TEST(DriveSession, OneWayIsASimulatedDrive) {
  const World world = floor_world();
  const std::vector<Drive::Waypoint> way{{0, 0, 0}, {0.6, 0, 1.0}, {0.6, 0.4, 0}};
  const DriveLog drive_log = simulate_drive(world, robot_file(), drive_along(way));
  const DriveModel model = make_drive_model(world, robot_file(), 0.02);
  DriveSession session(model, way.front(), {});
  EXPECT_EQ(drive(session, way), WayState::arrived);
  session.rest_until(session.log().end_s + 0.2);
  expect_equal(session.take_log(), drive_log);
}

TEST(DriveSession, FurtherWaysGoOnInOneLog) {
  const DriveModel model = make_drive_model(floor_world(), robot_file(), 0.02);
  DriveSession session(model, {0, 0, 0}, {});
  EXPECT_EQ(drive(session, {{0, 0, 0}, {0.5, 0, 0}}), WayState::arrived);
  const double first_m = session.log().distance_m;
  EXPECT_NEAR(first_m, 0.5, 0.02);
  EXPECT_EQ(drive(session, {session.place(), {0.5, 0.5, 0}}), WayState::arrived);
  EXPECT_NEAR(session.log().distance_m, 1.0, 0.04);
  EXPECT_NEAR(session.place().x_m, 0.5, 0.05);
  EXPECT_NEAR(session.place().y_m, 0.5, 0.05);
  const DriveLog log = session.take_log();
  for (std::size_t n = 0; n < log.samples.size(); ++n)
    EXPECT_EQ(log.samples[n].stamp_s, static_cast<double>(n) / 50.0);
  EXPECT_EQ(log.health.bump_contacts, 0u);
  // The odometry counts from the first way's start, through both.
  EXPECT_NEAR(log.samples.back().T_odom_base.translation().y(), 0.5, 0.05);
}

TEST(DriveSession, ItStopsBeforeAWallBacksOffAndDrivesElsewhere) {
  const World world =
      floor_world("<body name='wall_3'><geom type='box' pos='1 0 1' size='0.05 1 1'/></body>");
  const DriveModel model = make_drive_model(world, robot_file(), 0.02);
  DriveSession session(model, {0, 0, 0}, {});
  EXPECT_EQ(drive(session, {{0, 0, 0}, {2, 0, 0}}), WayState::blocked);
  ASSERT_TRUE(session.obstacle());
  EXPECT_EQ(session.obstacle()->body, "wall_3");
  EXPECT_NEAR(session.place().x_m, 0.95 - 0.241, 0.04);
  const double stopped_m = session.place().x_m;
  session.back_off(0.2);
  EXPECT_LT(session.place().x_m, stopped_m - 0.02);
  EXPECT_GT(session.place().x_m, stopped_m - 0.2);
  Clearance clearance(model);
  EXPECT_FALSE(clearance.obstacle_at(session.place()));
  EXPECT_EQ(drive(session, {session.place(), {-0.5, 0, 0}}), WayState::arrived);
  EXPECT_EQ(session.health().bump_contacts, 0u);
}

/// A robot that stands nearer to a wall than its clearance is blocked, backs off, and turns to
/// drive away.
PlanarPose leave_wall(const std::string& position, const std::string& size) {
  const World world = floor_world("<body name='wall'><geom type='box' pos='" + position +
                                  "' size='" + size + "'/></body>");
  const DriveModel model = make_drive_model(world, robot_file(), 0.02);
  DriveSession session(model, {0, 0, 0}, {});
  EXPECT_EQ(drive(session, {{0, 0, 0}, {1, 0, 0}}), WayState::blocked);
  session.back_off(0.2);
  EXPECT_EQ(drive(session, {session.place(), {session.place().x_m, -1, -1.6}}), WayState::arrived);
  EXPECT_EQ(session.health().bump_contacts, 0u);
  return session.place();
}

// 1 cm beside the bumper of 0.221 m: neither forwards nor back makes room, but turning does not
// bring it nearer, nor does driving away.
TEST(DriveSession, ItLeavesAWallBesideIt) {
  EXPECT_NEAR(leave_wall("0 0.281 1", "2 0.05 1").y_m, -1.0, 0.05);
}

// From a wall behind it drives forwards.
TEST(DriveSession, ItDrivesForwardsFromAWallBehindIt) {
  EXPECT_GT(leave_wall("-0.281 0 1", "0.05 2 1").x_m, 0.01);
}

TEST(DriveSession, OneThatLeavesAWallStillStopsBeforeIt) {
  const World world =
      floor_world("<body name='wall'><geom type='box' pos='0 0.281 1' size='2 0.05 1'/></body>");
  const DriveModel model = make_drive_model(world, robot_file(), 0.02);
  DriveSession session(model, {0, 0, 0}, {});
  EXPECT_EQ(drive(session, {{0, 0, 0}, {1, 0, 0}}), WayState::blocked);
  session.back_off(0.2);
  EXPECT_EQ(drive(session, {session.place(), {session.place().x_m, 1, 1.6}}), WayState::blocked);
  EXPECT_EQ(session.health().bump_contacts, 0u);
}

TEST(DriveSession, MindingEdgesItStopsBeforeTheFloorEnds) {
  const DriveModel model = make_drive_model(floor_world(), robot_file(), 0.02);
  DriveSession session(model, {4.3, 0, 0}, {});
  session.mind_edges();
  EXPECT_EQ(drive(session, {{4.3, 0, 0}, {6, 0, 0}}), WayState::blocked);
  EXPECT_FALSE(session.obstacle());
  EXPECT_LT(session.place().x_m, 5.0);
}

// The bumper's lower edge is 25 mm above the floor.
TEST(DriveSession, MindingEdgesItStopsBeforeWhatItsBumperWouldGraze) {
  const World world = floor_world(
      "<body name='foot'><geom type='cylinder' pos='1 0 0.012' size='0.12 0.012'/></body>");
  const DriveModel model = make_drive_model(world, robot_file(), 0.02);
  DriveSession session(model, {0, 0, 0}, {});
  session.mind_edges();
  EXPECT_EQ(drive(session, {{0, 0, 0}, {2, 0, 0}}), WayState::blocked);
  ASSERT_TRUE(session.obstacle());
  EXPECT_EQ(session.obstacle()->body, "foot");
  EXPECT_EQ(session.health().bump_contacts, 0u);
}

}  // namespace
}  // namespace mapscore::sim::testing
