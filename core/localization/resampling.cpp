// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#include "core/localization/resampling.hpp"

#include "core/geometry/voxel.hpp"

#include <algorithm>
#include <cmath>
#include <unordered_set>

namespace mapscore {
namespace {

VoxelKey bin_of(const PlanarPose& pose, const KldParams& params) {
  const auto bin = [](double at, double edge) {
    return static_cast<std::int32_t>(std::floor(at / edge));
  };
  return {bin(pose.x_m, params.bin_m), bin(pose.y_m, params.bin_m),
          bin(wrapped_angle(pose.yaw_rad), params.bin_rad)};
}

}  // namespace

std::size_t kld_bound(std::size_t bins, const KldParams& params) {
  if (bins <= 1) return params.min_particles;
  const auto degrees = static_cast<double>(bins - 1);
  const double a = 2.0 / (9.0 * degrees);
  const double root = 1.0 - a + std::sqrt(a) * params.z_quantile;
  const double bound = std::ceil(degrees / (2.0 * params.epsilon) * root * root * root);
  return static_cast<std::size_t>(std::clamp(bound, static_cast<double>(params.min_particles),
                                             static_cast<double>(params.max_particles)));
}

std::size_t kld_particles(std::span<const PlanarPose> poses, std::span<const double> weights,
                          const KldParams& params, RandomStream& stream) {
  std::vector<double> below(weights.size());
  double sum = 0.0;
  for (std::size_t n = 0; n < weights.size(); ++n) below[n] = (sum += weights[n]);
  std::unordered_set<VoxelKey> bins;
  std::size_t drawn = 0;
  for (std::size_t wanted = params.min_particles; drawn < wanted; ++drawn) {
    const double u = stream.uniform() * sum;
    const auto at = std::upper_bound(below.begin(), below.end(), u) - below.begin();
    const std::size_t pick = std::min(static_cast<std::size_t>(at), poses.size() - 1);
    if (bins.insert(bin_of(poses[pick], params)).second) wanted = kld_bound(bins.size(), params);
  }
  return drawn;
}

std::vector<std::size_t> low_variance_picks(std::span<const double> weights, std::size_t count,
                                            double offset) {
  std::vector<std::size_t> picks;
  picks.reserve(count);
  const double per_tooth = 1.0 / static_cast<double>(count);
  std::size_t at = 0;
  double below = weights.empty() ? 0.0 : weights[0];
  for (std::size_t tooth = 0; tooth < count; ++tooth) {
    const double u = (static_cast<double>(tooth) + offset) * per_tooth;
    while (u >= below && at + 1 < weights.size()) below += weights[++at];
    picks.push_back(at);
  }
  return picks;
}

double effective_sample_size(std::span<const double> weights) {
  double sum = 0.0, squares = 0.0;
  for (const double w : weights) {
    sum += w;
    squares += w * w;
  }
  return sum * sum / squares;
}

std::vector<double> normalised_weights(std::span<const double> log_weights) {
  const double top = *std::max_element(log_weights.begin(), log_weights.end());
  std::vector<double> weights(log_weights.size());
  double sum = 0.0;
  for (std::size_t n = 0; n < weights.size(); ++n)
    sum += weights[n] = std::exp(log_weights[n] - top);
  for (double& w : weights) w /= sum;
  return weights;
}

}  // namespace mapscore
