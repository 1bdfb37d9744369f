// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#include "eval/score/curve.hpp"

#include "core/error.hpp"
#include "eval/score/metrics.hpp"
#include "eval/score/voxel_score.hpp"
#include "tests/eval/score/score_cases.hpp"

#include <gtest/gtest.h>

namespace mapscore::eval {
namespace {

using testing::random_case;
using testing::RandomCase;
using testing::surface_of;
using testing::visible_of;

constexpr ClassId kCup = 1;

/// Four visible cups at 0..3; the map has 0 at 0.9, a false one at 0.8, 1 and another false one at
/// 0.5, 2 at 0.2, and a free one.
ClassCurve hand_curve() {
  std::set<std::pair<VoxelKey, ClassId>> surface;
  std::map<VoxelKey, ClassId> owners;
  for (int i = 0; i < 4; ++i) {
    surface.insert({{i, 0, 0}, kCup});
    owners[{i, 0, 0}] = kCup;
  }
  const MapSnapshot map({{{0, 0, 0}, kCup, 0.9, true},
                         {{9, 0, 0}, kCup, 0.8, true},
                         {{1, 0, 0}, kCup, 0.5, true},
                         {{9, 9, 0}, kCup, 0.5, true},
                         {{2, 0, 0}, kCup, 0.2, true},
                         {{3, 0, 0}, kCup, 0.9, false}});
  return curves_of(map, surface_of(surface), visible_of(owners), 2)[kCup];
}

TEST(Curve, AveragePrecisionByHandWithEqualScoresInOneStep) {
  const ClassCurve curve = hand_curve();
  EXPECT_EQ(curve.visible, 4);
  const std::vector<ProbabilityStep> steps{
      {0.9, 1, 1, 1}, {0.8, 1, 0, 0}, {0.5, 2, 1, 1}, {0.2, 1, 1, 1}};
  EXPECT_EQ(curve.steps, steps);
  // Recall rises by a quarter at 0.9 (precision 1), 0.5 (2/4) and 0.2 (3/5).
  EXPECT_DOUBLE_EQ(*average_precision(curve), 0.25 * 1.0 + 0.25 * 0.5 + 0.25 * 0.6);
}

TEST(Curve, BestThresholdIsTheHighestWithTheGreatestF1) {
  // F1 at 0.9: 2/5; 0.8: 1/3; 0.5: 1/2; 0.2: 2/3.
  EXPECT_EQ(best_f1_threshold(hand_curve()), 0.2);
  ClassCurve level;
  level.visible = 2;
  level.steps = {{0.9, 1, 1, 1}, {0.4, 2, 1, 0}, {0.3, 1, 0, 1}};  // F1: 2/3, 1/2, 2/3
  EXPECT_EQ(best_f1_threshold(level), 0.9);
}

TEST(Curve, BrierAndReliabilityByHand) {
  const ClassCurve curve = hand_curve();
  EXPECT_NEAR(*brier(curve), (0.01 + 0.64 + 0.25 + 0.25 + 0.64) / 5, 1e-12);
  const std::vector<ReliabilityBin> bins = reliability(curve, 2);
  ASSERT_EQ(bins.size(), 2u);
  EXPECT_EQ(bins[0].voxels, 1);
  EXPECT_DOUBLE_EQ(*bins[0].mean_probability, 0.2);
  EXPECT_DOUBLE_EQ(*bins[0].share_true, 1.0);
  EXPECT_EQ(bins[1].voxels, 4);
  EXPECT_DOUBLE_EQ(*bins[1].mean_probability, (0.9 + 0.8 + 0.5 + 0.5) / 4);
  EXPECT_DOUBLE_EQ(*bins[1].share_true, 0.5);
}

TEST(Curve, CertaintyFallsIntoTheLastBin) {
  ClassCurve curve;
  curve.steps = {{1.0, 1, 1, 0}, {0.0, 1, 0, 0}};
  const std::vector<ReliabilityBin> bins = reliability(curve, 10);
  EXPECT_EQ(bins.back().voxels, 1);
  EXPECT_EQ(bins.front().voxels, 1);
  EXPECT_EQ(bins[5].share_true, std::nullopt);
  EXPECT_THROW(static_cast<void>(reliability(curve, 0)), Error);
}

TEST(Curve, EmptyCurves) {
  EXPECT_EQ(average_precision(ClassCurve{}), std::nullopt);
  EXPECT_EQ(best_f1_threshold(ClassCurve{}), std::nullopt);
  EXPECT_EQ(brier(ClassCurve{}), std::nullopt);
  ClassCurve missed;
  missed.visible = 3;
  EXPECT_EQ(average_precision(missed), 0.0);
}

TEST(Curve, EveryPointIsTheScoreAtItsThreshold) {
  for (std::uint64_t seed = 0; seed < 20; ++seed) {
    const RandomCase made = random_case(seed);
    const MapSnapshot map(made.map);
    const SurfaceTruth surface = surface_of(made.surface);
    const VisibleTruth visible = visible_of(made.owners);
    const std::vector<ClassCurve> curves = curves_of(map, surface, visible, RandomCase::kClasses);
    for (ClassId c = 1; c < RandomCase::kClasses; ++c) {
      for (const CurvePoint& point : points_of(curves[c])) {
        const ClassCounts counts =
            score_voxels(map, point.threshold, surface, visible, RandomCase::kClasses)[c];
        EXPECT_EQ(point.predicted, counts.predicted);
        EXPECT_EQ(point.true_predicted, counts.true_predicted);
        EXPECT_EQ(point.found, counts.found);
        EXPECT_EQ(point.f1, f1(counts));
      }
      const std::optional<double> ap = average_precision(curves[c]);
      EXPECT_TRUE(ap && *ap >= 0.0 && *ap <= 1.0);
    }
  }
}

TEST(Curve, PoolingAddsStepsOfEqualProbability) {
  ClassCurve total = hand_curve();
  total += hand_curve();
  EXPECT_EQ(total.visible, 8);
  EXPECT_EQ(total.steps.size(), 4u);
  EXPECT_EQ(total.steps[2], (ProbabilityStep{0.5, 4, 2, 2}));
  EXPECT_DOUBLE_EQ(*average_precision(total), *average_precision(hand_curve()));
}

}  // namespace
}  // namespace mapscore::eval
