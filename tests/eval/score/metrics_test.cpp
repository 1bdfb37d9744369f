// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#include "eval/score/metrics.hpp"

#include "core/error.hpp"
#include "eval/score/voxel_score.hpp"
#include "tests/eval/score/score_cases.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace mapscore::eval {
namespace {

using testing::random_case;
using testing::RandomCase;

ClassCounts counts_with(std::int64_t predicted, std::int64_t true_predicted, std::int64_t visible,
                        std::int64_t found) {
  ClassCounts counts;
  counts.predicted = predicted;
  counts.true_predicted = true_predicted;
  counts.visible = visible;
  counts.found = found;
  return counts;
}

ClassTable table_of(std::vector<bool> detect) {
  ClassTable table;
  table.classes.clear();
  for (std::size_t c = 0; c < detect.size(); ++c) {
    table.classes.push_back({static_cast<ClassId>(c), "class", {}, detect[c]});
  }
  return table;
}

TEST(Metrics, RatiosByHand) {
  const ClassCounts counts = counts_with(10, 8, 5, 4);
  EXPECT_DOUBLE_EQ(*precision(counts), 0.8);
  EXPECT_DOUBLE_EQ(*recall(counts), 0.8);
  EXPECT_DOUBLE_EQ(*f1(counts), 0.8);
  EXPECT_DOUBLE_EQ(*iou(counts), 4.0 / 7.0);
  EXPECT_DOUBLE_EQ(*f1(counts_with(4, 1, 2, 1)), 1.0 / 3.0);
}

TEST(Metrics, NothingPredictedIsF1ZeroAndPrecisionUndefined) {
  const ClassCounts counts = counts_with(0, 0, 5, 0);
  EXPECT_EQ(precision(counts), std::nullopt);
  EXPECT_EQ(recall(counts), 0.0);
  EXPECT_EQ(f1(counts), 0.0);
  EXPECT_EQ(iou(counts), 0.0);
}

TEST(Metrics, NothingHitIsF1Zero) {
  EXPECT_EQ(f1(counts_with(3, 0, 5, 0)), 0.0);
}

TEST(Metrics, NothingVisibleLeavesRecallUndefinedAndF1Zero) {
  EXPECT_EQ(recall(counts_with(3, 1, 0, 0)), std::nullopt);
  EXPECT_EQ(f1(counts_with(3, 1, 0, 0)), 0.0);
  EXPECT_EQ(iou(counts_with(3, 1, 0, 0)), 0.0);
  EXPECT_EQ(iou(counts_with(3, 3, 0, 0)), std::nullopt);
}

TEST(Metrics, EverythingIsUndefinedOnlyWhenBothAreEmpty) {
  for (const Metric& metric : metrics_of(ClassCounts{}))
    EXPECT_EQ(metric.value, std::nullopt) << metric.name;
}

TEST(Metrics, NamesCarryToleranceAndDistance) {
  ClassCounts counts = counts_with(2, 1, 2, 1);
  counts.visible_4 = 4;
  counts.found_4 = 1;
  counts.instances = InstanceCounts{3, 4, 2, 2'400'000'000, 7, {}};
  counts.instances->steps = {{900, 3, {3, 2, 1}}, {100, 4, {1, 0, 1}}};
  counts.at_tolerance = {{1, 2, 1}};
  counts.accuracy = DistanceTally({0.005, 0.1});
  counts.completeness = DistanceTally({0.005, 0.1});
  counts.accuracy.add(0.0);
  counts.accuracy.add(0.05);
  counts.completeness.add(0.2, 3);
  counts.completeness.add(0.001);
  counts.curve.visible = 2;
  counts.curve.steps = {{800, 1, 1, 1, 800000000}, {300, 1, 0, 0, 300000000}};
  counts.curve.squared_error_billionth = 40000000 + 90000000;
  counts.boxes = {4, 7, 2600000000, 3, 3, 2};
  const std::vector<Metric> expected{{"precision", 0.5},
                                     {"recall", 0.5},
                                     {"f1", 0.5},
                                     {"iou", 1.0 / 3.0},
                                     {"recall_4", 0.25},
                                     {"f1_4", 1.0 / 3.0},
                                     {"iou_4", 0.2},
                                     {"precision_t1", 1.0},
                                     {"recall_t1", 0.5},
                                     {"f1_t1", 2.0 / 3.0},
                                     {"precision_0.5cm", 0.5},
                                     {"recall_0.5cm", 0.25},
                                     {"f_0.5cm", 1.0 / 3.0},
                                     {"precision_10cm", 1.0},
                                     {"recall_10cm", 0.25},
                                     {"f_10cm", 0.4},
                                     {"accuracy_mean_m", 0.025},
                                     {"accuracy_p95_m", 0.05},
                                     {"completeness_mean_m", 0.15025},
                                     {"completeness_p95_m", 0.2},
                                     {"ap", 0.5},
                                     {"brier", 0.065},
                                     {"ece", 0.25},
                                     {"box_iou", 0.65},
                                     {"box_25", 0.75},
                                     {"box_50", 0.75},
                                     {"box_75", 0.5},
                                     {"pq", 0.4},
                                     {"sq", 0.8},
                                     {"rq", 0.5},
                                     {"ap_25", 0.6 + 0.2 * 4.0 / 7.0},
                                     {"ap_50", 0.4 * 2.0 / 3.0},
                                     {"ap_75", 0.0},
                                     {"ap_mean", (0.8 / 3.0 + 0.2 / 3.0 + 0.4 / 7.0) / 10.0}};
  const std::vector<Metric> metrics = metrics_of(counts);
  ASSERT_EQ(metrics.size(), expected.size());
  for (std::size_t m = 0; m < metrics.size(); ++m) {
    EXPECT_EQ(metrics[m].name, expected[m].name);
    ASSERT_TRUE(metrics[m].value) << metrics[m].name;
    EXPECT_NEAR(*metrics[m].value, *expected[m].value, 1e-12) << metrics[m].name;
  }
  EXPECT_EQ(value_of(metrics, "precision_10cm"), 1.0);
  EXPECT_THROW(static_cast<void>(value_of(metrics, "f_3cm")), Error);
}

TEST(Metrics, PooledAndMacroTakeDetectedClassesOnly) {
  const Counts counts{counts_with(0, 0, 0, 0), counts_with(10, 5, 4, 2), counts_with(0, 0, 4, 0),
                      counts_with(7, 0, 0, 0), counts_with(9, 9, 9, 9)};
  const ClassTable table = table_of({false, true, true, true, false});
  const ClassCounts pooled = pool_detected(counts, table);
  EXPECT_EQ(pooled.predicted, 17);
  EXPECT_EQ(pooled.true_predicted, 5);
  EXPECT_EQ(pooled.visible, 8);
  EXPECT_EQ(pooled.found, 2);
  const std::vector<Metric> macro = macro_metrics(counts, table);
  EXPECT_DOUBLE_EQ(*value_of(macro, "precision"), 0.5);  // undefined for class 2
  EXPECT_DOUBLE_EQ(*value_of(macro, "recall"), 0.25);
  EXPECT_DOUBLE_EQ(*value_of(macro, "f1"), 0.25);
  EXPECT_EQ(value_of(macro, "mpa"), value_of(macro, "recall"));
  EXPECT_EQ(value_of(macro, "miou"), value_of(macro, "iou"));
  EXPECT_TRUE(macro_metrics(counts, table_of({false, false, false, true, false})).empty());
  EXPECT_THROW(static_cast<void>(macro_metrics(counts, table_of({false}))), Error);
  EXPECT_THROW(static_cast<void>(pool_detected(counts, table_of({false}))), Error);
}

TEST(Metrics, MacroLeavesOutClassesWithoutVoxelsOfManySamples) {
  Counts counts{counts_with(0, 0, 0, 0), counts_with(4, 2, 8, 4), counts_with(5, 5, 5, 5)};
  counts[1].visible_4 = 4;
  counts[1].found_4 = 2;
  for (const char* name : {"recall_4", "f1_4", "iou_4"})
    EXPECT_EQ(value_of(metrics_of(counts[2]), name), std::nullopt) << name;
  const std::vector<Metric> macro = macro_metrics(counts, table_of({false, true, true}));
  EXPECT_DOUBLE_EQ(*value_of(macro, "recall"), 0.75);
  EXPECT_DOUBLE_EQ(*value_of(macro, "recall_4"), 0.5);
  EXPECT_DOUBLE_EQ(*value_of(macro, "f1_4"), 0.5);
  EXPECT_DOUBLE_EQ(*value_of(macro, "iou_4"), 2.0 / 6.0);
}

TEST(Metrics, MacroOfInstancesIsOverClassesWithVisibleInstances) {
  // Class 2 has visible voxels and no visible instance; class 3 the other way about.
  Counts counts{counts_with(0, 0, 0, 0), counts_with(1, 1, 1, 1), counts_with(1, 1, 1, 1),
                counts_with(1, 1, 0, 0)};
  const auto table = table_of({false, true, true, true});
  for (ClassCounts& of_class : counts) of_class.instances.emplace();
  const std::vector<Metric> none = macro_metrics(counts, table);
  EXPECT_EQ(value_of(none, "pq"), std::nullopt);
  counts[1].instances = InstanceCounts{1, 0, 0, 900'000'000, 0, {}};
  counts[2].instances->false_positive = 1;
  counts[3].instances->false_negative = 1;
  const std::vector<Metric> macro = macro_metrics(counts, table);
  EXPECT_DOUBLE_EQ(*value_of(macro, "pq"), 0.45);
  EXPECT_DOUBLE_EQ(*value_of(metrics_of(pool_detected(counts, table)), "rq"), 0.5);
  EXPECT_EQ(macro.back().name, "miou");
}

TEST(Metrics, PoolingOverFramesIsTheSumOfCounts) {
  Counts total;
  std::int64_t predicted = 0, found_within = 0;
  for (std::uint64_t seed = 0; seed < 10; ++seed) {
    const RandomCase made = random_case(seed);
    const Counts counts =
        score_voxels(MapSnapshot(made.map), 0.25, testing::surface_of(made.surface),
                     testing::visible_of(made.owners), RandomCase::kClasses);
    predicted += counts[1].predicted;
    found_within += counts[1].at_tolerance[0].found;
    pool_into(total, counts);
  }
  EXPECT_EQ(total[1].predicted, predicted);
  EXPECT_EQ(total[1].at_tolerance[0].found, found_within);
}

/// Every count a multiple of `n`, no two alike.
ClassCounts counted_times(std::int64_t n) {
  ClassCounts counts;
  std::int64_t times = 0;
  for (auto* count :
       {&counts.predicted, &counts.true_predicted, &counts.visible, &counts.found,
        &counts.false_near, &counts.false_leak, &counts.false_floating, &counts.missed_mislabelled,
        &counts.missed_unlabelled, &counts.missed_unmapped})
    *count = ++times * n;
  counts.at_tolerance = {{1, 11 * n, 12 * n}};
  counts.accuracy = DistanceTally({0.01});
  counts.accuracy.add(0.013, 13 * n);
  counts.completeness = DistanceTally({0.01});
  counts.completeness.add(0.001, 14 * n);
  counts.curve = {15 * n, 16 * n, {{500, 17 * n, 18 * n, 19 * n, 20 * n}}};
  counts.boxes = {21 * n, 22 * n, 23 * n, 24 * n, 25 * n, 26 * n};
  counts.visible_4 = 27 * n;
  counts.found_4 = 28 * n;
  counts.instances = InstanceCounts{29 * n, 30 * n, 31 * n, 32 * n, 33 * n, {}};
  counts.instances->steps = {{500, 34 * n, {35 * n, 36 * n}}};
  return counts;
}

TEST(Metrics, PoolingAddsEveryCount) {
  ClassCounts pooled = counted_times(1);
  pooled += counted_times(2);
  EXPECT_EQ(pooled, counted_times(3));
}

TEST(Metrics, CountsOfDifferentOptionsAreNotPooled) {
  Counts total = zero_counts(3, {{1}, {}});
  EXPECT_THROW(pool_into(total, zero_counts(3, {{1, 2}, {}})), Error);
  EXPECT_THROW(pool_into(total, zero_counts(3, {{2}, {}})), Error);
  EXPECT_THROW(pool_into(total, zero_counts(4, {{1}, {}})), Error);
  Counts with_instances = zero_counts(3, {{1}, {}});
  for (ClassCounts& of_class : with_instances) of_class.instances.emplace();
  EXPECT_THROW(pool_into(total, with_instances), Error);
  EXPECT_THROW(pool_into(with_instances, total), Error);
}

}  // namespace
}  // namespace mapscore::eval
