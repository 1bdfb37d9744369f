// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#pragma once

#include <cstdint>
#include <span>

namespace mapscore::sim {

/// Noise of a triangulating lidar. The defaults are of the size that the data sheet of the RPLidar
/// A2 gives: about 1 % of the distance, half a millimetre and more near by.
struct LidarNoise {
  double sigma_m = 0.005;         ///< part that does not grow with the distance
  double sigma_per_metre = 0.01;  ///< part that does
  double dropout_rate = 0.01;     ///< share of beams without a measurement
  double range_min_m = 0.15, range_max_m = 12.0;
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
