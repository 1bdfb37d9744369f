// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#include "core/random_stream.hpp"
#include "eval/score/distances/distance_score.hpp"
#include "eval/score/voxel_score.hpp"
#include "tests/eval/score/plain_score.hpp"
#include "tests/eval/score/sample_sets.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <utility>
#include <vector>

// The fast scores against plain ones, over a thousand random scenes.

namespace mapscore::eval {
namespace {

using testing::kClasses;
using testing::kScenes;
using testing::PlainScore;
using testing::RandomScene;
using testing::sample_set_of;

TEST(PlainTwin, OfTheVoxelScoreCountsTheSame) {
  const ScoreOptions options{{1, 2, 4}, {}};
  for (std::uint64_t seed = 0; seed < kScenes; ++seed) {
    const RandomScene scene = testing::random_scene(seed);
    const SurfaceTruth surface = scene.surface();
    const auto map = testing::random_map(surface, seed);
    const auto views = testing::random_views(surface, seed);
    const VisibleTruth visible = visible_truth(testing::counted(scene, views), surface, 1);
    const double threshold = static_cast<double>(seed % 5) / 4;
    const Counts counts =
        score_voxels(MapSnapshot(map), threshold, surface, visible, kClasses, options);
    const PlainScore plain(surface, visible, map, threshold);
    for (ClassId c = 0; c < kClasses; ++c) {
      EXPECT_EQ(counts[c], plain.of(c, options.tolerances)) << "class " << c << ", scene " << seed;
    }
  }
}

/// Samples are kept in single precision, 2 nm off at most; rounding may add one.
constexpr double kStored_m = 3e-9;

void expect_tally(const DistanceTally& tally, const std::vector<double>& distances,
                  std::uint64_t seed) {
  ASSERT_EQ(tally.count(), static_cast<std::int64_t>(distances.size())) << seed;
  const auto within = [&](double limit_m) {
    return std::ranges::count_if(distances, [=](double d) { return d <= limit_m; });
  };
  for (std::size_t l = 0; l < tally.limits_m().size(); ++l) {
    const double limit_m = tally.limits_m()[l] + kDistanceSlack_m;
    EXPECT_GE(tally.within(l), within(limit_m - kStored_m)) << seed;
    EXPECT_LE(tally.within(l), within(limit_m + kStored_m)) << seed;
  }
  EXPECT_EQ(tally.parts().unreached, std::ranges::count(distances, kUnreached)) << seed;
  if (const auto mean_m = tally.mean_m()) {
    double sum = 0.0;
    for (const double d : distances) sum += d;
    EXPECT_NEAR(*mean_m, sum / static_cast<double>(distances.size()), kStored_m) << seed;
  }
}

TEST(PlainTwin, OfTheDistanceScoreMeasuresTheSame) {
  const ScoreOptions options{{}, {0.001, 0.01, 0.03, 0.1}};
  for (std::uint64_t seed = 0; seed < kScenes; ++seed) {
    const RandomScene scene = testing::random_scene(seed);
    const SurfaceTruth surface = scene.surface();
    const auto map = testing::random_map(surface, seed);
    const auto points = testing::points_of(scene, testing::random_views(surface, seed));
    const double threshold = static_cast<double>(seed % 5) / 4;
    const auto distance_of =
        cube_distance(prepare(scene.shapes, Pose::Identity()), scene.table, scene.edge_m);
    Counts counts = zero_counts(kClasses, options);
    const SampleSet samples = sample_set_of(points, scene.edge_m);
    score_distances(MapSnapshot(map), threshold, distance_of, samples, options, counts);
    const PlainScore plain(surface, {}, map, threshold);
    for (ClassId c = 1; c < kClasses; ++c) {
      expect_tally(counts[c].accuracy, plain.accuracy(c, scene), seed);
      expect_tally(counts[c].completeness, plain.completeness(c, points, scene.edge_m), seed);
    }
  }
}

/// Large enough that every job has something to do.
TEST(DistanceScore, DoesNotDependOnJobs) {
  RandomStream random(1, "many cubes");
  const auto index = [&] { return static_cast<int>(random.uniform() * 64); };
  std::map<VoxelKey, MapVoxel> map;
  testing::Points points(kClasses);
  for (int n = 0; n < 60000; ++n) {
    const int i = index(), j = index(), k = index();
    const auto c = static_cast<ClassId>(1 + n % 2);
    map[{i, j, k}] = {{i, j, k}, c, 1.0, true};
    const int x = index(), y = index(), z = index();
    points[c].push_back(Eigen::Vector3d(x + random.uniform(), y, z + random.uniform()) * 0.05);
  }
  std::vector<MapVoxel> voxels;
  for (const auto& [key, voxel] : map) voxels.push_back(voxel);
  const MapSnapshot snapshot(std::move(voxels));
  const SampleSet samples = sample_set_of(points, 0.05);
  ASSERT_GT(samples.groups(1).size(), 20000u);
  const auto distance_of = [](const VoxelKey& key, ClassId c) { return 0.0007 * key.i * c; };
  const ScoreOptions options;
  Counts one = zero_counts(kClasses, options);
  score_distances(snapshot, 0.5, distance_of, samples, options, one);
  EXPECT_GT(one[1].completeness.within(0), one[1].completeness.count() / 10);
  EXPECT_LT(one[1].completeness.within(0), one[1].completeness.count());
  for (const int jobs : {2, 3, 7}) {
    Counts many = zero_counts(kClasses, options);
    score_distances(snapshot, 0.5, distance_of, samples, options, many, jobs);
    EXPECT_EQ(one, many) << jobs;
  }
}

}  // namespace
}  // namespace mapscore::eval
