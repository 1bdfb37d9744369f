// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#pragma once

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

[[nodiscard]] const char* name_of(SpreadKind kind);

/// One figure over the seeds of a study.
struct SeedSummary {
  SpreadKind kind = SpreadKind::none;
  int seeds = 0;      ///< with a defined value
  int undefined = 0;  ///< seeds whose value is undefined; left out
  std::optional<double> mean;
  std::optional<double> sd;         ///< with n - 1; needs two seeds
  std::optional<double> low, high;  ///< of the range or interval
};

/// Summary of one figure, one value a seed; nullopt where it is undefined.
[[nodiscard]] SeedSummary summarise(std::span<const std::optional<double>> values);

}  // namespace mapscore::eval
