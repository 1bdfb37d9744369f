// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#include "core/random_stream.hpp"
#include "eval/score/distances/distance_score.hpp"
#include "eval/score/voxel_score.hpp"
#include "tests/eval/score/random_scene.hpp"
#include "tests/eval/score/sample_sets.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <ranges>
#include <utility>
#include <vector>

// What must not change truth and counts: the order of geoms, how surfaces are cut into shapes and
// triangles, where the origin of the lattice lies. Over a thousand random scenes each.

namespace mapscore::eval {
namespace {

using testing::counted;
using testing::kClasses;
using testing::kScenes;
using testing::kThreshold;
using testing::points_of;
using testing::random_map;
using testing::random_scene;
using testing::random_views;
using testing::RandomScene;
using testing::sample_set_of;

/// Everything that is computed of a scene, one camera set and one map.
struct Everything {
  SurfaceTruth surface;
  VisibleTruth visible;
  Counts counts;
};

Everything everything_of(const RandomScene& scene, const std::vector<testing::RandomView>& views,
                         const MapSnapshot& map) {
  const ScoreOptions options{{1, 2, 3}, {0.01, 0.05, 0.1}};
  Everything all;
  all.surface = scene.surface();
  all.visible = visible_truth(counted(scene, views), all.surface, 1);
  all.counts = score_voxels(map, kThreshold, all.surface, all.visible, kClasses, options);
  const auto distance_of =
      cube_distance(prepare(scene.shapes, Pose::Identity()), scene.table, scene.edge_m);
  score_distances(map, kThreshold, distance_of,
                  sample_set_of(points_of(scene, views), scene.edge_m), options, all.counts);
  return all;
}

Everything everything_of(const RandomScene& scene, std::uint64_t seed) {
  const SurfaceTruth surface = scene.surface();
  return everything_of(scene, random_views(surface, seed), MapSnapshot(random_map(surface, seed)));
}

void expect_same(const Everything& a, const Everything& b, std::uint64_t seed) {
  EXPECT_TRUE(std::ranges::equal(a.surface.voxels(), b.surface.voxels())) << "scene " << seed;
  EXPECT_TRUE(std::ranges::equal(a.visible.voxels(), b.visible.voxels())) << "scene " << seed;
  EXPECT_EQ(a.counts, b.counts) << "scene " << seed;
}

TEST(Invariance, ToTheOrderOfGeoms) {
  std::size_t visible = 0;
  for (std::uint64_t seed = 0; seed < kScenes; ++seed) {
    RandomScene scene = random_scene(seed);
    const Everything before = everything_of(scene, seed);
    RandomStream random(seed, "order");
    for (std::size_t n = scene.shapes.size() - 1; n > 0; --n) {
      std::swap(scene.shapes[n], scene.shapes[random.bits() % (n + 1)]);
    }
    std::rotate(scene.shapes.begin(), scene.shapes.begin() + 1, scene.shapes.end());
    expect_same(before, everything_of(scene, seed), seed);
    visible += before.visible.voxels().size();
  }
  EXPECT_GT(visible, 30 * kScenes);  // there was something to see
}

/// Every mesh as two shapes of its instance: its even triangles, and its odd ones cut in two at the
/// middle of a side.
std::vector<Shape> split_meshes(const std::vector<Shape>& shapes, int& meshes) {
  std::vector<Shape> split;
  for (const Shape& shape : shapes) {
    split.push_back(shape);
    if (shape.kind != ShapeKind::mesh) continue;
    ++meshes;
    Shape even = shape, odd = shape;
    even.triangles.clear();
    odd.triangles.clear();
    for (std::size_t t = 0; t < shape.triangles.size(); ++t) {
      const auto& [a, b, c] = shape.triangles[t];
      const Eigen::Vector3d middle = (a + b) / 2;
      if (t % 2 == 1) even.triangles.push_back(shape.triangles[t]);
      if (t % 2 == 1) continue;
      odd.triangles.push_back({a, middle, c});
      odd.triangles.push_back({middle, b, c});
    }
    split.back() = odd;
    if (!even.triangles.empty()) split.push_back(even);
  }
  return split;
}

TEST(Invariance, ToSplittingMeshesAndTriangles) {
  int meshes = 0;
  for (std::uint64_t seed = 0; seed < kScenes; ++seed) {
    RandomScene scene = random_scene(seed);
    Shape mesh = scene.shapes.front();  // at least one, through the middle of the heap
    mesh.kind = ShapeKind::mesh;
    const double far = 4 * scene.edge_m;
    mesh.triangles = {{{{-far, 0, 0}, {far, 0, 0}, {0, far, far / 2}}},
                      {{{far, 0, 0}, {0, far, far / 2}, {far, far, -far}}}};
    scene.shapes.push_back(mesh);
    const Everything before = everything_of(scene, seed);
    scene.shapes = split_meshes(scene.shapes, meshes);
    expect_same(before, everything_of(scene, seed), seed);
  }
  EXPECT_GT(meshes, static_cast<int>(kScenes));
}

/// Equal but for the sum of the distances, each of which may round to the next nanometre.
void expect_same_but_for_rounding(const DistanceTally& a, const DistanceTally& b,
                                  std::uint64_t seed) {
  DistanceTally::Parts x = a.parts(), y = b.parts();
  EXPECT_LE(std::abs(x.sum_nm - y.sum_nm), x.count) << seed;
  EXPECT_EQ(x.limits_m, y.limits_m);
  EXPECT_EQ(x.within, y.within) << seed;
  EXPECT_EQ(x.count, y.count) << seed;
  EXPECT_EQ(x.unreached, y.unreached) << seed;
  EXPECT_EQ(x.bins, y.bins) << seed;
}

void expect_same_but_for_rounding(Counts a, Counts b, std::uint64_t seed) {
  ASSERT_EQ(a.size(), b.size());
  for (std::size_t c = 0; c < a.size(); ++c) {
    expect_same_but_for_rounding(a[c].accuracy, b[c].accuracy, seed);
    expect_same_but_for_rounding(a[c].completeness, b[c].completeness, seed);
    a[c].accuracy = b[c].accuracy;
    a[c].completeness = b[c].completeness;
  }
  EXPECT_EQ(a, b) << seed;
}

/// Edges, positions and moves are dyadic, so that sums of them are exact; what is left to rounding
/// (turned shapes, epsilon) lies far within the contact slack of 1e-10 m.
TEST(Invariance, ToMovingSceneAndMapByWholeVoxels) {
  for (std::uint64_t seed = 0; seed < kScenes; ++seed) {
    const RandomScene scene = random_scene(seed, true);
    const SurfaceTruth surface = scene.surface();
    auto views = random_views(surface, seed);
    std::vector<MapVoxel> map = random_map(surface, seed);
    const Everything before = everything_of(scene, views, MapSnapshot(map));

    RandomStream random(seed, "move");
    const auto step = [&] { return static_cast<int>(random.uniform() * 4001) - 2000; };
    const VoxelKey by{step(), step(), step()};
    const Eigen::Vector3d by_m = low_corner_of(by, scene.edge_m);
    const auto moved = [&](const VoxelKey& key) {
      return VoxelKey{key.i + by.i, key.j + by.j, key.k + by.k};
    };
    RandomScene there = scene;
    for (Shape& shape : there.shapes) shape.T_world_shape.translation() += by_m;
    for (auto& view : views) view.T_map_camera.translation() += by_m;
    for (MapVoxel& voxel : map) voxel.key = moved(voxel.key);
    const Everything after = everything_of(there, views, MapSnapshot(map));

    ASSERT_EQ(before.surface.voxels().size(), after.surface.voxels().size()) << seed;
    ASSERT_EQ(before.visible.voxels().size(), after.visible.voxels().size()) << seed;
    for (std::size_t n = 0; n < before.surface.voxels().size(); ++n) {
      SurfaceVoxel row = before.surface.voxels()[n];
      row.key = moved(row.key);
      EXPECT_EQ(row, after.surface.voxels()[n]) << seed;
    }
    for (std::size_t n = 0; n < before.visible.voxels().size(); ++n) {
      VisibleVoxel row = before.visible.voxels()[n];
      row.key = moved(row.key);
      EXPECT_EQ(row, after.visible.voxels()[n]) << seed;
    }
    expect_same_but_for_rounding(before.counts, after.counts, seed);
  }
}

}  // namespace
}  // namespace mapscore::eval
