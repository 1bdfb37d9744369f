// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <span>
#include <tuple>
#include <vector>

namespace mapscore::eval {

/// Elements of two lists that belong together.
struct Association {
  std::size_t first = 0, second = 0;
  bool operator==(const Association&) const = default;
};

/// Pairs of stamps that are less than `max_offset_s` apart, each stamp in one pair at most, the
/// nearest pairs first, as the TUM benchmark associates its images; ties to the earlier stamps.
/// Both lists ascend. Ascending by `first`.
[[nodiscard]] inline std::vector<Association> associate(std::span<const double> first_s,
                                                        std::span<const double> second_s,
                                                        double max_offset_s) {
  std::vector<std::tuple<double, std::size_t, std::size_t>> near;  // offset, first, second
  std::size_t begin = 0;
  for (std::size_t a = 0; a < first_s.size(); ++a) {
    while (begin < second_s.size() && second_s[begin] <= first_s[a] - max_offset_s) ++begin;
    for (std::size_t b = begin; b < second_s.size() && second_s[b] - first_s[a] < max_offset_s; ++b)
      near.emplace_back(std::abs(second_s[b] - first_s[a]), a, b);
  }
  std::sort(near.begin(), near.end());
  std::vector<bool> first_taken(first_s.size()), second_taken(second_s.size());
  std::vector<Association> pairs;
  for (const auto& [offset, a, b] : near) {
    if (first_taken[a] || second_taken[b]) continue;
    first_taken[a] = second_taken[b] = true;
    pairs.push_back({a, b});
  }
  std::ranges::sort(pairs, {}, &Association::first);
  return pairs;
}

}  // namespace mapscore::eval
