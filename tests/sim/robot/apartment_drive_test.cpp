// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#include "sim/robot/drive_simulation.hpp"
#include "tests/sim/robot/drive_scenes.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace mapscore::sim::testing {
namespace {

constexpr double kDegree = M_PI / 180.0;

/// The drive of scenes/README.md, and two thirds of the way back: 30.5 m, over the edges of a rug.
Drive there_and_back() {
  const double places[][3] = {
      {2.813, 4.893, -4},  {2.763, 4.813, -137}, {1.413, 4.737, -38}, {1.027, 2.963, -8},
      {1.143, 1.553, 22},  {2.637, 1.647, -58},  {4.213, 1.837, 24},  {4.277, 3.937, 48},
      {4.307, 2.413, 14},  {4.913, 1.713, -52},  {5.813, 1.607, -87}, {6.393, 1.597, -176},
      {6.893, 1.607, 93},  {7.003, 3.613, 83},   {6.713, 4.663, 142}, {6.413, 4.837, 206},
      {6.413, 4.837, 246}, {6.713, 4.663, 0},    {7.003, 3.613, 0},   {6.893, 1.607, 0},
      {5.813, 1.607, 0},   {4.913, 1.713, 0},    {4.213, 1.837, 0},   {2.637, 1.647, 0},
      {1.143, 1.553, 0},   {1.027, 2.963, 0},    {1.413, 4.737, 0}};
  Drive drive;
  for (const auto& [x, y, yaw] : places) drive.waypoints.push_back({x, y, yaw * kDegree});
  return drive;
}

World apartment() {
  return World::load({std::filesystem::path(MAPSCORE_SOURCE_DIR) / "scenes" / "apartment.xml",
                      std::nullopt, robot_file()},
                     {});
}

TEST(ApartmentDrive, ThirtyMetresReachEveryWaypointAndLeaveDrift) {
  const Drive drive = there_and_back();
  const DriveLog log = simulate_drive(apartment(), robot_file(), drive);
  EXPECT_GT(log.distance_m, 30.0);
  ASSERT_EQ(log.arrivals.size(), drive.waypoints.size());
  for (const WaypointArrival& arrival : log.arrivals) {
    EXPECT_LT(arrival.position_error_m, 0.05) << arrival.waypoint;
    EXPECT_LT(arrival.yaw_error_rad, 3.0 * kDegree) << arrival.waypoint;
  }
  EXPECT_LT(log.health.deepest_wheel_m, 0.002);
  EXPECT_LT(log.health.longest_airborne_s, 0.05);  // a hop off the rug's edge
  EXPECT_LT(log.health.largest_tilt_rad, 6.0 * kDegree);
  EXPECT_EQ(log.health.bump_contacts, 0u);
  const Pose T_world_odom = log.samples.front().T_world_base;
  const Pose error =
      (T_world_odom * log.samples.back().T_odom_base).inverse() * log.samples.back().T_world_base;
  const double drift = error.translation().head<2>().norm() / log.distance_m;
  EXPECT_GT(drift, 0.001);
  EXPECT_LT(drift, 0.10);
  RecordProperty("drift_percent", std::to_string(100.0 * drift));
  for (const DriveSample& sample : log.samples) {
    ASSERT_TRUE(sample.T_world_base.matrix().allFinite());
    ASSERT_LT(std::abs(sample.T_world_base.translation().z()), 0.02);  // the rug is 12 mm thick
  }
}

}  // namespace
}  // namespace mapscore::sim::testing
