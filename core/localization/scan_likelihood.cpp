// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#include "core/localization/scan_likelihood.hpp"

#include "core/error.hpp"
#include "core/localization/distance_transform.hpp"
#include "core/localization/scan_parameters.hpp"

#include <cmath>
#include <numbers>

namespace mapscore {
namespace {

/// End point of a beam in the robot's frame, in cells.
struct EndPoint {
  float x, y;
};

std::vector<EndPoint> end_points(const LaserScan& scan, std::size_t count, double resolution_m) {
  std::vector<EndPoint> points;
  for (const Beam& beam : beams_of(scan, count)) {
    if (!beam.hit) continue;
    const Eigen::Vector2d p_base =
        scan.T_base_lidar *
        (beam.range_m * Eigen::Vector2d(std::cos(beam.angle_rad), std::sin(beam.angle_rad)));
    points.push_back({static_cast<float>(p_base.x() / resolution_m),
                      static_cast<float>(p_base.y() / resolution_m)});
  }
  return points;
}

/// Index on an axis of the bordered field: cell + 1, border 0 or size + 1. Truncation is floor
/// here, since what lies below the border is cut off first.
int bordered(float at, float last) {
  const float shifted = at + 1.0f;
  return static_cast<int>(shifted > 0.0f ? (shifted < last ? shifted : last) : 0.0f);
}

}  // namespace

double map_sigma(const GridFrame& frame) {
  return frame.resolution_m / std::sqrt(48.0);
}

LikelihoodField::LikelihoodField(const OccupancyGrid& grid, const LikelihoodFieldParams& params,
                                 double range_max_m)
    : frame_(grid.frame()), params_(params) {
  check_parameters(params, range_max_m);
  const double rand = params.z_rand / range_max_m;
  const double peak = params.z_hit / (params.sigma_hit_m * std::sqrt(2.0 * std::numbers::pi));
  const double per_cell = frame_.resolution_m / params.sigma_hit_m;
  const auto log_p = [&](std::int64_t squared) {
    if (squared == kNoObstacle) return std::log(rand);
    const double squared_sigmas = per_cell * per_cell * static_cast<double>(squared);
    return std::log(peak * std::exp(-0.5 * squared_sigmas) + rand);
  };
  const auto width = static_cast<std::size_t>(frame_.width);
  const auto height = static_cast<std::size_t>(frame_.height);
  log_p_.assign((width + 2) * (height + 2), static_cast<float>(std::log(rand)));
  const std::vector<std::int64_t> squared = squared_distances(grid);
  for (std::size_t row = 0; row < height; ++row)
    for (std::size_t column = 0; column < width; ++column)
      log_p_[(row + 1) * (width + 2) + column + 1] =
          static_cast<float>(log_p(squared[row * width + column]));
}

void LikelihoodField::log_likelihoods(const LaserScan& scan, std::span<const PlanarPose> poses,
                                      std::span<double> results) const {
  const std::vector<EndPoint> points = end_points(scan, params_.beams, frame_.resolution_m);
  const PlanarPose T_grid_map = inverse(frame_.T_map_grid);
  const float last_x = static_cast<float>(frame_.width + 1);
  const float last_y = static_cast<float>(frame_.height + 1);
  const int stride = frame_.width + 2;
  const float* const field = log_p_.data();
  for (std::size_t n = 0; n < poses.size(); ++n) {
    const PlanarPose T = T_grid_map * poses[n];
    const auto x = static_cast<float>(T.x_m / frame_.resolution_m);
    const auto y = static_cast<float>(T.y_m / frame_.resolution_m);
    const auto c = static_cast<float>(std::cos(T.yaw_rad));
    const auto s = static_cast<float>(std::sin(T.yaw_rad));
    double sum = 0.0;
    for (const EndPoint& p : points) {
      const int column = bordered(x + c * p.x - s * p.y, last_x);
      const int row = bordered(y + s * p.x + c * p.y, last_y);
      sum += static_cast<double>(field[row * stride + column]);
    }
    results[n] = params_.temper * sum;
  }
}

}  // namespace mapscore
