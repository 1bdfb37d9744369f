// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#include "eval/localization/localization_run.hpp"

#include "core/error.hpp"
#include "core/random_stream.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <type_traits>
#include <utility>

namespace mapscore::eval {
namespace {

/// Variances of the motion model go with the square of a motion, so its size is fixed: that of the
/// particle filter's updates.
constexpr double kStepWay = 0.05, kStepTurn = 0.05;

bool is_step(const PlanarPose& T_before_after) {
  return std::hypot(T_before_after.x_m, T_before_after.y_m) >= kStepWay ||
         std::abs(T_before_after.yaw_rad) >= kStepTurn;
}

/// Covariance after a motion, x y yaw in the robot's axes.
Eigen::Matrix3d grown(const Eigen::Matrix3d& covariance, const PlanarPose& T_before_after,
                      const OdometryNoise& noise) {
  const OdometryMotion motion = motion_parts(T_before_after, noise.least_way_m);
  const Eigen::Matrix3d carry = adjoint(inverse(T_before_after));
  return carry * covariance * carry.transpose() +
         motion_covariance(motion, motion_sigmas(motion, noise));
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
  return {planar(geometry.T_base_lidar),
          geometry.first_angle_rad,
          geometry.angle_step_rad,
          std::max(geometry.range_min_m, noise.range_min_m),
          std::min(geometry.range_max_m, noise.range_max_m),
          {}};
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

BelievedTrajectory odometry_only(const std::vector<OdometryPose>& odometry,
                                 const PlanarPose& T_map_base_start, const OdometryNoise& noise) {
  if (odometry.empty()) throw Error("odometry: has no pose; record the drive again");
  PlanarPose T_odom_last = planar(odometry.front().T_odom_base);
  const Pose T_map_odom = spatial(T_map_base_start * inverse(T_odom_last));
  Eigen::Matrix3d last = Eigen::Matrix3d::Zero();
  BelievedTrajectory believed{{}, odometry};
  for (const OdometryPose& pose : odometry) {
    const PlanarPose T_odom_base = planar(pose.T_odom_base);
    const PlanarPose T_last_base = inverse(T_odom_last) * T_odom_base;
    const Eigen::Matrix3d covariance = grown(last, T_last_base, noise);
    believed.entries.push_back(
        {pose.stamp_s, {T_map_odom, pose.T_odom_base, spatial_covariance(covariance)}});
    if (!is_step(T_last_base)) continue;
    last = covariance;
    T_odom_last = T_odom_base;
  }
  return believed;
}

void check_start(const OccupancyGrid& grid, const PlanarPose& T_map_base_start,
                 const std::string& grid_name) {
  const GridCell cell = grid.cell_of({T_map_base_start.x_m, T_map_base_start.y_m});
  const auto refuse = [&](const std::string& where) {
    throw Error(
        fmt::format("{}: the drive starts at ({:.3f}, {:.3f}) m, {}; give a grid of this scene, in "
                    "its frame, with cells of a few centimetres",
                    grid_name, T_map_base_start.x_m, T_map_base_start.y_m, where));
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
  check_ranges(settings.start);
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
