// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#include "core/exploration/stop_order.hpp"

#include "core/error.hpp"
#include "core/random_stream.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <limits>
#include <numeric>

namespace mapscore::testing {
namespace {

/// Sum of each stop's worth times the way until it.
double latency(const Stops& stops, const std::vector<std::size_t>& order) {
  double way_m = stops.way_m[order[0]], sum = way_m * stops.worth[order[0]];
  for (std::size_t n = 1; n < order.size(); ++n) {
    way_m += stops.between_m[order[n - 1]][order[n]];
    sum += way_m * stops.worth[order[n]];
  }
  return sum;
}

TEST(StopOrder, OfAllOrdersNoneGathersSooner) {
  RandomStream stream(1, "stops");
  for (int trial = 0; trial < 30; ++trial) {
    const std::size_t count = 1 + stream.bits() % 6;
    Stops stops;
    for (std::size_t n = 0; n < count; ++n) {
      stops.worth.push_back(1000 * stream.uniform());
      stops.way_m.push_back(10 * stream.uniform());
      stops.between_m.emplace_back();
      for (std::size_t m = 0; m < count; ++m) stops.between_m[n].push_back(10 * stream.uniform());
    }
    const std::vector<std::size_t> order = soonest_order(stops);
    std::vector<std::size_t> any(count);
    std::iota(any.begin(), any.end(), std::size_t{0});
    ASSERT_TRUE(std::ranges::is_permutation(order, any));
    double least = std::numeric_limits<double>::infinity();
    do least = std::min(least, latency(stops, any));
    while (std::ranges::next_permutation(any).found);
    EXPECT_NEAR(latency(stops, order), least, 1e-6);
  }
}

// A room of little worth lies on the way to a great one, another little one behind the robot: first
// the one on the way, then the great one, although the one behind is nearest.
TEST(StopOrder, TakesWhatLiesOnTheWay) {
  const Stops stops{{100, 1000, 100}, {2, 4, 1}, {{0, 2, 3}, {2, 0, 5}, {3, 5, 0}}};
  EXPECT_EQ(soonest_order(stops), (std::vector<std::size_t>{0, 1, 2}));
}

TEST(StopOrder, RefusesMoreThanItCanTry) {
  EXPECT_TRUE(soonest_order({}).empty());
  Stops many;
  many.worth.assign(kMostStops + 1, 1.0);
  EXPECT_THROW(static_cast<void>(soonest_order(many)), Error);
}

}  // namespace
}  // namespace mapscore::testing
