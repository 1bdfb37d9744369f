// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#include "eval/foreign/association.hpp"

#include <algorithm>
#include <cmath>
#include <tuple>

namespace mapscore::eval {

std::vector<Association> associate(std::span<const double> first_s,
                                   std::span<const double> second_s, double max_offset_s) {
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
