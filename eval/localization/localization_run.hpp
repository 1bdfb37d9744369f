// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#pragma once

#include "core/localization/odometry_motion.hpp"
#include "core/localization/particle_filter.hpp"
#include "eval/localization/believed_trajectory.hpp"
#include "eval/recording/scan_file.hpp"
#include "eval/recording/stamp_list.hpp"
#include "sim/faults/lidar_noise.hpp"

#include <cstdint>
#include <functional>
#include <string>
#include <variant>
#include <vector>

namespace mapscore::eval {

/// Dead reckoning: T_map_odom as the true start gives it, throughout. One entry a line of the
/// odometry, whose covariance grows from 0: over each motion D of 5 cm or 0.05 rad it becomes
/// Ad C Ad^T + Q, Ad the adjoint of D^-1 and Q the covariance of the motion model.
/// T_map_base_start: true pose at the first line. Throws Error when there is no line, or an alpha
/// is negative.
[[nodiscard]] BelievedTrajectory odometry_only(const std::vector<OdometryPose>& odometry,
                                               const PlanarPose& T_map_base_start,
                                               const OdometryNoise& noise);

/// How far off the true start a tracking filter begins.
struct StartSpread {
  double start_sigma_xy_m = 0.1;
  Degrees start_sigma_yaw_deg{2.864788975654116};  ///< 0.05 rad

  static void fields(auto& s, auto&& visit) {
    visit(s.start_sigma_xy_m, Field{"start_sigma_xy_m",
                                    "standard deviation of the start, x and y; default 0.1",
                                    {0, 10}});
    visit(s.start_sigma_yaw_deg, Field{"start_sigma_yaw_deg",
                                       "standard deviation of the start's heading; default 2.9",
                                       {0, 180}});
  }
  bool operator==(const StartSpread&) const = default;
};

/// How a drive is localised anew from its logs.
struct FilterSettings {
  ParticleFilterParams filter;
  std::variant<LikelihoodFieldParams, BeamModelParams> model;
  /// False: tracking, from an estimate that is off the true start by a draw of the start sigmas.
  /// True: from anywhere on the grid's free cells.
  bool global_start = false;
  StartSpread start;
  /// Added to the recording's noise-free turns.
  sim::LidarNoise lidar_noise = sim::LidarNoise::of(sim::LidarPreset::rplidar_a2);
};

/// Throws Error, beginning with the grid's name, where a drive would start in an occupied cell.
void check_start(const OccupancyGrid& grid, const PlanarPose& T_map_base_start,
                 const std::string& grid_name);

/// Replays the particle filter over the turns of a drive, one step a turn, with the odometry at the
/// turn's stamp. T_map_base_start: true pose at the first line of the odometry, where the first
/// entry says the start estimate; then one entry a turn. Start, noise and filter draw from streams
/// named by `seed`: same input and seed, same bytes, whatever the filter's `jobs`. `progress(turns
/// done, all)`. Throws Error when a parameter is out of range, when the odometry does not reach a
/// turn, or when tracking would start in an occupied cell.
[[nodiscard]] BelievedTrajectory run_filter(const std::vector<OdometryPose>& odometry,
                                            const ScanLog& scans, const OccupancyGrid& grid,
                                            const FilterSettings& settings,
                                            const PlanarPose& T_map_base_start, std::uint64_t seed,
                                            const std::function<void(int, int)>& progress = {});

}  // namespace mapscore::eval
