// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#include "eval/score/intervals.hpp"

#include "core/error.hpp"
#include "core/random_stream.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

namespace mapscore::eval {
namespace {

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

TEST(Intervals, TenSeedsByHand) {
  const std::vector<std::optional<double>> values{1, 2, 3, 4, 5, 6, 7, 8, 9, 10};
  const SeedSummary summary = summarise(values);
  EXPECT_EQ(summary.kind, SpreadKind::student_t);
  EXPECT_EQ(summary.seeds, 10);
  EXPECT_DOUBLE_EQ(*summary.mean, 5.5);
  EXPECT_NEAR(*summary.sd, 3.0276504, 1e-7);
  EXPECT_NEAR(*summary.low, 5.5 - 2.2621572 * 3.0276504 / std::sqrt(10.0), 1e-6);
  EXPECT_NEAR(*summary.high, 5.5 + 2.2621572 * 3.0276504 / std::sqrt(10.0), 1e-6);
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

/// Share of `studies` of ten seeds whose interval holds the true mean of what `draw` draws.
template <class Draw>
double coverage(double true_mean, int studies, Draw draw) {
  int covered = 0;
  for (int study = 0; study < studies; ++study) {
    RandomStream random(7, "coverage", {static_cast<std::uint64_t>(study)});
    std::vector<std::optional<double>> values;
    for (int seed = 0; seed < 10; ++seed) values.push_back(draw(random));
    const SeedSummary summary = summarise(values);
    covered += *summary.low <= true_mean && true_mean <= *summary.high;
  }
  return static_cast<double>(covered) / studies;
}

TEST(Intervals, CoverTheMeanOfNormalSeedsInNineteenCasesOfTwenty) {
  const double share =
      coverage(0.8, 20000, [](RandomStream& random) { return 0.8 + 0.05 * random.normal(); });
  RecordProperty("coverage", std::to_string(share));
  EXPECT_NEAR(share, 0.95, 0.006);  // four standard errors
}

TEST(Intervals, CoverTheMeanOfSkewedSeedsNearOneAlmostAsOften) {
  // 1 - 0.02 e, e exponential: figures crowded below their upper limit.
  const double share = coverage(0.98, 20000, [](RandomStream& random) {
    return 1.0 + 0.02 * std::log(1.0 - random.uniform());
  });
  RecordProperty("coverage", std::to_string(share));
  EXPECT_GT(share, 0.88);
  EXPECT_LT(share, 0.96);
}

}  // namespace
}  // namespace mapscore::eval
