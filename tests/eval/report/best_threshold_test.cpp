// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#include "eval/report/best_threshold.hpp"

#include "tests/eval/report/synthetic_summary.hpp"
#include "tests/support/expect_error.hpp"

#include <gtest/gtest.h>

#include <array>

namespace mapscore::eval {
namespace {

/// 10 visible voxels; `high` found ones at 0.9, then `low` predicted at 0.3, `found` of them right.
ClassCurve seed_of(std::int64_t high, std::int64_t low, std::int64_t found) {
  return {10, 0, {{900, high, high, high, 0}, {300, low, found, found, 0}}};
}

/// Best for themselves: 0.3, 0.3, 0.9.
const std::array<ClassCurve, 3> kSeeds{seed_of(5, 5, 5), seed_of(5, 7, 5), seed_of(8, 90, 2)};

TEST(BestThreshold, IsChosenOnTheOtherSeeds) {
  const BestThreshold best = best_threshold(kSeeds);
  ASSERT_EQ(best.by_seed.size(), 3u);
  // Others of seed 0: at 0.9 F = 2 * 13 / (20 + 13), at 0.3 2 * 20 / (20 + 110).
  EXPECT_EQ(best.by_seed[0].threshold, 0.9);
  EXPECT_DOUBLE_EQ(*best.by_seed[0].f1, 10.0 / 15.0);
  EXPECT_EQ(best.by_seed[1].threshold, 0.9);
  // Others of seed 2: at 0.9 F = 2 * 10 / (20 + 10), at 0.3 2 * 20 / (20 + 22).
  EXPECT_EQ(best.by_seed[2].threshold, 0.3);
  EXPECT_DOUBLE_EQ(*best.by_seed[2].f1, 20.0 / 108.0);
  // 5 of 5, 5 of 5, 10 of 98; 20 of 30 are found.
  const double p = 20.0 / 108.0, r = 20.0 / 30.0;
  EXPECT_DOUBLE_EQ(*best.pooled.f1, 2 * p * r / (p + r));
  EXPECT_EQ(best.pooled.threshold, 0.9);
}

TEST(BestThreshold, IsUndefinedWhereOneSeedAloneWouldChoose) {
  const BestThreshold best = best_threshold(std::span(kSeeds).first(2));
  ASSERT_EQ(best.by_seed.size(), 2u);
  EXPECT_EQ(best.by_seed[0].f1, std::nullopt);
  EXPECT_EQ(best.pooled.f1, std::nullopt);
  EXPECT_EQ(best.pooled.threshold, std::nullopt);
}

TEST(BestThreshold, WithoutAVoxelInTheOthersNothingIsPredicted) {
  const ClassCurve none{10, 0, {}};
  const std::array<ClassCurve, 3> seeds{seed_of(5, 5, 5), none, none};
  const BestThreshold best = best_threshold(seeds);
  EXPECT_EQ(best.by_seed[0].threshold, std::nullopt);
  EXPECT_EQ(best.by_seed[0].f1, 0.0);
  EXPECT_EQ(best.by_seed[1].threshold, 0.3);
  EXPECT_EQ(best.by_seed[1].f1, 0.0);
  EXPECT_EQ(best.pooled.f1, 0.0);
}

/// Cups (class 1) as kSeeds; chairs (class 2) all right at 0.5.
ResultLine line_of_seeds() {
  ResultLine line{Role::trial, "direct", {}, {0, 1, 2}, {}, {}};
  for (const ClassCurve& cups : kSeeds) {
    Counts counts(4);
    counts[1].curve = cups;
    counts[2].curve = {4, 0, {{500, 2, 2, 2, 0}}};
    counts[1].visible = 10;
    counts[2].visible = 4;
    line.results.push_back({counts, {}});
    pool_into(line.pooled, counts);
  }
  return line;
}

TEST(BestThreshold, PooledHasOneThresholdMacroOneAClass) {
  const ResultLine line = line_of_seeds();
  const ClassTable table = testing::synthetic_table();
  EXPECT_EQ(best_threshold(line, table, "cup").by_seed[0].threshold, 0.9);
  EXPECT_EQ(best_threshold(line, table, "chair").by_seed[0].threshold, 0.5);
  const BestThreshold macro = best_threshold(line, table, kMacro);
  EXPECT_DOUBLE_EQ(*macro.by_seed[0].threshold, (0.9 + 0.5) / 2);
  EXPECT_DOUBLE_EQ(*macro.by_seed[0].f1, (10.0 / 15.0 + 4.0 / 6.0) / 2);
  // Both classes together, seeds 1 and 2: at 0.5 F = 2 * 17 / (28 + 17), at 0.9 2 * 13 / (28 + 13).
  const BestThreshold pooled = best_threshold(line, table, kPooled);
  EXPECT_EQ(pooled.by_seed[0].threshold, 0.5);
  EXPECT_DOUBLE_EQ(*pooled.by_seed[0].f1, 14.0 / 21.0);
  mapscore::testing::expect_error("'table'", [&] { (void)best_threshold(line, table, "table"); });
}

TEST(BestThreshold, IsAFigureOfTheLine) {
  const ResultLine line = line_of_seeds();
  const ClassTable table = testing::synthetic_table();
  const BestThreshold best = best_threshold(line, table, "cup");
  const Estimate f1_best = estimate(line, table, "cup", kBestF1);
  EXPECT_EQ(f1_best.pooled, best.pooled.f1);
  EXPECT_EQ(f1_best.over_seeds.low, best.by_seed[2].f1);
  EXPECT_EQ(estimate(line, table, "cup", kBestThreshold).pooled, 0.9);
}

}  // namespace
}  // namespace mapscore::eval
