// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#pragma once

#include <cstddef>
#include <vector>

namespace mapscore {

/// Places to stop at, and what each is worth.
struct Stops {
  std::vector<double> worth;
  std::vector<double> way_m;                   ///< from the robot to each
  std::vector<std::vector<double>> between_m;  ///< from each to each
};

/// At most so many stops are put in order.
inline constexpr std::size_t kMostStops = 12;

/// The order of all stops in which their worth is gathered soonest: it minimises the sum of each
/// stop's worth times the way until it, the area above the curve of what is gathered over the way
/// (minimum latency; F. Afrati et al., The Complexity of the Travelling Repairman Problem, RAIRO 20
/// (1986)). Exact, by subsets (M. Held and R. Karp, J. SIAM 10 (1962)); of equal orders the first
/// by index from the end. Throws Error for more than kMostStops. Thread-safe.
[[nodiscard]] std::vector<std::size_t> soonest_order(const Stops& stops);

}  // namespace mapscore
