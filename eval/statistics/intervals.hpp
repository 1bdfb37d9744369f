// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#pragma once

#include <array>
#include <cstddef>
#include <limits>
#include <optional>
#include <span>

namespace mapscore::eval {

/// Fewer seeds than this give a range in place of an interval.
inline constexpr int kSeedsForInterval = 10;

/// Name of the interval's method in captions.
inline constexpr const char* kIntervalMethod =
    "the farther of Student t and Hall's skewness-corrected t on each side";

enum class SpreadKind {
  none,      ///< nothing defined to summarise
  range,     ///< least and greatest value; fewer than kSeedsForInterval
  interval,  ///< 95 % interval of the mean, by mean_interval
};

[[nodiscard]] constexpr const char* name_of(SpreadKind kind) {
  return std::array{"-", "range", "95% interval"}.at(static_cast<std::size_t>(kind));
}

/// One figure over the seeds of a study.
struct SeedSummary {
  SpreadKind kind = SpreadKind::none;
  int seeds = 0;      ///< with a defined value
  int undefined = 0;  ///< seeds whose value is undefined; left out
  std::optional<double> mean;
  std::optional<double> sd;         ///< with n - 1; needs two seeds
  std::optional<double> low, high;  ///< of the range or interval
};

/// What a figure can be at all, and so its mean.
struct ValueLimits {
  double low = -std::numeric_limits<double>::infinity();
  double high = std::numeric_limits<double>::infinity();
};

/// Summary of one figure, one value a seed; nullopt where it is undefined. The interval is cut off
/// at the limits, within which the mean lies, so that its coverage stays.
[[nodiscard]] SeedSummary summarise(std::span<const std::optional<double>> values,
                                    const ValueLimits& limits = {});

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

/// P(T <= t) of Student's distribution with `degrees` >= 1 degrees of freedom, by the finite
/// trigonometric series for whole degrees (Abramowitz and Stegun 26.7.3 and 26.7.4).
[[nodiscard]] double student_t_cdf(double t, int degrees);

/// t with student_t_cdf(t, degrees) = p. Throws Error unless 0 < p < 1 and degrees >= 1.
[[nodiscard]] double student_t_quantile(double p, int degrees);

}  // namespace mapscore::eval
