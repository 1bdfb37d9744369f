// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#include "eval/localization/filter_run.hpp"

#include "core/error.hpp"
#include "core/random_stream.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <type_traits>
#include <utility>
#include <variant>

namespace mapscore::eval {
namespace {

void check(const FilterSettings& settings) {
  check_ranges(settings.start);
}

/// Of the true start T_true = T_mean Exp(xi): a mean that is off by a draw xi of the sigmas.
PoseEstimate start_estimate(const FilterSettings& settings, const PlanarPose& T_map_base_start,
                            std::uint64_t seed) {
  const Eigen::Vector3d sigmas(settings.start.start_sigma_xy_m, settings.start.start_sigma_xy_m,
                               settings.start.start_sigma_yaw_deg.rad());
  RandomStream draws(seed, "start estimate");
  Vector6 xi = Vector6::Zero();
  xi[0] = sigmas[0] * draws.normal();
  xi[1] = sigmas[1] * draws.normal();
  xi[5] = sigmas[2] * draws.normal();
  return {T_map_base_start * planar(exp_pose(-xi)), sigmas.cwiseAbs2().asDiagonal()};
}

/// What the lidar's noise leaves of its range.
LaserScan scan_frame(const ScanGeometry& geometry, const sim::LidarNoise& noise) {
  LaserScan scan;
  scan.T_base_lidar = planar(geometry.T_base_lidar);
  scan.first_angle_rad = geometry.first_angle_rad;
  scan.angle_step_rad = geometry.angle_step_rad;
  scan.range_min_m = std::max(geometry.range_min_m, noise.range_min_m);
  scan.range_max_m = std::min(geometry.range_max_m, noise.range_max_m);
  return scan;
}

ParticleFilter make_filter(const OccupancyGrid& grid, const FilterSettings& settings,
                           double range_max_m, std::uint64_t seed) {
  auto model = std::visit(
      [&](const auto& params) {
        using Params = std::decay_t<decltype(params)>;
        using Model =
            std::conditional_t<std::is_same_v<Params, BeamModelParams>, BeamModel, LikelihoodField>;
        return std::make_shared<const ScanModel>(Model(grid, params, range_max_m));
      },
      settings.model);
  return {std::move(model), settings.filter, seed};
}

/// Belief of an estimate of T_map_base.
PoseBelief belief_of(const PoseEstimate& estimate, const PlanarPose& T_odom_base) {
  return {spatial(estimate.mean * inverse(T_odom_base)), spatial(T_odom_base),
          spatial_covariance(estimate.covariance)};
}

}  // namespace

void check_start(const OccupancyGrid& grid, const PlanarPose& T_map_base_start,
                 const std::string& grid_name) {
  const PlanarPose& start = T_map_base_start;
  const GridCell cell = grid.cell_of({start.x_m, start.y_m});
  const auto refuse = [&](const std::string& where) {
    throw Error(
        fmt::format("{}: the drive starts at ({:.3f}, {:.3f}) m, {}; give a grid of this scene, in "
                    "its frame, with cells of a few centimetres",
                    grid_name, start.x_m, start.y_m, where));
  };
  if (!grid.contains(cell)) refuse("outside of it");
  if (grid.at(cell) == kOccupiedCell)
    refuse(fmt::format("in the occupied cell {}, {}", cell.column, cell.row));
  if (std::ranges::find(grid.cells(), kOccupiedCell) == grid.cells().end())
    throw Error(grid_name + ": has no occupied cell; give a grid that shows walls");
}

BelievedTrajectory run_filter(const std::vector<OdometryPose>& odometry, const ScanLog& scans,
                              const OccupancyGrid& grid, const FilterSettings& settings,
                              const PlanarPose& T_map_base_start, std::uint64_t seed,
                              const std::function<void(int, int)>& progress) {
  check(settings);
  if (odometry.empty()) throw Error("odometry: has no pose; record the drive again");
  check_start(grid, T_map_base_start, "grid");
  LaserScan scan = scan_frame(scans.geometry, settings.lidar_noise);
  ParticleFilter filter = make_filter(grid, settings, scan.range_max_m, seed);
  if (settings.global_start)
    filter.start_anywhere(grid);
  else
    filter.start_at(start_estimate(settings, T_map_base_start, seed));
  BelievedTrajectory believed{{}, odometry};
  const auto count = static_cast<int>(scans.scans.size());
  const double start_s = odometry.front().stamp_s;
  if (count == 0 || scans.scans.front().stamp_s > start_s)
    believed.entries.push_back(
        {start_s, belief_of(filter.estimate(), planar(odometry.front().T_odom_base))});
  for (int n = 0; n < count; ++n) {
    const StampedScan& turn = scans.scans[static_cast<std::size_t>(n)];
    scan.ranges_m = turn.ranges_m;
    sim::add_lidar_noise(settings.lidar_noise, seed, static_cast<std::uint64_t>(n), scan.ranges_m);
    filter.step(planar(odometry_at(odometry, turn.stamp_s)), scan);
    believed.entries.push_back({turn.stamp_s, filter.belief()});
    if (progress) progress(n + 1, count);
  }
  return believed;
}

}  // namespace mapscore::eval
