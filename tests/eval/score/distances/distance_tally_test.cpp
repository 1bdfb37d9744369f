// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#include "eval/score/distance_tally.hpp"

#include "core/error.hpp"
#include "core/random_stream.hpp"

#include <gtest/gtest.h>

namespace mapscore::eval {
namespace {

TEST(DistanceTally, CountsWithinLimitsIncluded) {
  DistanceTally tally({0.01, 0.05});
  for (const double distance : {0.0, 0.01, 0.06 - 0.05, 0.0101, 0.05, 0.2}) tally.add(distance);
  EXPECT_EQ(tally.count(), 6);
  EXPECT_EQ(tally.within(0), 3);
  EXPECT_EQ(tally.within(1), 5);
}

TEST(DistanceTally, MeanAndPercentileByHand) {
  DistanceTally tally({0.01});
  tally.add(0.0, 94);
  tally.add(0.0123);
  tally.add(1.5, 5);
  EXPECT_DOUBLE_EQ(*tally.mean_m(), (0.0123 + 7.5) / 100);
  EXPECT_DOUBLE_EQ(*tally.percentile_m(0.94), 0.0);
  EXPECT_DOUBLE_EQ(*tally.percentile_m(0.95), 0.013);  // up to the next millimetre
  EXPECT_DOUBLE_EQ(*tally.percentile_m(0.951), 1.5);
  EXPECT_DOUBLE_EQ(*tally.percentile_m(0.0), 0.0);
}

TEST(DistanceTally, NothingToReachIsInfinite) {
  DistanceTally tally({0.01});
  EXPECT_EQ(tally.mean_m(), std::nullopt);
  EXPECT_EQ(tally.percentile_m(0.95), std::nullopt);
  tally.add(0.002, 95);
  tally.add(kUnreached, 5);
  EXPECT_EQ(tally.count(), 100);
  EXPECT_EQ(tally.parts().unreached, 5);
  EXPECT_EQ(tally.within(0), 95);
  EXPECT_EQ(tally.mean_m(), std::nullopt);
  EXPECT_DOUBLE_EQ(*tally.percentile_m(0.95), 0.002);
  EXPECT_EQ(tally.percentile_m(0.96), std::nullopt);
}

TEST(DistanceTally, PoolingIsExactInAnyOrder) {
  RandomStream random(1, "tally test");
  DistanceTally whole({0.01, 0.02}), first({0.01, 0.02}), second({0.01, 0.02}), pooled;
  for (int n = 0; n < 1000; ++n) {
    const double distance = random.uniform() < 0.1 ? kUnreached : random.uniform() * 0.05;
    whole.add(distance);
    (n % 3 == 0 ? first : second).add(distance);
  }
  DistanceTally backwards = second;
  backwards += first;
  pooled += first;
  pooled += second;
  pooled += DistanceTally();
  EXPECT_EQ(pooled, whole);
  EXPECT_EQ(backwards, whole);
}

TEST(DistanceTally, PartsGiveTheTallyBackAndMustAddUp) {
  DistanceTally tally({0.01, 0.02});
  tally.add(0.0155, 3);
  tally.add(kUnreached, 2);
  DistanceTally::Parts parts = tally.parts();
  EXPECT_EQ(parts.sum_nm, 3 * 15500000);
  EXPECT_EQ(DistanceTally(parts), tally);
  parts.count = 4;
  EXPECT_THROW(static_cast<void>(DistanceTally(parts)), Error);
  parts = tally.parts();
  parts.within.pop_back();
  EXPECT_THROW(static_cast<void>(DistanceTally(parts)), Error);
}

TEST(DistanceTally, RefusesToPoolOtherLimits) {
  DistanceTally tally({0.01});
  EXPECT_THROW(tally += DistanceTally({0.02}), Error);
}

}  // namespace
}  // namespace mapscore::eval
