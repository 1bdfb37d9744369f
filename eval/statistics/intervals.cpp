// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#include "eval/statistics/intervals.hpp"

#include "eval/statistics/mean_interval.hpp"

#include <algorithm>
#include <vector>

namespace mapscore::eval {

const char* name_of(SpreadKind kind) {
  switch (kind) {
    case SpreadKind::range:
      return "range";
    case SpreadKind::interval:
      return "95% interval";
    case SpreadKind::none:
      break;
  }
  return "-";
}

SeedSummary summarise(std::span<const std::optional<double>> values) {
  std::vector<double> defined;
  for (const std::optional<double>& value : values) {
    if (value) defined.push_back(*value);
  }
  SeedSummary summary;
  summary.seeds = static_cast<int>(defined.size());
  summary.undefined = static_cast<int>(values.size() - defined.size());
  if (defined.empty()) return summary;

  summary.kind = SpreadKind::range;
  const auto [least, greatest] = std::minmax_element(defined.begin(), defined.end());
  summary.low = *least;
  summary.high = *greatest;
  summary.mean = defined.front();
  if (defined.size() < 2) return summary;

  const MeanInterval interval = mean_interval(defined);
  summary.mean = interval.mean;
  summary.sd = interval.sd;
  if (summary.seeds < kSeedsForInterval) return summary;
  summary.kind = SpreadKind::interval;
  summary.low = interval.low;
  summary.high = interval.high;
  return summary;
}

}  // namespace mapscore::eval
