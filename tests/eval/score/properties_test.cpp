// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#include "eval/score/distances/distance_score.hpp"
#include "eval/score/metrics.hpp"
#include "eval/score/voxel_score.hpp"
#include "tests/eval/score/plain_score.hpp"
#include "tests/eval/score/random_scene.hpp"
#include "tests/eval/score/sample_sets.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <ranges>
#include <utility>
#include <vector>

// What holds for the scores of every map against every scene. Over a thousand random scenes each,
// but where it says.

namespace mapscore::eval {
namespace {

using testing::counted;
using testing::kClasses;
using testing::kScenes;
using testing::kThreshold;
using testing::of_one_class;
using testing::PlainScore;
using testing::points_of;
using testing::random_map;
using testing::random_scene;
using testing::random_views;
using testing::RandomScene;
using testing::RandomView;
using testing::sample_set_of;

const ScoreOptions kOptions{{1, 2, 3, 4, 5}, {1e-6, 0.01, 0.02, 0.05, 0.1, 0.2, 0.5, 10}};

/// A random scene, what cameras see of it, and a map of it.
struct Case {
  explicit Case(std::uint64_t seed, bool one_class = false)
      : scene(random_scene(seed)),
        surface(one_class ? of_one_class(scene.surface()) : scene.surface()),
        views(random_views(surface, seed, one_class)),
        visible(visible_truth(counted(scene, views), surface, 1)),
        map(random_map(surface, seed)) {}

  [[nodiscard]] Counts score(const std::vector<MapVoxel>& voxels, const VisibleTruth& seen,
                             const testing::Points& points,
                             const ScoreOptions& options = kOptions) const {
    const MapSnapshot snapshot(voxels);
    Counts counts = score_voxels(snapshot, kThreshold, surface, seen, kClasses, options);
    const auto distance_of =
        cube_distance(prepare(scene.shapes, Pose::Identity()), scene.table, scene.edge_m);
    score_distances(snapshot, kThreshold, distance_of, sample_set_of(points, scene.edge_m), options,
                    counts);
    const std::vector<ClassCurve> curves = curves_of(snapshot, surface, seen, kClasses);
    for (std::size_t c = 0; c < kClasses; ++c) counts[c].curve = curves[c];
    return counts;
  }
  [[nodiscard]] Counts score() const { return score(map, visible, points_of(scene, views)); }

