// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#include "core/error.hpp"
#include "eval/localization/localization_run.hpp"
#include "eval/localization/localization_score.hpp"
#include "eval/truth/floor_grid.hpp"
#include "sim/recorder/recorded_drive.hpp"
#include "sim/robot/drive_simulation.hpp"
#include "sim/sensors/lidar.hpp"
#include "tests/eval/localization/home_drives.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <string>
#include <utility>
#include <vector>

namespace mapscore::eval {
namespace {

/// A drive of 30 m through a home: logs, 5 turns a second, truth at 2 Hz, a grid.
struct HomeDrive {
  std::vector<OdometryPose> odometry;
  ScanLog scans;
  std::vector<TrajectoryPose> truth;
  OccupancyGrid grid;
  double way_m;

  [[nodiscard]] PlanarPose start() const { return planar(truth.front().T_world_base); }
};

constexpr int kJobs = 2;
const double kCell_m = FloorGridOptions{}.resolution_m;

/// Cut on a lattice that is moved against the map's; the grid lies in the map all the same.
OccupancyGrid cut_grid(const std::vector<Shape>& shapes, const Eigen::Vector2d& shift_m,
                       FloorGridOptions options) {
  Pose T_lattice_map = Pose::Identity();
  T_lattice_map.translation().head<2>() = -shift_m;
  options.start_m -= shift_m;
  const OccupancyGrid cut = floor_grid(shapes, T_lattice_map, options);
  GridFrame frame = cut.frame();
  frame.T_map_grid.x_m += shift_m.x();
  frame.T_map_grid.y_m += shift_m.y();
  OccupancyGrid grid(frame);
  for (GridCell cell; cell.row < frame.height; ++cell.row)
    for (cell.column = 0; cell.column < frame.width; ++cell.column) grid.set(cell, cut.at(cell));
  return grid;
}

HomeDrive driven(const std::string& home, const sim::Drive& drive, const Eigen::Vector2d& shift_m,
                 double resolution_m) {
  const auto scenes = std::filesystem::path(MAPSCORE_SOURCE_DIR) / "scenes";
  const sim::World world =
      sim::World::load({scenes / (home + ".xml"), std::nullopt, scenes / "robot.xml"}, {});
  const sim::DriveLog log = sim::simulate_drive(world, scenes / "robot.xml", drive);
  const sim::LidarSettings settings;
  const sim::Lidar lidar(world, settings);
  HomeDrive logs{{}, {}, {}, OccupancyGrid({}), log.distance_m};
  std::vector<sim::StampedPose> turns;
  for (std::size_t n = 0; n < log.samples.size(); ++n) {  // 50 Hz
    const sim::DriveSample& sample = log.samples[n];
    logs.odometry.push_back({sample.stamp_s, sample.T_odom_base});
    if (n % 10 == 0) logs.scans.scans.push_back({sample.stamp_s, {}});
    if (n % 10 == 0) turns.push_back({sample.stamp_s, sample.T_world_base});
    if (n % 25 == 0) logs.truth.push_back({sample.stamp_s, sample.T_world_base});
  }
  auto ranges = lidar.scans(turns, kJobs);
  for (std::size_t n = 0; n < ranges.size(); ++n)
    logs.scans.scans[n].ranges_m = std::move(ranges[n]);
  logs.scans.geometry = {settings.first_angle_rad, lidar.angle_step_rad(), settings.range_min_m,
                         settings.range_max_m, lidar.T_base_lidar()};
  FloorGridOptions options;
  options.height_m = lidar.T_base_lidar().translation().z();
  options.start_m = logs.truth.front().T_world_base.translation().head<2>();
  options.jobs = kJobs;
  options.resolution_m = resolution_m;
  logs.grid = cut_grid(world.shapes(), shift_m, options);
  return logs;
}

/// The bars of the project, for one run; returns the share of frames whose NEES lies in the band.
double localised_share(const HomeDrive& drive, const FilterSettings& settings, std::uint64_t seed) {
  const BelievedTrajectory believed =
      run_filter(drive.odometry, drive.scans, drive.grid, settings, drive.start(), seed);
  const LocalizationScore score = score_localization(believed, drive.truth);
  EXPECT_LT(score.converged_s.value(), 10.0);
  EXPECT_LT(score.position_m.mean, 0.05);
  EXPECT_LT(score.heading_deg.mean, 2.0);
  EXPECT_LT(score.position_m.max, 0.10);
  EXPECT_GE(score.nees_share.value(), 0.80);
  return *score.nees_share;
}

void expect_better_than_odometry(const HomeDrive& drive) {
  EXPECT_GT(drive.way_m, 30.0);
  const BelievedTrajectory believed = odometry_only(drive.odometry, drive.start(), {});
  EXPECT_GT(score_localization(believed, drive.truth).position_m.max, 0.10);
}

void expect_found_from_both_starts(const HomeDrive& drive) {
  expect_better_than_odometry(drive);
  FilterSettings settings;
  settings.filter.jobs = kJobs;
  const double tracking = localised_share(drive, settings, 1);
  settings.global_start = true;
  const double global = localised_share(drive, settings, 3);
  EXPECT_GE(0.5 * (tracking + global), 0.85);
}

// On a lattice that lies elsewhere within its cells than the map's.
TEST(HomeLocalization, FiltersThroughTheHome) {
  expect_found_from_both_starts(driven("home", testing::home_drive(), {0.0127, 0.0035}, kCell_m));
}

TEST(HomeLocalization, FiltersThroughTheCottage) {
  expect_found_from_both_starts(driven("cottage", testing::cottage_drive(), {0.0, 0.0}, kCell_m));
}

TEST(HomeLocalization, BeamModelTracksAndSeedsRepeat) {
  sim::Drive begin = testing::cottage_drive();
  begin.waypoints.resize(3);
  const HomeDrive drive = driven("cottage", begin, {0.0, 0.0}, 0.05);
  FilterSettings settings;
  settings.model = BeamModelParams{};
  const auto text = [&](std::uint64_t seed, int jobs) {
    settings.filter.jobs = jobs;
    const BelievedTrajectory believed =
        run_filter(drive.odometry, drive.scans, drive.grid, settings, drive.start(), seed);
    EXPECT_LT(score_localization(believed, drive.truth).position_m.mean, 0.05);
    return believed.entries.back().belief.T_map_odom.matrix();
  };
  const Eigen::Matrix4d once = text(7, 1);
  EXPECT_EQ(once, text(7, 2));
  EXPECT_NE(once, text(8, 1));
}

TEST(HomeLocalization, RefusesAStartInAWallAndLogsThatDoNotMeet) {
  const OccupancyGrid wall({0.05, {}, 20, 20}, kOccupiedCell);
  ScanLog scans;
  scans.geometry = {0.0, 0.1, 0.15, 12.0, Pose::Identity()};
  scans.scans = {{5.0, {1.0f, 2.0f}}};
  const std::vector<OdometryPose> odometry = {{0.0, Pose::Identity()}, {0.1, Pose::Identity()}};
  EXPECT_THROW((void)run_filter(odometry, scans, wall, {}, {0.5, 0.5, 0}, 1), Error);
  const OccupancyGrid room({0.05, {}, 20, 20}, kFreeCell);
  EXPECT_THROW((void)run_filter(odometry, scans, room, {}, {0.5, 0.5, 0}, 1), Error);
  EXPECT_THROW((void)run_filter({}, scans, room, {}, {0.5, 0.5, 0}, 1), Error);
}

}  // namespace
}  // namespace mapscore::eval
