// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#include "core/segmentation/detection.hpp"
#include "core/segmentation/region_growing.hpp"
#include "core/segmentation/registered_cloud.hpp"
#include "core/segmentation/segmentation.hpp"
#include "synthetic_person.hpp"

#include <benchmark/benchmark.h>

#include <ctime>
#include <vector>

namespace {

using namespace mapscore;

const testing::SyntheticPerson& person() {
  static const testing::SyntheticPerson kPerson = testing::synthetic_person();
  return kPerson;
}

/// The one detection, its cloud, its points, and the point that growing starts from.
struct DetectedPerson {
  std::vector<Detection> detections = detections_of(person().label, person().table);
  RegisteredCloud cloud = register_depth(person().depth, person().calibration);
  std::vector<Eigen::Vector3d> points =
      segment(detections.front(), cloud, 0.05, DirectParams{}, false).points;
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
}
BENCHMARK(register_full)->Unit(benchmark::kMillisecond);

void register_full_rotated(benchmark::State& state) {
  Calibration believed = person().calibration;
  believed.T_color_depth.linear() = exp_rotation({0.004, -0.003, 0.002});
  for (auto _ : state) benchmark::DoNotOptimize(register_depth(person().depth, believed));
}
BENCHMARK(register_full_rotated)->Unit(benchmark::kMillisecond);

void register_masked(benchmark::State& state) {
  const cv::Mat1b wanted = pixels_wanted(detected().detections, 640, 480);
  for (auto _ : state)
    benchmark::DoNotOptimize(register_depth(person().depth, person().calibration, wanted));
}
BENCHMARK(register_masked)->Unit(benchmark::kMillisecond);

void run_segment(benchmark::State& state, const SegmentationParams& params, bool with_voxels) {
  const DetectedPerson& scene = detected();
  const double voxel_m = edge_m(state);
  for (auto _ : state)
    benchmark::DoNotOptimize(
        segment(scene.detections.front(), scene.cloud, voxel_m, params, with_voxels));
  state.counters["points"] = static_cast<double>(scene.points.size());
}

void segment_direct(benchmark::State& state) {
  run_segment(state, DirectParams{}, false);
}
BENCHMARK(segment_direct)->Arg(5)->Unit(benchmark::kMillisecond);

void segment_direct_voxels(benchmark::State& state) {
  run_segment(state, DirectParams{}, true);
}
BENCHMARK(segment_direct_voxels)->Arg(5)->Arg(1)->Unit(benchmark::kMillisecond);

void segment_erosion(benchmark::State& state) {
  run_segment(state, ErosionParams{}, false);
}
BENCHMARK(segment_erosion)->Arg(5)->Unit(benchmark::kMillisecond);

void segment_growing(benchmark::State& state) {
  run_segment(state, RegionGrowingParams{}, false);
}
BENCHMARK(segment_growing)->Arg(5)->Arg(1)->Unit(benchmark::kMillisecond);

/// Region growing by itself, fast form; `speedup` is one run of the reference over the mean of the
/// fast form, in processor time. Arguments: voxel edge in cm, radius factor in percent, released.
void grow(benchmark::State& state) {
  const DetectedPerson& scene = detected();
  const double factor = 0.01 * static_cast<double>(state.range(1));
  const bool released = state.range(2) != 0;
  const std::clock_t start = std::clock();
  const Region plain =
      grow_region_reference(scene.points, scene.seed, edge_m(state), factor, released);
  const double reference_s = static_cast<double>(std::clock() - start) / CLOCKS_PER_SEC;
  Region fast;
  const std::clock_t fast_start = std::clock();
  for (auto _ : state)
    fast = grow_region(scene.points, scene.seed, edge_m(state), factor, released);
  const double fast_s = static_cast<double>(std::clock() - fast_start) / CLOCKS_PER_SEC /
                        static_cast<double>(state.iterations());
  if (fast.positions != plain.positions || fast.points != plain.points)
    state.SkipWithError("fast and reference form differ");
  state.counters["voxels"] = static_cast<double>(fast.positions.size());
  state.counters["reference_ms"] = 1e3 * reference_s;
  state.counters["speedup"] = reference_s / fast_s;
}
BENCHMARK(grow)
    ->ArgNames({"voxel_cm", "factor_percent", "released"})
    ->ArgsProduct({{10, 5, 2, 1}, {50, 100}, {0, 1}})
    ->Unit(benchmark::kMillisecond);

}  // namespace
