// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#include "eval/statistics/intervals.hpp"

#include <gtest/gtest.h>

#include <vector>

namespace mapscore::eval {
namespace {

TEST(Intervals, TenSeedsByHand) {
  // Symmetric, so Student t: 5.5 +- 2.2621572 * 3.0276504 / sqrt(10).
  const std::vector<std::optional<double>> values{1, 2, 3, 4, 5, 6, 7, 8, 9, 10};
  const SeedSummary summary = summarise(values);
  EXPECT_EQ(summary.kind, SpreadKind::interval);
  EXPECT_STREQ(name_of(summary.kind), "95% interval");
  EXPECT_EQ(summary.seeds, 10);
  EXPECT_DOUBLE_EQ(*summary.mean, 5.5);
  EXPECT_NEAR(*summary.sd, 3.0276504, 1e-7);
  EXPECT_NEAR(*summary.low, 3.3341494, 1e-6);
  EXPECT_NEAR(*summary.high, 7.6658506, 1e-6);
}

TEST(Intervals, UndefinedSeedsAreCountedAndChangeNothingElse) {
  const std::vector<std::optional<double>> values{1, 2, 3, 4, 5, 6, 7, 8, 9, 30};
  std::vector<std::optional<double>> with_undefined = values;
  with_undefined.insert(with_undefined.begin() + 3, std::nullopt);
  with_undefined.push_back(std::nullopt);
  const SeedSummary without = summarise(values), with = summarise(with_undefined);
  EXPECT_EQ(with.undefined, 2);
  EXPECT_EQ(with.seeds, 10);
  EXPECT_EQ(with.mean, without.mean);
  EXPECT_EQ(with.sd, without.sd);
  EXPECT_EQ(with.low, without.low);
  EXPECT_EQ(with.high, without.high);
}

TEST(Intervals, EqualSeedsHaveAnIntervalWithoutLength) {
  const SeedSummary summary = summarise(std::vector<std::optional<double>>(10, 0.1));
  EXPECT_EQ(summary.kind, SpreadKind::interval);
  EXPECT_EQ(summary.mean, 0.1);
  EXPECT_EQ(summary.sd, 0.0);
  EXPECT_EQ(summary.low, 0.1);
  EXPECT_EQ(summary.high, 0.1);
}

TEST(Intervals, FewerSeedsGiveARangeAndSaySo) {
  const std::vector<std::optional<double>> values{0.4, std::nullopt, 0.9, 0.5};
  const SeedSummary summary = summarise(values);
  EXPECT_EQ(summary.kind, SpreadKind::range);
  EXPECT_STREQ(name_of(summary.kind), "range");
  EXPECT_EQ(summary.seeds, 3);
  EXPECT_EQ(summary.undefined, 1);
  EXPECT_DOUBLE_EQ(*summary.mean, 0.6);
  EXPECT_EQ(summary.low, 0.4);
  EXPECT_EQ(summary.high, 0.9);
}

TEST(Intervals, UndefinedValuesDoNotMakeUpTenSeeds) {
  std::vector<std::optional<double>> values(9, 0.5);
  values.push_back(std::nullopt);
  EXPECT_EQ(summarise(values).kind, SpreadKind::range);
}

TEST(Intervals, OneSeedHasNoDeviationAndNoneHasNothing) {
  const std::vector<std::optional<double>> one{0.3}, none{std::nullopt};
  EXPECT_EQ(summarise(one).sd, std::nullopt);
  EXPECT_EQ(summarise(one).low, 0.3);
  EXPECT_EQ(summarise(none).kind, SpreadKind::none);
  EXPECT_EQ(summarise(none).mean, std::nullopt);
}

}  // namespace
}  // namespace mapscore::eval
