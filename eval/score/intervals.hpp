// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#pragma once

#include <optional>
#include <span>

namespace mapscore::eval {

/// Fewer seeds than this give a range in place of an interval.
inline constexpr int kSeedsForInterval = 10;

enum class SpreadKind {
  none,       ///< nothing defined to summarise
  range,      ///< least and greatest value; fewer than kSeedsForInterval
  student_t,  ///< 95 % interval of the mean: mean +- t(0.975, n - 1) sd / sqrt(n)
};

[[nodiscard]] const char* name_of(SpreadKind kind);

/// One figure over the seeds of a study.
struct SeedSummary {
  SpreadKind kind = SpreadKind::none;
  int seeds = 0;      ///< with a defined value
  int undefined = 0;  ///< seeds whose value is undefined; left out
  std::optional<double> mean;
  std::optional<double> sd;  ///< with n - 1; needs two seeds
  std::optional<double> low,
      high;  ///< of the range or interval; not clipped to what the figure can be
};

/// Summary of one figure, one value a seed; nullopt where it is undefined.
[[nodiscard]] SeedSummary summarise(std::span<const std::optional<double>> values);

/// P(T <= t) of Student's distribution with `degrees` >= 1 degrees of freedom, by the finite
/// trigonometric series for whole degrees (Abramowitz and Stegun 26.7.3 and 26.7.4).
[[nodiscard]] double student_t_cdf(double t, int degrees);

/// t with student_t_cdf(t, degrees) = p. Throws Error unless 0 < p < 1 and degrees >= 1.
[[nodiscard]] double student_t_quantile(double p, int degrees);

}  // namespace mapscore::eval
