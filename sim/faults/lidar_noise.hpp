// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#pragma once

#include "core/parameters.hpp"

#include <array>
#include <cstdint>
#include <span>
#include <string_view>

namespace mapscore::sim {

/// Ready-made lidars.
enum class LidarPreset { ideal, rplidar_a2 };
constexpr auto names_of(LidarPreset) {
  return std::to_array<std::string_view>({"ideal", "rplidar_a2"});
}

/// Noise of a triangulating lidar. The preset rplidar_a2 has the size that the data sheet of the
/// RPLidar A2 gives, 1 % of the range, with 5 mm added in quadrature, and 1 % dropouts.
struct LidarNoise {
  using Preset = LidarPreset;
  static constexpr Field kPreset{.key = "preset",
                                 .meaning = "lidar that the other keys start from; ideal: no fault",
                                 .later = true};
  static constexpr Field kScale{
      .key = "scale", .meaning = "multiplies every dose", .range = {0, 100}, .later = true};

  double sigma_m = 0, sigma_per_metre = 0, dropout_rate = 0;
  double range_min_m = 0.15, range_max_m = 12.0;  ///< of the lidar, which reports nothing beyond

  [[nodiscard]] static LidarNoise of(LidarPreset preset) {
    return preset == LidarPreset::ideal ? LidarNoise{} : LidarNoise{0.005, 0.01, 0.01};
  }

  static void fields(auto& s, auto&& visit) {
    const auto dose = [&](auto& member, std::string_view key, std::string_view meaning,
                          double most) {
      visit(member, Field{.key = key, .meaning = meaning, .range = {0, most}, .dose = true});
    };
    dose(s.sigma_m, "sigma_m", "standard deviation of a range, the part that does not grow", 10);
    dose(s.sigma_per_metre, "sigma_per_metre", "standard deviation of a range by the range", 1);
    dose(s.dropout_rate, "dropout_rate", "share of beams without a measurement", 1);
  }
  bool operator==(const LidarNoise&) const = default;
};

/// Corrupts one turn in place, on replay:
///
///   r' = r + sqrt(sigma_m^2 + (sigma_per_metre r)^2) n,   n ~ N(0, 1)
///
/// then 0 with probability dropout_rate (of beams that hit nothing, too), 0 below range_min_m,
/// infinity above range_max_m. Ranges of 0 (no measurement) stay. The draws of a beam are named by
/// (seed, "lidar_noise", scan), do not depend on the doses, and doses of zero change no bit. Throws
/// Error when a dose is negative, not finite, or a rate above 1.
void add_lidar_noise(const LidarNoise& noise, std::uint64_t seed, std::uint64_t scan,
                     std::span<float> ranges_m);

}  // namespace mapscore::sim
