// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#include "core/segmentation/rivals/geometric_segments.hpp"
#include "core/segmentation/segmentation.hpp"
#include "synthetic_person.hpp"

#include <benchmark/benchmark.h>

namespace {

using namespace mapscore;
using mapscore::testing::person;

constexpr double kRivalBar_ms = 15.0;

/// One frame of 640 x 480, registration and all; `bar_ms` is what a frame may take. `whole`: one
/// mask over the whole image instead of the person's, the most that there can be.
void rival_frame(benchmark::State& state, const Segmentation& kind, bool whole) {
  cv::setNumThreads(1);  // processor time of one core
  const cv::Mat1w label = whole ? cv::Mat1w(480, 640, std::uint16_t{1}) : person().label;
  const std::vector<Detection> detections = detections_of(label, person().table);
  for (auto _ : state)
    benchmark::DoNotOptimize(
        segment(Sight(person().calibration, person().depth, detections), kind, 0.05, false));
  state.counters["bar_ms"] = kRivalBar_ms;
}
BENCHMARK_CAPTURE(rival_frame, direct, Direct{}, false)->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(rival_frame, largest_component, LargestComponent{}, false)
    ->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(rival_frame, dbscan, Dbscan{}, false)->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(rival_frame, covers, DepthSegments{}, false)->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(rival_frame, votes, DepthSegments{.rule = SegmentRule::votes}, false)
    ->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(rival_frame, direct_whole, Direct{}, true)->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(rival_frame, largest_component_whole, LargestComponent{}, true)
    ->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(rival_frame, dbscan_whole, Dbscan{}, true)->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(rival_frame, covers_whole, DepthSegments{}, true)->Unit(benchmark::kMillisecond);

void rival_normals(benchmark::State& state) {
  const cv::Mat1f depth_m = depth_in_range(person().depth, person().calibration);
  for (auto _ : state)
    benchmark::DoNotOptimize(surface_normals(depth_m, person().calibration.depth, 5));
}
BENCHMARK(rival_normals)->Unit(benchmark::kMillisecond);

void rival_edges(benchmark::State& state) {
  const VectorImage points =
      points_of(depth_in_range(person().depth, person().calibration), person().calibration.depth);
  for (auto _ : state)
    benchmark::DoNotOptimize(geometric_edges(points, person().calibration.depth, {}));
}
BENCHMARK(rival_edges)->Unit(benchmark::kMillisecond);

void rival_segments(benchmark::State& state) {
  const cv::Mat1f depth_m = depth_in_range(person().depth, person().calibration);
  for (auto _ : state)
    benchmark::DoNotOptimize(geometric_segments(depth_m, person().calibration.depth, {}));
}
BENCHMARK(rival_segments)->Unit(benchmark::kMillisecond);

}  // namespace
