// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#include "eval/score/metrics.hpp"
#include "eval/score/part_counts.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace mapscore::eval {
namespace {

TrajectoryErrors some_errors(double scale) {
  TrajectoryErrors errors;
  errors.position = {4, 0.04 * scale};
  errors.aligned = {4, 0.01 * scale};
  errors.rotation = {4, 1e-4 * scale};
  errors.relative_position = {2, 2e-4 * scale};
  errors.relative_rotation = {2, 2e-6 * scale};
  errors.planar = {4, 3, 0, 12.0 * scale};
  return errors;
}

TEST(PoseCounts, FiguresAreThoseOfTheSums) {
  const std::vector<Metric> metrics = PoseCounts::of(some_errors(1.0)).metrics();
  const auto value = [&](const char* name) { return value_of(metrics, name).value(); };
  EXPECT_NEAR(value("ate_m"), 0.1, 1e-12);
  EXPECT_NEAR(value("ate_aligned_m"), 0.05, 1e-12);
  EXPECT_NEAR(value("ate_deg"), 0.005 * 180 / std::numbers::pi, 1e-9);
  EXPECT_NEAR(value("rpe_percent"), 1.0, 1e-9);
  EXPECT_NEAR(value("rpe_deg_per_m"), 0.001 * 180 / std::numbers::pi, 1e-9);
  EXPECT_EQ(value("nees_share"), 0.75);
  EXPECT_NEAR(value("nees_mean"), 3.0, 1e-12);
  EXPECT_FALSE(value_of(metrics, "nees6_share").has_value());
  for (const Metric& metric : PoseCounts{}.metrics()) EXPECT_FALSE(metric.value.has_value());
}

TEST(PoseCounts, KeepGoodAndLostPosesExactlyAndPoolInAnyOrder) {
  const PoseCounts good = PoseCounts::of(some_errors(1e-6));
  const PoseCounts lost = PoseCounts::of(some_errors(1e9));
  EXPECT_EQ(good.position, 0);
  EXPECT_EQ(good.position_parts, 40'000);
  EXPECT_EQ(lost.position, 40'000'000);
  EXPECT_EQ(lost.position_parts, 0);
  PoseCounts one = good, other = lost;
  (one += lost) += good;
  (other += good) += good;
  EXPECT_EQ(one, other);
  TrajectoryErrors nearly;
  nearly.position = {1, std::nextafter(3.0, 0.0)};
  EXPECT_EQ(PoseCounts::of(nearly).position, 3);  // parts are carried
  EXPECT_EQ(PoseCounts::of(nearly).position_parts, 0);
}

TEST(PoseCounts, AnInfiniteErrorHasNoMean) {
  TrajectoryErrors errors = some_errors(1.0);
  errors.planar.infinite = 1;
  const std::vector<Metric> metrics = PoseCounts::of(errors).metrics();
  EXPECT_FALSE(value_of(metrics, "nees_mean").has_value());
  EXPECT_EQ(value_of(metrics, "nees_share"), 0.75);
}

TEST(PoseCounts, AreThoseOfTheTrialWhateverTheClasses) {
  ClassTable table;
  table.classes = {{0, "background"}, {1, "cup", {}, true}, {2, "chair", {}, true}};
  Counts counts = zero_counts(3, {.tolerances = {}, .distances_m = {}, .asked = {.poses = true}});
  counts[1].visible = counts[2].visible = 1;
  counts[kBackground].poses = PoseCounts::of(some_errors(1.0));
  EXPECT_EQ(pool_detected(counts, table).poses, counts[kBackground].poses);
  EXPECT_NEAR(value_of(macro_metrics(counts, table), "ate_m").value(), 0.1, 1e-12);
  Counts twice = counts;
  pool_into(twice, counts);
  EXPECT_EQ(twice[kBackground].poses->frames, 8);
  EXPECT_NEAR(value_of(macro_metrics(twice, table), "ate_m").value(), 0.1, 1e-12);
}

}  // namespace
}  // namespace mapscore::eval