  RandomScene scene;
  SurfaceTruth surface;
  std::vector<RandomView> views;
  VisibleTruth visible;
  std::vector<MapVoxel> map;
};

/// The truth as a map that is certain of it; background is not in it.
std::vector<MapVoxel> as_map(const SurfaceTruth& surface) {
  std::vector<MapVoxel> voxels;
  for (const SurfaceVoxel& row : surface.voxels()) {
    if (row.class_id != kBackground) voxels.push_back({row.key, row.class_id, 1.0, true});
  }
  return voxels;
}

/// Distances from cubes that touch the surface only by epsilon are up to its diagonal.
void expect_distance_of_epsilon(const Metric& metric, double epsilon_m, std::uint64_t seed) {
  constexpr double kBin_m = 0.001;  // percentiles are rounded up to it
  const bool mean = metric.name.ends_with("_mean_m");
  const double farthest_m = std::sqrt(3.0) * epsilon_m + 1e-9;
  EXPECT_LE(metric.value.value_or(0.0), mean || epsilon_m == 0.0 ? farthest_m : kBin_m)
      << metric.name << " of scene " << seed;
}

TEST(Properties, TruthAgainstItselfScoresOne) {
  const ScoreOptions options{kOptions.tolerances, {0.001, 0.01, 0.02, 0.05, 0.1}};
  std::int64_t seen = 0;
  for (std::uint64_t seed = 0; seed < kScenes; ++seed) {
    const Case made(seed, true);
    const Counts counts =
        made.score(as_map(made.surface), made.visible, points_of(made.scene, made.views), options);
    for (ClassId c = 1; c < kClasses; ++c) {
      if (counts[c].predicted == 0) continue;
      for (const Metric& metric : metrics_of(counts[c])) {
        if (metric.name.starts_with("box")) continue;  // of detections, which are not scored here
        if (metric.name.ends_with("_4") && counts[c].visible_4 == 0) {
          EXPECT_EQ(metric.value, std::nullopt) << metric.name << " of scene " << seed;
        } else if (metric.name == "brier" || metric.name == "ece") {
          EXPECT_EQ(metric.value, 0.0) << metric.name << " of scene " << seed;
        } else if (metric.name.ends_with("_m")) {
          expect_distance_of_epsilon(metric, made.scene.epsilon_m, seed);
        } else if (counts[c].visible > 0 || metric.name.starts_with("precision")) {
          EXPECT_EQ(metric.value, 1.0) << metric.name << " of scene " << seed;
        }
      }
      seen += counts[c].visible > 0 ? 1 : 0;
    }
  }
  EXPECT_GT(seen, static_cast<std::int64_t>(kScenes));
}

TEST(Properties, EveryRatioLiesBetweenZeroAndOne) {
  std::int64_t between = 0;
  for (std::uint64_t seed = 0; seed < kScenes; ++seed) {
    const Case made(seed);
    const Counts counts = made.score();
    std::vector<std::vector<Metric>> groups{macro_metrics(counts, made.scene.table),
                                            metrics_of(pool_detected(counts, made.scene.table))};
    for (const ClassCounts& of_class : counts) groups.push_back(metrics_of(of_class));
    for (const std::vector<Metric>& metrics : groups) {
      for (const Metric& metric : metrics) {
        if (!metric.value) continue;
        EXPECT_GE(*metric.value, 0.0) << metric.name << " of scene " << seed;
        if (metric.name.ends_with("_m")) continue;
        EXPECT_LE(*metric.value, 1.0) << metric.name << " of scene " << seed;
        between += *metric.value > 0.0 && *metric.value < 1.0 ? 1 : 0;
      }
    }
  }
  EXPECT_GT(between, static_cast<std::int64_t>(10 * kScenes));
}

/// The figures must not fall from left to right, nor become undefined or defined.
void expect_ascending(const std::vector<std::optional<double>>& values, std::uint64_t seed) {
  for (std::size_t n = 1; n < values.size(); ++n) {
    ASSERT_EQ(values[n - 1].has_value(), values[n].has_value()) << "scene " << seed;
    EXPECT_LE(values[n - 1].value_or(0.0), values[n].value_or(0.0)) << "scene " << seed;
  }
}

TEST(Properties, GrowingToleranceOrDistanceNeverLowersARatio) {
  for (std::uint64_t seed = 0; seed < kScenes; ++seed) {
    const Case made(seed);
    const Counts counts = made.score();
    for (const ClassCounts& of_class : counts) {
      const std::vector<Metric> metrics = metrics_of(of_class);
      for (const char* figure : {"precision", "recall", "f1"}) {
        std::vector<std::optional<double>> values{value_of(metrics, figure)};
        for (const int t : kOptions.tolerances)
          values.push_back(value_of(metrics, std::string(figure) + "_t" + std::to_string(t)));
        expect_ascending(values, seed);
      }
      if (of_class.accuracy.limits_m().empty()) continue;  // background
      for (const char* figure : {"precision_", "recall_", "f_"}) {
        std::vector<std::optional<double>> values;
        for (const char* tau : {"0.0001", "1", "2", "5", "10", "20", "50", "1000"})
          values.push_back(value_of(metrics, std::string(figure) + tau + "cm"));
        expect_ascending(values, seed);
      }
    }
  }
}

TEST(Properties, SwappingMapAndTruthSwapsPrecisionAndRecall) {
  std::int64_t different = 0;
  for (std::uint64_t seed = 0; seed < kScenes; ++seed) {
    const RandomScene scene = random_scene(seed);
    RandomScene exact = scene;
    exact.epsilon_m = 0.0;
    const SurfaceTruth truth = of_one_class(exact.surface());
    std::vector<SurfaceVoxel> rows;
    for (const MapVoxel& voxel : random_map(truth, seed)) {
      rows.push_back({voxel.key, voxel.best_class, false});
    }
    const SurfaceTruth map(std::move(rows), truth.edge_m());
    const Counts forth = score_voxels(MapSnapshot(as_map(map)), kThreshold, truth,
                                      whole_surface(truth), kClasses, kOptions);
    const Counts back = score_voxels(MapSnapshot(as_map(truth)), kThreshold, map,
                                     whole_surface(map), kClasses, kOptions);
    for (ClassId c = 1; c < kClasses; ++c) {
      const std::vector<Metric> a = metrics_of(forth[c]), b = metrics_of(back[c]);
      for (const char* at : {"", "_t1", "_t2", "_t3", "_t4", "_t5"}) {
        const std::string precision = std::string("precision") + at;
        const std::string recall = std::string("recall") + at;
        EXPECT_EQ(value_of(a, precision), value_of(b, recall)) << seed;
        EXPECT_EQ(value_of(a, recall), value_of(b, precision)) << seed;
        EXPECT_EQ(value_of(a, std::string("f1") + at), value_of(b, std::string("f1") + at)) << seed;
        different += value_of(a, precision) != value_of(a, recall) ? 1 : 0;
      }
      EXPECT_EQ(iou(forth[c]), iou(back[c])) << seed;
    }
  }
  EXPECT_GT(different, static_cast<std::int64_t>(kScenes));
}

/// Every number of the counts of a class, in a fixed order.
std::vector<std::int64_t> numbers_of(const ClassCounts& c) {
  std::vector<std::int64_t> numbers{c.predicted,      c.true_predicted,     c.visible,
                                    c.found,          c.false_near,         c.false_leak,
                                    c.false_floating, c.missed_mislabelled, c.missed_unlabelled,
                                    c.missed_unmapped};
  for (const ToleranceCounts& at : c.at_tolerance) {
    numbers.push_back(at.true_predicted);
    numbers.push_back(at.found);
  }
  for (const DistanceTally* tally : {&c.accuracy, &c.completeness}) {
    DistanceTally::Parts parts = tally->parts();
    parts.bins.resize(10000);
    for (const std::int64_t n : {parts.count, parts.unreached, parts.sum_nm}) numbers.push_back(n);
    numbers.insert(numbers.end(), parts.within.begin(), parts.within.end());
    numbers.insert(numbers.end(), parts.bins.begin(), parts.bins.end());
  }
  numbers.push_back(c.curve.visible);
  numbers.push_back(c.curve.squared_error_billionth);
  std::vector<std::int64_t> steps(4 * (kCurveSteps + 1));
  for (const CurveStep& step : c.curve.steps) {
    const std::size_t at = 4 * static_cast<std::size_t>(step.thousandth);
    steps[at] = step.predicted;
    steps[at + 1] = step.true_predicted;
    steps[at + 2] = step.found;
    steps[at + 3] = step.probability_sum_billionth;
  }
  numbers.insert(numbers.end(), steps.begin(), steps.end());
  return numbers;
}

// A number that is not pooled shows in the first scene where it is not 0, so a few scenes will do;
// that each kind of count was not 0 somewhere is checked below.
TEST(Properties, PooledCountsAreTheSumOverFrames) {
  constexpr std::uint64_t kFewScenes = 100;
  constexpr std::size_t kKinds = 14;  // what numbers_of begins with: counts, two tolerances
  std::vector<std::int64_t> of_kind(kKinds);
  for (std::uint64_t seed = 0; seed < kFewScenes; ++seed) {
    const Case made(seed);
    Counts pooled;
    std::vector<std::vector<std::int64_t>> sums(kClasses);
    std::vector<SampleCounter> counters;
    for (std::size_t n = 0; n < made.views.size(); ++n) {
      const std::vector<RandomView> view{made.views[n]};
      counters.push_back(counted(made.scene, view));
      const Counts counts = made.score(random_map(made.surface, 4 * seed + n),
                                       visible_truth(counters.back(), made.surface, 1),
                                       points_of(made.scene, view), {{1, 3}, {0.01, 0.05}});
      pool_into(pooled, counts);
      for (std::size_t c = 0; c < kClasses; ++c) {
        const std::vector<std::int64_t> numbers = numbers_of(counts[c]);
        sums[c].resize(numbers.size() + (n == 0 ? 0 : sums[c].size() - numbers.size()));
        std::ranges::transform(numbers, sums[c], sums[c].begin(), std::plus{});
      }
    }
    for (std::size_t c = 0; c < kClasses; ++c) {
      ASSERT_EQ(numbers_of(pooled[c]), sums[c]) << seed;
      for (std::size_t kind = 0; kind < kKinds; ++kind) of_kind[kind] += sums[c][kind];
    }

    std::ranges::reverse(counters);
    SampleCounter merged(made.scene.edge_m);
    for (const SampleCounter& counter : counters) merged.merge(counter);
    EXPECT_TRUE(
        std::ranges::equal(visible_truth(merged, made.surface, 1).voxels(), made.visible.voxels()))
        << seed;
  }
  for (std::size_t kind = 0; kind < kKinds; ++kind) EXPECT_GT(of_kind[kind], 0) << kind;
}

TEST(Properties, CausesAddUpToTheErrors) {
  ClassCounts all;
  for (std::uint64_t seed = 0; seed < kScenes; ++seed) {
    const Case made(seed);
    const Counts counts = score_voxels(MapSnapshot(made.map), kThreshold, made.surface,
                                       made.visible, kClasses, {{}, {}});
    for (const ClassCounts& c : counts) {
      EXPECT_EQ(c.false_near + c.false_leak + c.false_floating, c.predicted - c.true_predicted);
      EXPECT_EQ(c.missed_mislabelled + c.missed_unlabelled + c.missed_unmapped,
                c.visible - c.found);
      all += c;
    }
  }
  for (const std::int64_t cause :
       {all.false_near, all.false_leak, all.false_floating, all.missed_mislabelled,
        all.missed_unlabelled, all.missed_unmapped}) {
    EXPECT_GT(cause, static_cast<std::int64_t>(kScenes));
  }
}

}  // namespace
}  // namespace mapscore::eval
