// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#include "core/random_stream.hpp"
#include "eval/score/distances/distance_score.hpp"
#include "eval/score/map_snapshot.hpp"
#include "eval/score/voxel_score.hpp"
#include "tests/bench/peak_memory.hpp"
#include "tests/eval/score/sample_sets.hpp"

#include <benchmark/benchmark.h>

#include <algorithm>
#include <cmath>
#include <vector>

namespace {

using namespace mapscore;
using namespace mapscore::eval;
using mapscore::eval::testing::sample_set_of;

constexpr double kTileEdge_m = 0.05;
constexpr int kClasses = 6;

/// A square floor of tiles of five classes, `side` x `side` voxels, and a map of it of the same
/// size in which one voxel in ten is off by 1 to 8 voxels upwards. Every second tile is visible,
/// with 8 samples a voxel.
struct Scene {
  SurfaceTruth surface;
  VisibleTruth visible;
  SampleSet samples;
  CubeDistance distance_of;
  std::vector<MapVoxel> map;
};

constexpr int kTile = 20;

ClassId class_at(int i, int j) {
  return static_cast<ClassId>(1 + (i / kTile + 2 * (j / kTile)) % (kClasses - 1));
}

CubeDistance tile_distances(int side) {
  ClassTable table;
  std::vector<Shape> shapes;
  for (ClassId c = 1; c < kClasses; ++c) {
    table.classes.push_back({c, "class", {}, true});
    table.instances.push_back({c, "tile", c});
  }
  for (int i = 0; i < side; i += kTile) {
    for (int j = 0; j < side; j += kTile) {
      Shape tile;
      tile.kind = ShapeKind::plane;
      tile.instance = class_at(i, j);
      tile.size = {kTile * kTileEdge_m / 2, kTile * kTileEdge_m / 2, 0};
      tile.T_world_shape.translation() << (i + kTile / 2) * kTileEdge_m,
          (j + kTile / 2) * kTileEdge_m, kTileEdge_m / 2;
      shapes.push_back(tile);
    }
  }
  return cube_distance(prepare(shapes, Pose::Identity()), table, kTileEdge_m);
}

Scene make_scene(int side) {
  RandomStream random(1, "score bench");
  std::vector<SurfaceVoxel> surface;
  std::vector<VisibleVoxel> visible;
  std::vector<std::vector<Eigen::Vector3d>> points(kClasses);
  Scene scene;
  for (int i = 0; i < side; ++i) {
    for (int j = 0; j < side; ++j) {
      const VoxelKey key{i, j, 0};
      const ClassId c = class_at(i, j);
      surface.push_back({key, c, false});
      const int lift = random.uniform() < 0.1 ? 1 + static_cast<int>(random.uniform() * 8) : 0;
      scene.map.push_back({{i, j, lift}, c, random.uniform(), true});
      if ((i / kTile + j / kTile) % 2 == 0) continue;
      visible.push_back({key, c, 8});
      for (int s = 0; s < 8; ++s) {
        const double x = random.uniform() * kTileEdge_m, y = random.uniform() * kTileEdge_m;
        points[c].push_back(low_corner_of(key, kTileEdge_m) +
                            Eigen::Vector3d(x, y, kTileEdge_m / 2));
      }
    }
  }
  scene.surface = SurfaceTruth(std::move(surface), kTileEdge_m);
  scene.visible = VisibleTruth(std::move(visible), kTileEdge_m);
  scene.samples = sample_set_of(points, kTileEdge_m);
  scene.distance_of = tile_distances(side);
  return scene;
}

void take_snapshot(benchmark::State& state) {
  const Scene scene = make_scene(static_cast<int>(state.range(0)));
  for (auto _ : state) benchmark::DoNotOptimize(MapSnapshot(scene.map));
  state.SetItemsProcessed(state.iterations() * static_cast<std::int64_t>(scene.map.size()));
}

void score_map(benchmark::State& state) {
  const Scene scene = make_scene(static_cast<int>(state.range(0)));
  const MapSnapshot map(scene.map);
  for (auto _ : state) {
    benchmark::DoNotOptimize(score_voxels(map, 0.25, scene.surface, scene.visible, kClasses));
  }
  state.SetItemsProcessed(state.iterations() * static_cast<std::int64_t>(scene.map.size()));
}

void score_map_distances(benchmark::State& state) {
  const Scene scene = make_scene(static_cast<int>(state.range(0)));
  const MapSnapshot map(scene.map);
  const ScoreOptions options;
  for (auto _ : state) {
    Counts counts = zero_counts(kClasses, options);
    score_distances(map, 0.25, scene.distance_of, scene.samples, options, counts,
                    static_cast<int>(state.range(1)));
    benchmark::DoNotOptimize(counts);
  }
  state.SetItemsProcessed(state.iterations() * static_cast<std::int64_t>(scene.map.size()));
}

void score_map_curves(benchmark::State& state) {
  const Scene scene = make_scene(static_cast<int>(state.range(0)));
  const MapSnapshot map(scene.map);
  for (auto _ : state) {
    benchmark::DoNotOptimize(curves_of(map, scene.surface, scene.visible, kClasses));
  }
  state.SetItemsProcessed(state.iterations() * static_cast<std::int64_t>(scene.map.size()));
}

/// All that `score` computes of a map from its voxels on: snapshot, voxels, distances, curves.
void score_map_in_full(benchmark::State& state) {
  const Scene scene = make_scene(static_cast<int>(state.range(0)));
  const int jobs = static_cast<int>(state.range(1));
  const ScoreOptions options;
  double peak_MiB = 0.0;
  for (auto _ : state) {
    state.PauseTiming();
    const bench::PeakMemory memory;
    state.ResumeTiming();
    const MapSnapshot map(scene.map);
    Counts counts = score_voxels(map, 0.25, scene.surface, scene.visible, kClasses, options);
    score_distances(map, 0.25, scene.distance_of, scene.samples, options, counts, jobs);
    benchmark::DoNotOptimize(counts);
    benchmark::DoNotOptimize(curves_of(map, scene.surface, scene.visible, kClasses));
    peak_MiB = std::max(peak_MiB, memory.peak_MiB());
  }
  state.counters["voxels"] = static_cast<double>(scene.map.size());
  state.counters["peak_MiB"] = peak_MiB;
  state.counters["bar_ms"] = 1000;
}

// 200^2: the voxels of a furnished room at 5 cm; 1000^2: a map of a million voxels.
BENCHMARK(take_snapshot)->Arg(200)->Arg(1000)->Unit(benchmark::kMillisecond);
BENCHMARK(score_map)->Arg(200)->Arg(1000)->Unit(benchmark::kMillisecond);
BENCHMARK(score_map_distances)
    ->ArgNames({"side", "jobs"})
    ->Args({200, 1})
    ->Args({1000, 1})
    ->Args({1000, 2})
    ->Unit(benchmark::kMillisecond)
    ->UseRealTime();
BENCHMARK(score_map_curves)->Arg(200)->Arg(1000)->Unit(benchmark::kMillisecond);
BENCHMARK(score_map_in_full)
    ->ArgNames({"side", "jobs"})
    ->Args({1000, 1})
    ->Args({1000, 2})
    ->Unit(benchmark::kMillisecond)
    ->UseRealTime();

}  // namespace
