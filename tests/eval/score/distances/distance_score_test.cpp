// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#include "eval/score/distances/distance_score.hpp"

#include "core/error.hpp"
#include "eval/score/metrics.hpp"
#include "eval/score/voxel_score.hpp"
#include "tests/eval/score/sample_sets.hpp"
#include "tests/eval/score/score_cases.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace mapscore::eval {
namespace {

using testing::kCup;
using testing::kEdge_m;
using testing::map_of;
using testing::random_case;
using testing::RandomCase;
using testing::sample_count;
using testing::sample_set_of;

using Points = std::vector<std::vector<Eigen::Vector3d>>;

TEST(SampleSet, GroupsByVoxelAndKeepsEverySample) {
  const SampleSet samples = sample_set_of(
      Points{{}, {{0.01, 0.01, 0.01}, {-0.01, 0.02, 0.03}, {0.04, 0.02, 0.0}}, {}}, kEdge_m);
  ASSERT_EQ(samples.class_count(), 3u);
  EXPECT_EQ(sample_count(samples, 1), 3u);
  EXPECT_TRUE(samples.groups(2).empty());
  ASSERT_EQ(samples.groups(1).size(), 2u);
  EXPECT_EQ(samples.groups(1)[0].key, (VoxelKey{-1, 0, 0}));
  EXPECT_EQ(samples.groups(1)[1].key, (VoxelKey{0, 0, 0}));
  const auto pair = samples.offsets(1, samples.groups(1)[1]);
  ASSERT_EQ(pair.size(), 2u);
  EXPECT_LT((pair[1].cast<double>() - Eigen::Vector3d(0.015, -0.005, -0.025)).norm(), 3e-9);
}

TEST(DistanceScore, ByHandOnOneRow) {
  const MapSnapshot map = map_of({{{0, 0, 0}, kCup}, {{4, 0, 0}, kCup}});
  const auto distance_of = [](const VoxelKey& key, ClassId) { return key.i == 0 ? 0.0 : 0.03; };
  // In the first cube; 1 cm before the second (the limit counts); 7.5 cm from either.
  const SampleSet samples = sample_set_of(
      Points{{}, {{0.02, 0.02, 0.02}, {0.19, 0.02, 0.02}, {0.125, 0.02, 0.02}}}, kEdge_m);
  const ScoreOptions options;
  Counts counts = zero_counts(2, options);
  score_distances(map, 0.5, distance_of, samples, options, counts);
  const DistanceTally &accuracy = counts[kCup].accuracy, &completeness = counts[kCup].completeness;
  EXPECT_EQ(accuracy.count(), 2);
  EXPECT_EQ(accuracy.within(1), 1);
  EXPECT_EQ(accuracy.within(2), 2);
  EXPECT_DOUBLE_EQ(*accuracy.mean_m(), 0.015);
  EXPECT_EQ(completeness.count(), 3);
  EXPECT_EQ(completeness.within(0), 2);
  EXPECT_EQ(completeness.within(2), 2);
  EXPECT_EQ(completeness.within(3), 3);
  EXPECT_NEAR(*completeness.mean_m(), (0.0 + 0.01 + 0.075) / 3, 2e-9);
  EXPECT_DOUBLE_EQ(*completeness.percentile_m(0.95), 0.075);
}

TEST(DistanceScore, MeasuresFromClosedCubesToExactSurfaces) {
  ClassTable table;
  table.classes.push_back({kCup, "cup", {}, true});
  table.classes.push_back({2, "absent", {}, true});
  table.instances.push_back({1, "cup_1", kCup});
  Shape ball;
  ball.kind = ShapeKind::sphere;
  ball.instance = 1;
  ball.size = {0.5, 0, 0};
  const CubeDistance distance_of = cube_distance(prepare({ball}, Pose::Identity()), table, 0.1);
  EXPECT_NEAR(distance_of({7, 0, 0}, kCup), 0.2, 1e-9);
  EXPECT_NEAR(distance_of({4, 0, 0}, kCup), 0.0, 1e-9);
  EXPECT_NEAR(distance_of({0, 0, 0}, kCup), 0.5 - 0.1 * std::sqrt(3.0), 1e-9);  // from within
  EXPECT_NEAR(distance_of({-8, -8, -8}, kCup), 0.7 * std::sqrt(3.0) - 0.5, 1e-9);
  EXPECT_EQ(distance_of({0, 0, 0}, 2), kUnreached);
}

TEST(DistanceScore, AClassWithoutPredictionReachesNothing) {
  const ScoreOptions options;
  Counts counts = zero_counts(2, options);
  const SampleSet samples = sample_set_of(Points{{}, {{0.02, 0.02, 0.02}}}, kEdge_m);
  score_distances(
      MapSnapshot({}), 0.5, [](const VoxelKey&, ClassId) { return 0.0; }, samples, options, counts);
  const std::vector<Metric> metrics = metrics_of(counts[kCup]);
  EXPECT_EQ(value_of(metrics, "precision_1cm"), std::nullopt);
  EXPECT_EQ(value_of(metrics, "recall_10cm"), 0.0);
  EXPECT_EQ(value_of(metrics, "f_10cm"), 0.0);
  EXPECT_EQ(value_of(metrics, "completeness_mean_m"), std::nullopt);
  EXPECT_EQ(counts[kCup].completeness.parts().unreached, 1);
}

TEST(DistanceScore, GrowingDistanceNeverLowersARatioAndAllLieInZeroToOne) {
  for (std::uint64_t seed = 0; seed < 50; ++seed) {
    const RandomCase made = random_case(seed);
    RandomStream random(seed, "distance test");
    Points points(RandomCase::kClasses);
    for (int n = 0; n < 400; ++n) {
      const double x = random.uniform(), y = random.uniform(), z = random.uniform();
      points[1 + n % 3].push_back((Eigen::Vector3d(x, y, z).array() - 0.5).matrix() * 0.4);
    }
    const auto distance_of = [&](const VoxelKey& key, ClassId) { return std::abs(key.i) * 0.013; };
    const ScoreOptions options;
    Counts counts = zero_counts(RandomCase::kClasses, options);
    score_distances(MapSnapshot(made.map), 0.7, distance_of, sample_set_of(points, kEdge_m),
                    options, counts);
    for (const ClassCounts& c : counts) {
      for (std::size_t l = 1; l < c.accuracy.limits_m().size(); ++l) {
        EXPECT_GE(c.accuracy.within(l), c.accuracy.within(l - 1));
        EXPECT_GE(c.completeness.within(l), c.completeness.within(l - 1));
      }
      for (const Metric& metric : metrics_of(c)) {
        const double value = metric.value.value_or(0.0);
        EXPECT_TRUE(value >= 0.0 && value <= 1.0) << metric.name;
      }
    }
  }
}

TEST(DistanceScore, EveryClassHasItsOwnSurfaceCubesAndSamples) {
  const MapSnapshot map = map_of({{{0, 0, 0}, 1}, {{4, 0, 0}, 2}});
  const auto distance_of = [](const VoxelKey&, ClassId c) { return c == 2 ? 0.02 : 0.05; };
  const SampleSet samples =
      sample_set_of(Points{{}, {{0.22, 0.02, 0.02}}, {{0.22, 0.02, 0.02}}}, kEdge_m);
  Counts counts = zero_counts(3, {});
  score_distances(map, 0.5, distance_of, samples, {}, counts);
  EXPECT_DOUBLE_EQ(*counts[1].accuracy.mean_m(), 0.05);
  EXPECT_DOUBLE_EQ(*counts[2].accuracy.mean_m(), 0.02);
  EXPECT_NEAR(*counts[1].completeness.mean_m(), 0.17, 2e-9);
  EXPECT_EQ(counts[2].completeness.mean_m(), 0.0);
}

TEST(DistanceScore, RefusesSamplesOfAnotherClassTable) {
  Counts counts = zero_counts(3, {});
  EXPECT_THROW(score_distances(
                   MapSnapshot({}), 0.5, [](const VoxelKey&, ClassId) { return 0.0; },
                   sample_set_of(Points{{}, {}}, kEdge_m), {}, counts),
               Error);
}

}  // namespace
}  // namespace mapscore::eval
