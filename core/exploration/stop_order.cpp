// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#include "core/exploration/stop_order.hpp"

#include "core/error.hpp"

#include <algorithm>
#include <limits>
#include <numeric>

namespace mapscore {

std::vector<std::size_t> soonest_order(const Stops& stops) {
  const std::size_t count = stops.worth.size();
  if (count > kMostStops) throw Error("stops: are more than 12; give fewer");
  if (count == 0) return {};
  constexpr double kNever = std::numeric_limits<double>::infinity();
  const std::size_t sets = std::size_t{1} << count;
  // cost[set][last]: of having been at the stops of a set, the last one last; from[set][last]: the
  // one before. A leg costs its length times what is still to be gathered when it begins.
  std::vector<std::vector<double>> cost(sets, std::vector<double>(count, kNever));
  std::vector<std::vector<std::size_t>> from(sets, std::vector<std::size_t>(count, count));
  const double all = std::accumulate(stops.worth.begin(), stops.worth.end(), 0.0);
  for (std::size_t n = 0; n < count; ++n) cost[std::size_t{1} << n][n] = stops.way_m[n] * all;
  for (std::size_t set = 1; set < sets; ++set) {
    double left = all;
    for (std::size_t n = 0; n < count; ++n)
      if (set >> n & 1) left -= stops.worth[n];
    for (std::size_t last = 0; last < count; ++last) {
      if (!(cost[set][last] < kNever)) continue;
      for (std::size_t next = 0; next < count; ++next) {
        if (set >> next & 1) continue;
        const std::size_t more = set | std::size_t{1} << next;
        const double sum = cost[set][last] + stops.between_m[last][next] * left;
        if (sum < cost[more][next]) cost[more][next] = sum, from[more][next] = last;
      }
    }
  }
  std::vector<std::size_t> order;
  std::size_t set = sets - 1;
  const auto least = std::ranges::min_element(cost[set]);
  for (auto last = static_cast<std::size_t>(least - cost[set].begin()); last < count;) {
    order.push_back(last);
    const std::size_t before = from[set][last];
    set &= ~(std::size_t{1} << last);
    last = before;
  }
  std::ranges::reverse(order);
  return order;
}

}  // namespace mapscore
