// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#include "sim/recorder/recorded_drive.hpp"
#include "sim/robot/drive_simulation.hpp"
#include "tests/sim/robot/drive_scenes.hpp"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <string>
#include <vector>

namespace mapscore::sim::testing {
namespace {

using Places = std::vector<std::array<double, 3>>;  ///< x_m, y_m, yaw_deg

/// A scene and a drive of more than 30 m in it.
struct LongWay {
  const char* scene;
  Places places;
};
void PrintTo(const LongWay& way, std::ostream* out) {
  *out << way.scene;
}

// The drives of scenes/README.md; the apartment's and two thirds of the way back: 30.5 m, over the
// edges of a rug.
const LongWay kWays[] = {
    {"apartment",
     {{2.813, 4.893, -4},  {2.763, 4.813, -137}, {1.413, 4.737, -38}, {1.027, 2.963, -8},
      {1.143, 1.553, 22},  {2.637, 1.647, -58},  {4.213, 1.837, 24},  {4.277, 3.937, 48},
      {4.307, 2.413, 14},  {4.913, 1.713, -52},  {5.813, 1.607, -87}, {6.393, 1.597, -176},
      {6.893, 1.607, 93},  {7.003, 3.613, 83},   {6.713, 4.663, 142}, {6.413, 4.837, 206},
      {6.413, 4.837, 246}, {6.713, 4.663, 0},    {7.003, 3.613, 0},   {6.893, 1.607, 0},
      {5.813, 1.607, 0},   {4.913, 1.713, 0},    {4.213, 1.837, 0},   {2.637, 1.647, 0},
      {1.143, 1.553, 0},   {1.027, 2.963, 0},    {1.413, 4.737, 0}}},
    {"home", {{5.413, 1.203, 75},  {5.413, 3.093, 95},  {4.013, 3.093, 205}, {3.897, 1.413, 150},
              {3.613, 0.893, 130}, {3.613, 0.893, 200}, {3.613, 0.893, 8},   {3.897, 1.413, 95},
              {3.977, 3.097, 140}, {3.797, 3.613, 150}, {2.703, 3.653, 170}, {1.603, 3.653, 200},
              {1.603, 3.653, 0},   {2.703, 3.653, 70},  {2.703, 5.103, 160}, {2.447, 6.203, 235},
              {2.447, 6.203, 85},  {2.847, 5.603, 80},  {3.613, 5.393, 115}, {3.613, 5.393, -62},
              {4.013, 5.393, 45},  {5.263, 5.393, 60},  {5.263, 6.403, 75},  {5.263, 4.903, -80},
              {5.413, 3.793, -40}, {6.903, 3.807, 50},  {7.903, 4.093, -30}, {7.903, 4.093, 70},
              {6.913, 3.907, 100}, {6.913, 3.907, -80}, {6.103, 3.793, 180}, {5.413, 3.703, -90},
              {5.413, 1.393, 0},   {6.703, 1.353, 20},  {7.313, 1.253, 50},  {8.003, 1.213, 20},
              {8.003, 1.213, 215}, {8.003, 1.213, 120}}}};

class LongDrive : public ::testing::TestWithParam<LongWay> {
 protected:
  [[nodiscard]] static DriveLog driven() {
    const std::string scene = std::string(GetParam().scene) + ".xml";
    const World world = World::load(
        {std::filesystem::path(MAPSCORE_SOURCE_DIR) / "scenes" / scene, std::nullopt, robot_file()},
        {});
    std::vector<Drive::Waypoint> waypoints;
    for (const auto& [x, y, yaw_deg] : GetParam().places)
      waypoints.push_back({x, y, yaw_deg * kDegree});
    return simulate_drive(world, robot_file(), drive_along(waypoints));
  }
};

TEST_P(LongDrive, ThirtyMetresReachEveryWaypointAndLeaveDrift) {
  const DriveLog log = driven();
  EXPECT_GT(log.distance_m, 30.0);
  ASSERT_EQ(log.arrivals.size(), GetParam().places.size());
  for (const WaypointArrival& arrival : log.arrivals) {
    EXPECT_LT(arrival.position_error_m, 0.05) << arrival.waypoint;
    EXPECT_LT(arrival.yaw_error_rad, 3.0 * kDegree) << arrival.waypoint;
  }
  EXPECT_LT(log.health.deepest_wheel_m, 0.0015);
  EXPECT_LT(log.health.longest_airborne_s, 0.05);  // a hop off the rug's edge
  EXPECT_LT(log.health.largest_tilt_rad, 6.0 * kDegree);
  EXPECT_EQ(log.health.bump_contacts, 0u);
  const Pose T_world_odom = log.samples.front().T_world_base;
  const Pose error =
      (T_world_odom * log.samples.back().T_odom_base).inverse() * log.samples.back().T_world_base;
  const double drift = error.translation().head<2>().norm() / log.distance_m;
  EXPECT_GT(drift, 0.003);
  EXPECT_LT(drift, 0.03);
  RecordProperty("drift_percent", std::to_string(100.0 * drift));
  RecordProperty("deepest_wheel_mm", std::to_string(1000.0 * log.health.deepest_wheel_m));
  for (const DriveSample& sample : log.samples) {
    ASSERT_TRUE(sample.T_world_base.matrix().allFinite());
    ASSERT_LT(std::abs(sample.T_world_base.translation().z()), 0.02);  // the rug is 12 mm thick
  }
}

INSTANTIATE_TEST_SUITE_P(Homes, LongDrive, ::testing::ValuesIn(kWays));

}  // namespace
}  // namespace mapscore::sim::testing
