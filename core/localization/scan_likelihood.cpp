// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#include "core/localization/scan_likelihood.hpp"

#include "core/error.hpp"

#include <algorithm>
#include <cmath>
#include <initializer_list>
#include <numbers>
#include <optional>
#include <string>

namespace mapscore {
namespace {

void check(const LaserScan& scan) {
  const PlanarPose& T = scan.T_base_lidar;
  if (!(std::isfinite(T.x_m) && std::isfinite(T.y_m) && std::isfinite(T.yaw_rad)))
    throw Error("T_base_lidar: is not finite; give the lidar's mount in metres and radians");
  if (!(std::isfinite(scan.first_angle_rad) && std::isfinite(scan.angle_step_rad)))
    throw Error("scan: its angles are not finite; give first angle and step in radians");
  if (!(scan.range_min_m >= 0 && scan.range_max_m > scan.range_min_m &&
        std::isfinite(scan.range_max_m)))
    throw Error("scan: range " + std::to_string(scan.range_min_m) + " to " +
                std::to_string(scan.range_max_m) + " m; give 0 <= range_min_m < range_max_m");
}

void check_positive(double value, const char* name) {
  if (!(std::isfinite(value) && value > 0))
    throw Error(std::string(name) + ": is " + std::to_string(value) + "; give a number above 0");
}

void check_common(const auto& params, double range_max_m) {
  if (params.beams < 1) throw Error("beams: is 0; use at least one beam of a scan");
  check_positive(params.sigma_hit_m, "sigma_hit_m");
  check_positive(params.temper, "temper");
  check_positive(range_max_m, "range_max_m");
}

/// z_rand must be positive: without it one beam that fits nowhere ends every particle.
void check_shares(std::initializer_list<double> shares, double z_rand) {
  double sum = 0.0;
  for (const double share : shares) {
    if (!(share >= 0 && share <= 1)) throw Error("z_*: the shares of a scan model lie in 0 to 1");
    sum += share;
  }
  if (std::abs(sum - 1.0) > 1e-6)
    throw Error("z_*: the shares of a scan model add up to " + std::to_string(sum) +
                "; make them 1");
  if (z_rand <= 0) throw Error("z_rand: is 0; give a share above 0, some beams fit nothing");
}

void check(const LikelihoodFieldParams& params, double range_max_m) {
  check_common(params, range_max_m);
  check_shares({params.z_hit, params.z_rand}, params.z_rand);
}

void check(const BeamModelParams& params, double range_max_m) {
  check_common(params, range_max_m);
  check_positive(params.lambda_short_per_m, "lambda_short_per_m");
  check_shares({params.z_hit, params.z_short, params.z_max, params.z_rand}, params.z_rand);
  if (params.z_max <= 0)
    throw Error("z_max: is 0; give a share above 0, some beams return nothing");
}

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

double standard_normal_below(double z) {
  return 0.5 * std::erfc(-z / std::numbers::sqrt2);
}

}  // namespace

std::vector<Beam> beams_of(const LaserScan& scan, std::size_t count) {
  check(scan);
  const std::size_t size = scan.ranges_m.size();
  const std::size_t used = std::min(count, size);
  std::vector<Beam> beams;
  beams.reserve(used);
  for (std::size_t n = 0; n < used; ++n) {
    const std::size_t at = n * size / used;
    const double range = scan.ranges_m[at];
    if (!(range >= scan.range_min_m)) continue;  // not a number, too
    const double angle = scan.first_angle_rad + static_cast<double>(at) * scan.angle_step_rad;
    const bool hit = range < scan.range_max_m;
    beams.push_back({angle, hit ? range : scan.range_max_m, hit});
  }
  return beams;
}

LikelihoodField::LikelihoodField(const OccupancyGrid& grid, const LikelihoodFieldParams& params,
                                 double range_max_m)
    : frame_(grid.frame()), params_(params) {
  check(params, range_max_m);
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

BeamModel::BeamModel(const OccupancyGrid& grid, const BeamModelParams& params, double range_max_m)
    : grid_(grid), params_(params), range_max_m_(range_max_m) {
  check(params, range_max_m);
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
