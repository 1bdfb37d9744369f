// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#pragma once

#include <optional>
#include <string>

namespace mapscore::eval {

// Part of a study, in its units; see study.hpp. Keys, ranges and meanings stand in
// localization_fields.hpp.

/// Where a trial's believed poses come from.
enum class PoseSource {
  gaussian,         ///< the true pose moved by faults.pose; the true one where that has no dose
  truth,            ///< the true pose, whatever faults.pose says
  odometry,         ///< dead reckoning by the wheels, from the true pose at the start
  particle_filter,  ///< odometry and lidar on a grid of the home
  trajectory        ///< a file
};

/// How the particle filter starts: about the true pose, or anywhere on the grid.
enum class FilterStart { tracking, global };

enum class ScanModelKind { likelihood_field, beam };

/// What is not set is as the core's OdometryNoise has it.
struct OdometryNoiseSettings {
  std::optional<double> alpha1, alpha2, alpha3, alpha4;

  bool operator==(const OdometryNoiseSettings&) const = default;
};

/// What is not set is as FilterSettings has it.
struct ParticleFilterSettings {
  FilterStart start = FilterStart::tracking;
  std::optional<double> start_sigma_xy_m, start_sigma_yaw_deg;
  std::optional<int> least_particles, most_particles;
  std::optional<double> kld_epsilon;
  std::optional<double> update_way_m, update_turn_deg;
  ScanModelKind scan_model = ScanModelKind::likelihood_field;
  std::optional<int> beams;
  std::optional<double> sigma_hit_m, temper;

  bool operator==(const ParticleFilterSettings&) const = default;
};

struct LocalizationSettings {
  PoseSource source = PoseSource::gaussian;
  std::optional<std::string> trajectory;  ///< of source trajectory
  std::optional<std::string> grid;        ///< empty: cut from the truth at the lidar's height
  std::optional<double> grid_resolution_m;
  OdometryNoiseSettings odometry_noise;
  ParticleFilterSettings filter;

  bool operator==(const LocalizationSettings&) const = default;
};

/// A lidar that a study may use as it is.
enum class LidarPreset { ideal, rplidar_a2 };

/// A ready-made lidar, and what differs from it; members as those of sim::LidarNoise.
struct LidarFaultSettings {
  LidarPreset preset = LidarPreset::ideal;
  double scale = 1;  ///< of every dose
  std::optional<double> sigma_m, sigma_per_metre, dropout_rate;

  bool operator==(const LidarFaultSettings&) const = default;
};

}  // namespace mapscore::eval
