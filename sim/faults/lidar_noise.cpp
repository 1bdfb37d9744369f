// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#include "sim/faults/lidar_noise.hpp"

#include "core/error.hpp"
#include "core/random_stream.hpp"

#include <cmath>
#include <limits>

namespace mapscore::sim {
namespace {

void check(const LidarNoise& noise) {
  check_ranges(noise);
  if (noise.dropout_rate > 1)
    throw Error("faults: lidar noise: dropout_rate must lie between 0 and 1");
  if (!(noise.range_min_m >= 0 && noise.range_max_m > noise.range_min_m))
    throw Error("faults: lidar noise: give 0 <= range_min_m < range_max_m");
}

float corrupted(const LidarNoise& noise, double range_m, double chance, double normal) {
  if (range_m == 0.0 || chance < noise.dropout_rate) return 0.0f;
  if (std::isinf(range_m)) return static_cast<float>(range_m);
  const double sigma_m = std::hypot(noise.sigma_m, noise.sigma_per_metre * range_m);
  if (sigma_m == 0.0) return static_cast<float>(range_m);
  const double noisy_m = range_m + sigma_m * normal;
  if (noisy_m < noise.range_min_m) return 0.0f;
  if (noisy_m > noise.range_max_m) return std::numeric_limits<float>::infinity();
  return static_cast<float>(noisy_m);
}

}  // namespace

void add_lidar_noise(const LidarNoise& noise, std::uint64_t seed, std::uint64_t scan,
                     std::span<float> ranges_m) {
  check(noise);
  RandomStream stream(seed, "lidar_noise", {scan});
  for (float& range_m : ranges_m) {
    const double chance = stream.uniform();
    range_m = corrupted(noise, range_m, chance, stream.normal());
  }
}

}  // namespace mapscore::sim
