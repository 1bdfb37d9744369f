// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#include "core/segmentation/detection.hpp"
#include "core/segmentation/growing/region_growing.hpp"
#include "core/segmentation/registered_cloud.hpp"
#include "core/segmentation/segmentation.hpp"
#include "synthetic_person.hpp"

#include <benchmark/benchmark.h>
#include <nanoflann.hpp>

#include <algorithm>
#include <ctime>
#include <limits>
#include <map>
#include <vector>

namespace {

using namespace mapscore;
using mapscore::testing::person;

/// The one detection, its cloud, its points, and the point that growing starts from.
struct DetectedPerson {
  std::vector<Detection> detections = detections_of(person().label, person().table);
  RegisteredCloud cloud = register_depth(person().depth, person().calibration);
  std::vector<Eigen::Vector3d> points =
      segment(detections.front(), cloud, 0.05, Direct{}, false).points;
  Eigen::Vector3d seed = seed_point();

 private:
  [[nodiscard]] Eigen::Vector3d seed_point() const {
    const PixelBox& box = detections.front().box;
    return cloud.point(cloud.source((box.u_min + box.u_max) / 2, (box.v_min + box.v_max) / 2));
  }
};

const DetectedPerson& detected() {
  static const DetectedPerson kDetected;
  return kDetected;
}

double edge_m(const benchmark::State& state) {
  return 0.01 * static_cast<double>(state.range(0));
}

void detect(benchmark::State& state) {
  for (auto _ : state) benchmark::DoNotOptimize(detections_of(person().label, person().table));
}
BENCHMARK(detect)->Unit(benchmark::kMillisecond);

void register_full(benchmark::State& state) {
  for (auto _ : state)
    benchmark::DoNotOptimize(register_depth(person().depth, person().calibration));
  state.counters["bar_ms"] = 2.0;
}
BENCHMARK(register_full)->Unit(benchmark::kMillisecond);

void register_full_rotated(benchmark::State& state) {
  Calibration believed = person().calibration;
  believed.T_color_depth.linear() = exp_rotation({0.004, -0.003, 0.002});
  for (auto _ : state) benchmark::DoNotOptimize(register_depth(person().depth, believed));
  state.counters["bar_ms"] = 2.0;
}
BENCHMARK(register_full_rotated)->Unit(benchmark::kMillisecond);

void register_masked(benchmark::State& state) {
  const cv::Mat1b wanted = pixels_wanted(detected().detections, 640, 480);
  for (auto _ : state)
    benchmark::DoNotOptimize(register_depth(person().depth, person().calibration, wanted));
}
BENCHMARK(register_masked)->Unit(benchmark::kMillisecond);

void run_segment(benchmark::State& state, const ByDetection auto& params, bool with_voxels) {
  const DetectedPerson& scene = detected();
  const double voxel_m = edge_m(state);
  for (auto _ : state)
    benchmark::DoNotOptimize(
        segment(scene.detections.front(), scene.cloud, voxel_m, params, with_voxels));
  state.counters["points"] = static_cast<double>(scene.points.size());
}

void segment_direct(benchmark::State& state) {
  run_segment(state, Direct{}, false);
  state.counters["bar_ms"] = 1.0;
}
BENCHMARK(segment_direct)->Arg(5)->Unit(benchmark::kMillisecond);

void segment_direct_voxels(benchmark::State& state) {
  run_segment(state, Direct{}, true);
}
BENCHMARK(segment_direct_voxels)->Arg(5)->Arg(1)->Unit(benchmark::kMillisecond);

void segment_erosion(benchmark::State& state) {
  run_segment(state, Erosion{}, false);
  state.counters["bar_ms"] = 1.0;
}
BENCHMARK(segment_erosion)->Arg(5)->Unit(benchmark::kMillisecond);

void segment_growing(benchmark::State& state) {
  run_segment(state, RegionGrowing{}, false);
}
BENCHMARK(segment_growing)->Arg(5)->Arg(1)->Unit(benchmark::kMillisecond);

double processor_s() {
  return static_cast<double>(std::clock()) / CLOCKS_PER_SEC;
}

/// Least processor time of a few runs, which other programs disturb least.
template <class Work>
double least_s(int runs, const Work& work) {
  double least = std::numeric_limits<double>::infinity();
  for (int run = 0; run < runs; ++run) {
    const double start = processor_s();
    work();
    least = std::min(least, processor_s() - start);
  }
  return least;
}

/// nanoflann's view of the points, and the time that its tree takes to build: the measure of this
/// machine against the one where the released implementation was timed.
struct TreePoints {
  const std::vector<Eigen::Vector3d>& points;
  [[nodiscard]] std::size_t kdtree_get_point_count() const { return points.size(); }
  [[nodiscard]] double kdtree_get_pt(std::size_t i, std::size_t axis) const {
    return points[i][static_cast<Eigen::Index>(axis)];
  }
  template <class Box>
  bool kdtree_get_bbox(Box&) const {
    return false;
  }
};

double tree_build_s() {
  using Tree = nanoflann::KDTreeSingleIndexAdaptor<nanoflann::L2_Simple_Adaptor<double, TreePoints>,
                                                   TreePoints, 3>;
  const TreePoints points{detected().points};
  return least_s(5, [&] {
    Tree tree(3, points, nanoflann::KDTreeSingleIndexAdaptorParams(10));
    tree.buildIndex();
  });
}

/// What is asked of region growing at a voxel edge, and the released implementation's time, of
/// which 8 ms were its KD-tree's.
struct GrowingBar {
  double released_ms, bar_ms, bar_speedup;
};
const std::map<long, GrowingBar> kGrowingBars{{10, {14.0, 0.0, 0.0}},
                                              {5, {22.9, 0.6, 25.0}},
                                              {2, {77.8, 0.9, 60.0}},
                                              {1, {241.0, 1.5, 120.0}}};
constexpr double kReleasedTree_ms = 8.0;

/// Region growing by itself, fast form; `speedup` is the plain form's least time of 3 runs over the
/// fast form's of 50, in the same process. The plain form must stay below `plain_limit_ms`, the
/// released implementation's time scaled by how long the KD-tree takes here; `speedup_released` is
/// that limit over the fast form's time. Arguments: voxel edge in cm, radius factor in percent,
/// released.
void grow(benchmark::State& state) {
  const DetectedPerson& scene = detected();
  const double factor = 0.01 * static_cast<double>(state.range(1));
  const bool released = state.range(2) != 0;
  Region plain, fast;
  const double plain_s = least_s(3, [&] {
    plain = grow_region_reference(scene.points, scene.seed, edge_m(state), factor, released);
  });
  for (auto _ : state)
    fast = grow_region(scene.points, scene.seed, edge_m(state), factor, released);
  const double fast_s = least_s(
      50, [&] { fast = grow_region(scene.points, scene.seed, edge_m(state), factor, released); });
  if (fast.positions != plain.positions || fast.points != plain.points)
    state.SkipWithError("fast and plain form differ");
  const GrowingBar& bar = kGrowingBars.at(state.range(0));
  const double limit_ms = bar.released_ms * 1e3 * tree_build_s() / kReleasedTree_ms;
  state.counters["voxels"] = static_cast<double>(fast.positions.size());
  state.counters["fast_ms"] = 1e3 * fast_s;
  state.counters["bar_ms"] = bar.bar_ms;
  state.counters["plain_ms"] = 1e3 * plain_s;
  state.counters["plain_limit_ms"] = limit_ms;
  state.counters["speedup"] = plain_s / fast_s;
  state.counters["speedup_released"] = 1e-3 * limit_ms / fast_s;
  state.counters["bar_speedup"] = bar.bar_speedup;
}
BENCHMARK(grow)
    ->ArgNames({"voxel_cm", "factor_percent", "released"})
    ->ArgsProduct({{10, 5, 2, 1}, {50, 100}, {0, 1}})
    ->Unit(benchmark::kMillisecond);

}  // namespace
