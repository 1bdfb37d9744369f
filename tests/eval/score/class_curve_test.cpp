// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#include "eval/score/class_curve.hpp"

#include "core/error.hpp"
#include "eval/score/metrics.hpp"
#include "eval/score/voxel_score.hpp"
#include "tests/eval/score/score_cases.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <map>

namespace mapscore::eval {
namespace {

using testing::kCup;
using testing::random_case;
using testing::RandomCase;
using testing::surface_of;
using testing::visible_of;

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

/// A curve of (thousandth, predicted, true_predicted, found), in the middle of their steps.
ClassCurve curve_of(std::int64_t visible, const std::vector<std::array<int, 4>>& steps) {
  ClassCurve curve;
  curve.visible = visible;
  for (const auto& [thousandth, predicted, true_predicted, found] : steps)
    curve.steps.push_back({thousandth, predicted, true_predicted, found,
                           std::int64_t{1000000} * thousandth * predicted});
  return curve;
}

TEST(Curve, StepsByHand) {
  const ClassCurve curve = hand_curve();
  EXPECT_EQ(curve.visible, 4);
  const std::vector<CurveStep> steps{{900, 1, 1, 1, 900000000},
                                     {800, 1, 0, 0, 800000000},
                                     {500, 2, 1, 1, 1000000000},
                                     {200, 1, 1, 1, 200000000}};
  EXPECT_EQ(curve.steps, steps);
  EXPECT_EQ(curve.squared_error_billionth, 10000000 + 640000000 + 2 * 250000000 + 640000000);
}

TEST(Curve, StepsAreThousandthsRoundedDown) {
  for (int k = 0; k <= 1000; ++k) {
    EXPECT_EQ(thousandth_of(k / 1000.0), k);
    EXPECT_EQ(thousandth_of(std::min(1.0, k / 1000.0 + 0.0009)), k);
  }
  EXPECT_EQ(thousandth_of(0.1 + 0.2), 300);            // rounding lies above
  EXPECT_EQ(thousandth_of(0.3 * 3 - 0.1 - 0.2), 600);  // and below
  EXPECT_EQ(thousandth_of(1.0 - 1e-6), 999);
}

TEST(Curve, AveragePrecisionByHandWithEqualScoresInOneStep) {
  // Recall rises by a quarter at 0.9 (precision 1), 0.5 (2/4) and 0.2 (3/5).
  EXPECT_DOUBLE_EQ(*average_precision(hand_curve()), 0.25 * 1.0 + 0.25 * 0.5 + 0.25 * 0.6);
}

TEST(Curve, BestThresholdIsTheHighestWithTheGreatestF1) {
  // F1 at 0.9: 2/5; 0.8: 1/3; 0.5: 1/2; 0.2: 2/3.
  EXPECT_EQ(best_f1_threshold(hand_curve()), 0.2);
  // F1: 2/3, 1/2, 2/3.
  EXPECT_EQ(best_f1_threshold(curve_of(2, {{900, 1, 1, 1}, {400, 2, 1, 0}, {300, 1, 0, 1}})), 0.9);
}

TEST(Curve, RoundingChoosesNoThreshold) {
  // With all true voxels visible F1 = 2 hits / (|V| + predicted): equal for 1 hit of n voxels and
  // for k hits of k (|V| + n) - |V|, but not always in doubles.
  int deceived = 0;
  for (int visible = 20; visible < 60; ++visible) {
    for (int n = 1; n < 40; ++n) {
      for (int k = 2; k < 5; ++k) {
        const int more = k * (visible + n) - visible - n;
        const ClassCurve curve = curve_of(visible, {{700, n, 1, 1}, {300, more, k - 1, k - 1}});
        const std::vector<CurvePoint> points = points_of(curve);
        EXPECT_NEAR(*points[0].f1, *points[1].f1, 1e-14);
        deceived += *points[1].f1 > *points[0].f1;
        EXPECT_EQ(best_f1_threshold(curve), 0.7);
      }
    }
  }
  EXPECT_GT(deceived, 100);
}

TEST(Curve, PointAtAThresholdTakesTheStepsFromItOn) {
  const ClassCurve curve = hand_curve();
  EXPECT_EQ(point_at(curve, 0.5).predicted, 4);
  EXPECT_EQ(point_at(curve, 0.501).predicted, 2);
  EXPECT_EQ(point_at(curve, 0.0).found, 3);
  const CurvePoint nothing = point_at(curve, std::nullopt);
  EXPECT_EQ(nothing.predicted, 0);
  EXPECT_EQ(nothing.precision, std::nullopt);
  EXPECT_EQ(nothing.f1, 0.0);
}

TEST(Curve, BrierAndReliabilityByHand) {
  const ClassCurve curve = hand_curve();
  EXPECT_DOUBLE_EQ(*brier(curve), (0.01 + 0.64 + 0.25 + 0.25 + 0.64) / 5);
  const std::vector<ReliabilityBin> bins = reliability(curve);
  ASSERT_EQ(bins.size(), 10u);
  EXPECT_EQ(bins[2].voxels, 1);
  EXPECT_DOUBLE_EQ(*bins[2].mean_probability, 0.2);
  EXPECT_DOUBLE_EQ(*bins[2].share_true, 1.0);
  EXPECT_EQ(bins[5].voxels, 2);
  EXPECT_DOUBLE_EQ(*bins[5].share_true, 0.5);
  EXPECT_EQ(bins[3].voxels, 0);
  EXPECT_EQ(bins[3].share_true, std::nullopt);
  // Bins 2, 5, 8 and 9 are off by 0.8, 0, 0.8 and 0.1.
  EXPECT_DOUBLE_EQ(*expected_calibration_error(curve), (0.8 + 2 * 0.0 + 0.8 + 0.1) / 5);
}

TEST(Curve, CertaintyFallsIntoTheLastBin) {
  const std::vector<ReliabilityBin> bins =
      reliability(curve_of(1, {{1000, 1, 1, 0}, {900, 1, 1, 0}, {899, 1, 0, 0}, {0, 1, 0, 0}}));
  EXPECT_EQ(bins[9].voxels, 2);
  EXPECT_EQ(bins[8].voxels, 1);
  EXPECT_EQ(bins[0].voxels, 1);
}

TEST(Curve, EmptyCurves) {
  EXPECT_EQ(average_precision(ClassCurve{}), std::nullopt);
  EXPECT_EQ(best_f1_threshold(ClassCurve{}), std::nullopt);
  EXPECT_EQ(brier(ClassCurve{}), std::nullopt);
  EXPECT_EQ(expected_calibration_error(ClassCurve{}), std::nullopt);
  ClassCurve missed;
  missed.visible = 3;
  EXPECT_EQ(average_precision(missed), 0.0);
}

/// A random world whose map's probabilities are not on whole thousandths.
RandomCase finely_graded(std::uint64_t seed) {
  RandomCase made = random_case(seed);
  RandomStream random(seed, "curve test");
  for (MapVoxel& voxel : made.map)
    voxel.probability = random.uniform() < 0.2 ? 1.0 : random.uniform();
  return made;
}

TEST(Curve, EveryPointIsTheScoreAtItsThreshold) {
  for (std::uint64_t seed = 0; seed < 40; ++seed) {
    const RandomCase made = seed % 2 == 0 ? random_case(seed) : finely_graded(seed);
    const MapSnapshot map(made.map);
    const SurfaceTruth surface = surface_of(made.surface);
    const VisibleTruth visible = visible_of(made.owners);
    const std::vector<ClassCurve> curves = curves_of(map, surface, visible, RandomCase::kClasses);
    for (ClassId c = 1; c < RandomCase::kClasses; ++c) {
      ASSERT_FALSE(curves[c].steps.empty());
      for (const CurvePoint& point : points_of(curves[c])) {
        const ClassCounts counts =
            score_voxels(map, point.threshold, surface, visible, RandomCase::kClasses)[c];
        EXPECT_EQ(point.predicted, counts.predicted);
        EXPECT_EQ(point.true_predicted, counts.true_predicted);
        EXPECT_EQ(point.found, counts.found);
        EXPECT_EQ(point.f1, f1(counts));
        EXPECT_EQ(point_at(curves[c], point.threshold).found, counts.found);
      }
    }
  }
}

/// The figures as the definitions say them, from the voxels themselves.
struct PlainFigures {
  double ap = 0.0, brier = 0.0, ece = 0.0;
};

PlainFigures plain_figures(const RandomCase& made, ClassId c) {
  struct Voxel {
    double p;
    bool is_true, found;
  };
  std::map<int, std::vector<Voxel>, std::greater<>> by_step;
  double visible = 0;
  for (const auto& [key, owner] : made.owners) visible += owner == c;
  PlainFigures plain;
  std::map<int, std::vector<Voxel>> by_bin;
  double all = 0;
  for (const MapVoxel& voxel : made.map) {
    if (!voxel.occupied || voxel.best_class != c) continue;
    const double p = voxel.probability;
    const auto owner = made.owners.find(voxel.key);
    const Voxel seen{p, made.surface.contains({voxel.key, c}),
                     owner != made.owners.end() && owner->second == c};
    by_step[static_cast<int>(std::floor(1000 * p + 1e-9))].push_back(seen);
    by_bin[std::min(9, static_cast<int>(std::floor(10 * p + 1e-9)))].push_back(seen);
    plain.brier += seen.is_true ? (1 - p) * (1 - p) : p * p;
    ++all;
  }
  double predicted = 0, is_true = 0, found = 0, recall_before = 0;
  for (const auto& [step, voxels] : by_step) {
    for (const Voxel& voxel : voxels)
      predicted += 1, is_true += voxel.is_true, found += voxel.found;
    plain.ap += (found / visible - recall_before) * is_true / predicted;
    recall_before = found / visible;
  }
  for (const auto& [bin, voxels] : by_bin) {
    double off = 0;
    for (const Voxel& voxel : voxels) off += voxel.p - voxel.is_true;
    plain.ece += std::abs(off) / all;
  }
  plain.brier /= all;
  return plain;
}

TEST(Curve, FiguresAreThoseOfTheVoxelsThemselves) {
  for (std::uint64_t seed = 0; seed < 60; ++seed) {
    const RandomCase made = seed % 2 == 0 ? random_case(seed) : finely_graded(seed);
    const std::vector<ClassCurve> curves =
        curves_of(MapSnapshot(made.map), surface_of(made.surface), visible_of(made.owners),
                  RandomCase::kClasses);
    for (ClassId c = 1; c < RandomCase::kClasses; ++c) {
      if (curves[c].visible == 0) continue;
      const PlainFigures plain = plain_figures(made, c);
      EXPECT_NEAR(average_precision(curves[c]).value(), plain.ap, 1e-12);
      EXPECT_NEAR(brier(curves[c]).value(), plain.brier, 1e-9);
      EXPECT_NEAR(expected_calibration_error(curves[c]).value(), plain.ece, 1e-9);
      for (const double figure : {*average_precision(curves[c]), *brier(curves[c]),
                                  *expected_calibration_error(curves[c])}) {
        EXPECT_GE(figure, 0.0);
        EXPECT_LE(figure, 1.0);
      }
    }
  }
}

TEST(Curve, PoolingAddsStepsAndIsTheCurveOfAllVoxels) {
  ClassCurve total = hand_curve();
  total += hand_curve();
  EXPECT_EQ(total.visible, 8);
  EXPECT_EQ(total.steps.size(), 4u);
  EXPECT_EQ(total.steps[2], (CurveStep{500, 4, 2, 2, 2000000000}));
  EXPECT_EQ(total.squared_error_billionth, 2 * hand_curve().squared_error_billionth);
  EXPECT_DOUBLE_EQ(*average_precision(total), *average_precision(hand_curve()));
  total += curve_of(1, {{1000, 1, 1, 0}, {800, 2, 0, 0}, {0, 1, 0, 1}});
  const std::vector<CurveStep> steps{{1000, 1, 1, 0, 1000000000}, {900, 2, 2, 2, 1800000000},
                                     {800, 4, 0, 0, 3200000000},  {500, 4, 2, 2, 2000000000},
                                     {200, 2, 2, 2, 400000000},   {0, 1, 0, 1, 0}};
  EXPECT_EQ(total.steps, steps);
  ClassCurve other = curve_of(1, {{1000, 1, 1, 0}, {800, 2, 0, 0}, {0, 1, 0, 1}});
  other += hand_curve();
  other += hand_curve();
  EXPECT_EQ(other, total);
}

TEST(Curve, AClassThatTheTableHasNotIsRefused) {
  const MapSnapshot map({{{0, 0, 0}, 5, 0.9, true}});
  EXPECT_THROW(static_cast<void>(curves_of(map, surface_of({}), visible_of({}), 2)), Error);
  EXPECT_THROW(static_cast<void>(
                   curves_of(MapSnapshot({}), surface_of({}), visible_of({{{0, 0, 0}, 5}}), 2)),
               Error);
}

}  // namespace
}  // namespace mapscore::eval
