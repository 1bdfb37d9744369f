// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#include "core/error.hpp"
#include "sim/recorder/recorded_drive.hpp"
#include "sim/robot/drive_simulation.hpp"
#include "tests/sim/robot/drive_scenes.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace mapscore::sim::testing {
namespace {

void expect_healthy(const DriveLog& log) {
  EXPECT_GT(log.health.deepest_wheel_m, 0.0);
  EXPECT_LT(log.health.deepest_wheel_m, 0.002);
  EXPECT_LT(log.health.longest_airborne_s, 0.01);
  EXPECT_LT(log.health.largest_tilt_rad, 1.0 * kDegree);
  EXPECT_EQ(log.health.bump_contacts, 0u);
}

void expect_arrivals(const DriveLog& log, std::size_t waypoints) {
  ASSERT_EQ(log.arrivals.size(), waypoints);
  for (const WaypointArrival& arrival : log.arrivals) {
    EXPECT_LT(arrival.position_error_m, 0.01) << arrival.waypoint;
    EXPECT_LT(arrival.yaw_error_rad, 0.5 * kDegree) << arrival.waypoint;
  }
}

TEST(Drive, AStraightMetre) {
  const World world = floor_world();
  const DriveLog log = simulate_drive(world, robot_file(), drive_along({{0, 0, 0}, {1, 0, 0}}));
  expect_healthy(log);
  expect_arrivals(log, 2);
  EXPECT_NEAR(log.distance_m, 1.0, 0.01);
  // 0.4 m/s with 0.5 m/s^2 up and 0.4 down: 2.5 s + ramps; rest at the end
  EXPECT_NEAR(log.end_s, 3.6, 0.4);
  const PlanarPose odom = planar(log.samples.back().T_odom_base);
  EXPECT_NEAR(odom.x_m, planar(log.samples.back().T_world_base).x_m, 0.005);
  EXPECT_NE(odom.x_m, planar(log.samples.back().T_world_base).x_m);
}

TEST(Drive, ATurnOnTheSpotStaysOnTheSpot) {
  const World world = floor_world();
  const DriveLog log =
      simulate_drive(world, robot_file(), drive_along({{0.2, 0.1, 0}, {0.2, 0.1, 170 * kDegree}}));
  expect_healthy(log);
  expect_arrivals(log, 2);
  for (const DriveSample& sample : log.samples) {
    EXPECT_NEAR(sample.T_world_base.translation().x(), 0.2, 0.01);
    EXPECT_NEAR(sample.T_world_base.translation().y(), 0.1, 0.01);
  }
}

TEST(Drive, ASquareComesBackAndOdometryAlmost) {
  const World world = floor_world();
  const DriveLog log = simulate_drive(
      world, robot_file(),
      drive_along(
          {{0, 0, 0}, {1, 0, 90 * kDegree}, {1, 1, M_PI}, {0, 1, -90 * kDegree}, {0, 0, 0}}));
  expect_healthy(log);
  expect_arrivals(log, 5);
  EXPECT_NEAR(log.distance_m, 4.0, 0.05);
  const PlanarPose odom = planar(log.samples.back().T_odom_base);
  const double drift_m = std::hypot(odom.x_m, odom.y_m);
  EXPECT_GT(drift_m, 0.002);
  EXPECT_LT(drift_m, 0.2);
}

TEST(Drive, CoarserEncodersAndWrongWheelsDriftMore) {
  const World world = floor_world();
  const Drive drive = drive_along({{0, 0, 0}, {2, 0, 0}});
  const auto end_x = [&](const DriveSettings& settings) {
    const DriveLog log = simulate_drive(world, robot_file(), drive, settings);
    return planar(log.samples.back().T_odom_base).x_m;
  };
  DriveSettings coarse, wrong;
  coarse.encoder_ticks_per_turn = 8;
  wrong.radius_error = 0.02;
  const double fine_x = end_x({});
  EXPECT_NEAR(end_x(wrong), 1.02 * fine_x, 1e-6);
  EXPECT_GT(std::abs(end_x(coarse) - fine_x), 1e-3);
  EXPECT_LT(std::abs(end_x(coarse) - fine_x), 2.0 * M_PI * 0.076 / 8);
}

TEST(Drive, SameInputSameBytes) {
  const World world = floor_world();
  const Drive drive = drive_along({{0, 0, 0.3}, {0.7, -0.4, 1.0}});
  const DriveLog a = simulate_drive(world, robot_file(), drive);
  const DriveLog b = simulate_drive(floor_world(), robot_file(), drive);
  ASSERT_EQ(a.samples.size(), b.samples.size());
  for (std::size_t i = 0; i < a.samples.size(); ++i) {
    EXPECT_EQ(a.samples[i].T_world_base.matrix(), b.samples[i].T_world_base.matrix());
    EXPECT_EQ(a.samples[i].T_odom_base.matrix(), b.samples[i].T_odom_base.matrix());
    EXPECT_EQ(a.samples[i].ticks.left, b.samples[i].ticks.left);
  }
}

TEST(Drive, StandsUntilItIsTold) {
  const World world = floor_world();
  Drive drive = drive_along({{0, 0, 0}, {0.5, 0, 0}});
  const DriveLog soon = simulate_drive(world, robot_file(), drive);
  drive.until_s = 12.0;
  const DriveLog late = simulate_drive(world, robot_file(), drive);
  EXPECT_EQ(late.end_s, soon.end_s);
  EXPECT_GE(late.samples.back().stamp_s, 12.0);
  const Pose crept = soon.samples.back().T_world_base.inverse() * late.samples.back().T_world_base;
  EXPECT_LT(crept.translation().norm(), 1e-3);
  drive.until_s = 1e9;
  EXPECT_THROW((void)simulate_drive(world, robot_file(), drive), Error);
}

TEST(Drive, PosesComeAtTheirRate) {
  DriveLog log;
  log.samples.resize(2);
  log.samples[1].T_world_base = planar_pose(1.0, 0.0, 0.0);
  log.samples[1].stamp_s = 1.0;
  const std::vector<StampedPose> poses = poses_along(log, 10.0, 0.7);  // 0.7 * 10 is below 7
  ASSERT_EQ(poses.size(), 8u);
  EXPECT_EQ(poses[3].stamp_s, 3 / 10.0);
  EXPECT_NEAR(poses[3].T_world_base.translation().x(), 0.3, 1e-12);
  EXPECT_EQ(poses_along(log, 10.0, 0.7, 5).size(), 5u);
  EXPECT_THROW((void)poses_along(log, 1e9, 1.0), Error);
}

TEST(Drive, PosesBetweenSamplesAreInterpolated) {
  DriveLog log;
  log.samples.resize(2);
  log.samples[0].T_world_base = planar_pose(1.0, 0.0, 0.0);
  log.samples[1].T_world_base = planar_pose(2.0, 1.0, 0.4);
  log.samples[1].stamp_s = 0.02;
  EXPECT_TRUE(pose_at(log, 0.005).isApprox(planar_pose(1.25, 0.25, 0.1), 1e-12));
  EXPECT_TRUE(pose_at(log, -1.0).isApprox(planar_pose(1.0, 0.0, 0.0)));
  EXPECT_TRUE(pose_at(log, 7.0).isApprox(planar_pose(2.0, 1.0, 0.4)));
}

}  // namespace
}  // namespace mapscore::sim::testing
