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

/// The least and the largest value of each window.
MAPSCORE_WIDE_VECTORS
Brackets all_values(const WindowValues& values) {
  Brackets brackets;
  brackets.below = {};
  brackets.until = values.counts;
  brackets.low.fill(kNoValue);
  brackets.high.fill(-kNoValue);
  for (const Row& row : values.at)
    for (std::size_t n = 0; n < kWindows; ++n) {
      const float value = row[n];
      const float known = value < kNoValue ? value : -kNoValue;
      brackets.low[n] = std::min(brackets.low[n], value);
      brackets.high[n] = std::max(brackets.high[n], known);
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
Row pivots_of(const Brackets& brackets, const Counts& ranks, bool half_way) {
  Row pivots;
  for (std::size_t n = 0; n < kWindows; ++n) {
    const float low = brackets.low[n], high = brackets.high[n];
    const float wanted = static_cast<float>(ranks[n] - brackets.below[n]) + 0.5F;
    const float all = static_cast<float>(brackets.until[n] - brackets.below[n]);
    const float pivot = low + (half_way ? 0.5F : wanted / all) * (high - low);
    pivots[n] = pivot < high ? pivot : low;
  }
  return pivots;
}

}  // namespace

WindowValues::Row medians_of(const WindowValues& values) {
  Counts ranks;
  for (std::size_t n = 0; n < kWindows; ++n) ranks[n] = values.counts[n] / 2;
  Brackets brackets = all_values(values);
  auto& [low, high, below, until] = brackets;
  const auto is_open = [&] {
    for (std::size_t n = 0; n < kWindows; ++n)
      if (low[n] < high[n]) return true;
    return false;
  };
  for (int round = 1; is_open(); ++round) {
    const Split split = split_at(values, pivots_of(brackets, ranks, round % 3 == 0));
    for (std::size_t n = 0; n < kWindows; ++n) {
      if (split.count[n] > ranks[n])
        high[n] = split.largest[n], until[n] = split.count[n];
      else
        low[n] = split.least[n], below[n] = split.count[n];
      if (until[n] == ranks[n] + 1) low[n] = high[n];  // found: the bracket stays closed
      if (below[n] == ranks[n]) high[n] = low[n];
    }
  }
  for (std::size_t n = 0; n < kWindows; ++n)
    if (values.counts[n] == 0) low[n] = 0.0F;
  return low;
}

}  // namespace mapscore
