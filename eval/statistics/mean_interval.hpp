// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#pragma once

#include <span>

namespace mapscore::eval {

/// What one value a seed says of the mean over all seeds.
struct MeanInterval {
  double mean = 0.0;
  double sd = 0.0;               ///< with n - 1
  double low = 0.0, high = 0.0;  ///< 95 % interval of the mean; not clipped to what values can be
};

/// Mean of finite `values` (at least two) and, on each side, the farther of two limits:
///   Student t              mean +- x s,    x = t(0.975, n - 1) / sqrt(n)
///   Hall's transformation  mean - s T,     T + g T^2 / 3 + g^2 T^3 / 27 + g / (6 n) = x and -x,
/// g the skewness of the sample (third central moment by the 1.5th power of the second, both with
/// 1 / n). The cubic is monotone, so each T is unique. Equal values: all of it is that value, sd 0.
/// Closed form, no resampling; mirrored values give the mirrored interval. Throws Error for fewer
/// than two values. Its coverage, with the methods it was chosen from: docs/metrics.md.
[[nodiscard]] MeanInterval mean_interval(std::span<const double> values);

}  // namespace mapscore::eval
