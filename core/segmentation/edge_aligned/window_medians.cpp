// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#include "core/segmentation/edge_aligned/window_medians.hpp"

#include "core/wide_vectors.hpp"

#include <algorithm>

namespace mapscore {
namespace {

constexpr std::size_t kWindows = WindowValues::kWindows;
constexpr float kNoValue = WindowValues::kNone;
using Row = WindowValues::Row;
using Counts = std::array<int, kWindows>;

/// Of each window two values between which the median lies, themselves included.
struct Brackets {
  Row low, high;
  Counts below, until;  ///< how many values are less than low, and at most high
};

/// The least and the largest value of each window, between which all lie.
MAPSCORE_WIDE_VECTORS
Brackets all_values(const WindowValues& values) {
  Brackets brackets;
  brackets.below = brackets.until = {};
  brackets.low.fill(kNoValue);
  brackets.high.fill(-kNoValue);
  for (const Row& row : values.at)
    for (std::size_t n = 0; n < kWindows; ++n) {
      const float value = row[n];
      const float known = value < kNoValue ? value : -kNoValue;
      brackets.low[n] = std::min(brackets.low[n], value);
      brackets.high[n] = std::max(brackets.high[n], known);
      brackets.until[n] += value < kNoValue ? 1 : 0;
    }
  return brackets;
}

/// Splits the values of each window at a pivot: how many are at most as large, the largest of these
/// and the least of the others.
struct Split {
  Counts count{};
  Row largest, least;
};

MAPSCORE_WIDE_VECTORS
Split split_at(const WindowValues& values, const Row& pivots) {
  Split split;
  split.largest.fill(-kNoValue);
  split.least.fill(kNoValue);
  for (const Row& row : values.at)
    for (std::size_t n = 0; n < kWindows; ++n) {
      const float value = row[n];
      const float under = value <= pivots[n] ? value : -kNoValue;
      const float over = value <= pivots[n] ? kNoValue : value;
      split.count[n] += value <= pivots[n] ? 1 : 0;
      split.largest[n] = std::max(split.largest[n], under);
      split.least[n] = std::min(split.least[n], over);
    }
  return split;
}

/// Where the medians may lie, were the values spread evenly, or half-way. Never at the highest
/// while others are left, so that each split leaves at least one value fewer.
MAPSCORE_WIDE_VECTORS
Row pivots_of(const Brackets& brackets, const Counts& ranks, bool half_way) {
  Row pivots;
  for (std::size_t n = 0; n < kWindows; ++n) {
    const float low = brackets.low[n], high = brackets.high[n];
    const float wanted = static_cast<float>(ranks[n] - brackets.below[n]) + 0.5F;
    const float all = static_cast<float>(brackets.until[n] - brackets.below[n]);
    const float share = wanted / all;
    const float pivot = low + (half_way ? 0.5F : share) * (high - low);
    pivots[n] = pivot < high ? pivot : low;
  }
  return pivots;
}

/// Leaves the values on the median's side of each split; whether some brackets still hold several.
/// A bracket that is closed stays so.
MAPSCORE_WIDE_VECTORS
bool narrow(const Split& split, const Counts& ranks, Brackets& brackets) {
  auto& [lows, highs, all_below, all_until] = brackets;
  int open = 0;
  for (std::size_t n = 0; n < kWindows; ++n) {
    const int rank = ranks[n], count = split.count[n];
    const bool is_under = count > rank;
    const float low = is_under ? lows[n] : split.least[n];
    const float high = is_under ? split.largest[n] : highs[n];
    const int below = is_under ? all_below[n] : count, until = is_under ? count : all_until[n];
    const float only_low = until == rank + 1 ? high : low;    // the median is the highest left,
    const float only_high = below == rank ? only_low : high;  // or the lowest
    lows[n] = only_low, highs[n] = only_high, all_below[n] = below, all_until[n] = until;
    open |= only_low < only_high ? 1 : 0;
  }
  return open != 0;
}

}  // namespace

WindowValues::Row medians_of(const WindowValues& values) {
  Brackets brackets = all_values(values);
  const Counts counts = brackets.until;
  Counts ranks;
  for (std::size_t n = 0; n < kWindows; ++n) ranks[n] = counts[n] / 2;
  for (bool is_open = true, half_way = false; is_open; half_way = !half_way)
    is_open = narrow(split_at(values, pivots_of(brackets, ranks, half_way)), ranks, brackets);
  for (std::size_t n = 0; n < kWindows; ++n)
    if (counts[n] == 0) brackets.low[n] = 0.0F;
  return brackets.low;
}

}  // namespace mapscore
