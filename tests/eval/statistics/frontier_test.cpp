// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#include "eval/statistics/frontier.hpp"

#include <gmock/gmock.h>

namespace mapscore::eval {
namespace {

using ::testing::DoubleNear;
using ::testing::Pointwise;

Tolerance found_at(double dose) {
  Tolerance tolerance;
  tolerance.verdict = ToleranceVerdict::found;
  tolerance.dose = dose;
  return tolerance;
}

Tolerance with_ends(std::optional<double> low, std::optional<double> high) {
  Tolerance tolerance;
  tolerance.low = low;
  tolerance.high = high;
  return tolerance;
}

void expect_doses(double low, double high, const std::vector<Tolerance>& alone,
                  const std::vector<double>& doses) {
  EXPECT_THAT(frontier_doses(low, high, alone), Pointwise(DoubleNear(1e-9), doses));
}

TEST(Frontier, DosesLieBelowTheSecondFaultsOwnTolerance) {
  expect_doses(0.0, 1000.0, {found_at(6.0)}, {0.0, 1.0, 2.0, 3.0, 4.0, 5.0});
  expect_doses(2.0, 1000.0, {found_at(8.0)}, {2.0, 3.0, 4.0, 5.0, 6.0, 7.0});
}

TEST(Frontier, WithoutAnEndTheWholeRangeIsSearched) {
  const std::vector<double> even{0.0, 2.0, 4.0, 6.0, 8.0, 10.0};
  expect_doses(0.0, 10.0, {with_ends(10.0, {})}, even);  // above
  expect_doses(0.0, 10.0, {with_ends({}, 0.0)}, even);   // below: no method bears a dose
  expect_doses(0.0, 10.0, {}, even);                     // undefined
  expect_doses(0.0, 10.0, {with_ends({}, 3.0)}, {0.0, 0.5, 1.0, 1.5, 2.0, 2.5});  // open below
}

// The first method wants its doses up to 2, the second up to 6: of all wishes 2/3 lie up to 2.
TEST(Frontier, EveryMethodHasItsShareOfTheDoses) {
  expect_doses(0.0, 100.0, {found_at(6.0), found_at(2.0)}, {0.0, 0.5, 1.0, 1.5, 2.0, 4.0});
  expect_doses(0.0, 6.0, {found_at(2.0), with_ends(6.0, {})}, {0.0, 0.6, 1.2, 1.8, 3.6, 6.0});
  expect_doses(0.0, 100.0, {with_ends({}, 0.0), found_at(6.0)}, {0.0, 1.0, 2.0, 3.0, 4.0, 5.0});
}

}  // namespace
}  // namespace mapscore::eval
