// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#include "core/localization/ray_cast.hpp"
#include "core/localization/scan_likelihood.hpp"
#include "core/localization/scan_parameters.hpp"

#include <cmath>
#include <numbers>
#include <optional>

namespace mapscore {
namespace {

double standard_normal_below(double z) {
  return 0.5 * std::erfc(-z / std::numbers::sqrt2);
}

}  // namespace

BeamModel::BeamModel(const OccupancyGrid& grid, const BeamModelParams& params, double range_max_m)
    : grid_(grid), params_(params), range_max_m_(range_max_m) {
  check_parameters(params, range_max_m);
}

double BeamModel::probability(double range_m, bool hit, double expected_m) const {
  const bool expects_hit = expected_m < range_max_m_;
  if (!hit) return params_.z_max + (expects_hit ? 0.0 : params_.z_hit);
  double p = params_.z_rand / range_max_m_;
  if (expects_hit) {
    const double sigma = params_.sigma_hit_m;
    const double off = (range_m - expected_m) / sigma;
    const double within = standard_normal_below((range_max_m_ - expected_m) / sigma) -
                          standard_normal_below(-expected_m / sigma);
    p += params_.z_hit * std::exp(-0.5 * off * off) /
         (sigma * std::sqrt(2.0 * std::numbers::pi) * within);
  }
  if (range_m <= expected_m && expected_m > 0) {
    const double lambda = params_.lambda_short_per_m;
    p += params_.z_short * lambda * std::exp(-lambda * range_m) / -std::expm1(-lambda * expected_m);
  }
  return p;
}

void BeamModel::log_likelihoods(const LaserScan& scan, std::span<const PlanarPose> poses,
                                std::span<double> results) const {
  const std::vector<Beam> beams = beams_of(scan, params_.beams);
  const double half_cell = 0.5 * grid_.frame().resolution_m;
  for (std::size_t n = 0; n < poses.size(); ++n) {
    const PlanarPose T_map_lidar = poses[n] * scan.T_base_lidar;
    const Eigen::Vector2d from(T_map_lidar.x_m, T_map_lidar.y_m);
    double sum = 0.0;
    for (const Beam& beam : beams) {
      const std::optional<double> entry =
          cast_ray(grid_, from, T_map_lidar.yaw_rad + beam.angle_rad, range_max_m_);
      const double expected = entry ? *entry + half_cell : range_max_m_;
      sum += std::log(probability(beam.range_m, beam.hit, expected));
    }
    results[n] = params_.temper * sum;
  }
}

}  // namespace mapscore
