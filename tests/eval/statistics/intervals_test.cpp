// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#include "eval/statistics/intervals.hpp"

#include "core/error.hpp"

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

TEST(Intervals, AreCutOffAtWhatAFigureCanBe) {
  std::vector<std::optional<double>> values(9, 1.0);
  values.emplace_back(0.5);
  const SeedSummary free = summarise(values), share = summarise(values, {0.0, 1.0});
  EXPECT_GT(free.high.value(), 1.0);
  EXPECT_EQ(share.high, 1.0);
  EXPECT_EQ(share.low, free.low);
  EXPECT_EQ(share.mean, free.mean);
  for (auto& value : values) value = 1.0 - *value;
  EXPECT_LT(summarise(values).low.value(), 0.0);
  EXPECT_EQ(summarise(values, {0.0, 1.0}).low, 0.0);
}

TEST(StudentT, QuantilesEqualThePublishedTable) {
  struct Row {
    int degrees;
    double t975, t95;
  };
  for (const Row& row :
       {Row{1, 12.7062047, 6.3137515}, Row{2, 4.3026527, 2.9199856}, Row{3, 3.1824463, 2.3533634},
        Row{4, 2.7764451, 2.1318468}, Row{9, 2.2621572, 1.8331129}, Row{10, 2.2281389, 1.8124611},
        Row{29, 2.0452296, 1.6991270}, Row{30, 2.0422725, 1.6972609},
        Row{120, 1.9799304, 1.6576509}}) {
    EXPECT_NEAR(student_t_quantile(0.975, row.degrees), row.t975, 1e-6) << row.degrees;
    EXPECT_NEAR(student_t_quantile(0.95, row.degrees), row.t95, 1e-6) << row.degrees;
    EXPECT_NEAR(student_t_quantile(0.025, row.degrees), -row.t975, 1e-6) << row.degrees;
  }
  EXPECT_NEAR(student_t_quantile(0.975, 100000), 1.9599640, 1e-4);
  EXPECT_NEAR(student_t_quantile(0.5, 7), 0.0, 1e-12);
}

TEST(StudentT, QuantileInvertsTheDistribution) {
  for (const int degrees : {1, 2, 3, 4, 5, 8, 17, 50, 999}) {
    for (const double p : {0.001, 0.1, 0.3, 0.6, 0.9, 0.999}) {
      EXPECT_NEAR(student_t_cdf(student_t_quantile(p, degrees), degrees), p, 1e-12);
    }
  }
  EXPECT_THROW(static_cast<void>(student_t_quantile(1.0, 3)), Error);
  EXPECT_THROW(static_cast<void>(student_t_quantile(0.975, 0)), Error);
}

}  // namespace
}  // namespace mapscore::eval
