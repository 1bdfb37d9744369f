// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#include "core/segmentation/edge_aligned/depth_edges.hpp"
#include "core/segmentation/edge_aligned/edge_aligned.hpp"
#include "core/segmentation/edge_aligned/outline_alignment.hpp"
#include "core/segmentation/edge_aligned/outline_field.hpp"
#include "synthetic_person.hpp"

#include <benchmark/benchmark.h>

namespace {

using namespace mapscore;
using mapscore::testing::person;

constexpr double kFrameBar_ms = 10.0;

/// Labels 20 mm off: the search has something to find.
Calibration misregistered() {
  Calibration believed = person().calibration;
  believed.T_color_depth.translation().x() += 0.02;
  return believed;
}

/// One frame of 640 x 480, everything; `bar_ms` is what a frame may take.
void edge_aligned_frame(benchmark::State& state) {
  const std::vector<Detection> detections = detections_of(person().label, person().table);
  const Calibration believed = misregistered();
  for (auto _ : state)
    benchmark::DoNotOptimize(
        label_surfaces(Sight(believed, person().depth, detections), {}).labels);
  state.counters["bar_ms"] = kFrameBar_ms;
}
BENCHMARK(edge_aligned_frame)->Unit(benchmark::kMillisecond);

void edge_aligned_edges(benchmark::State& state) {
  const Calibration believed = misregistered();
  for (auto _ : state) benchmark::DoNotOptimize(find_depth_edges(person().depth, believed));
}
BENCHMARK(edge_aligned_edges)->Unit(benchmark::kMillisecond);

void edge_aligned_field(benchmark::State& state) {
  const std::vector<Detection> detections = detections_of(person().label, person().table);
  for (auto _ : state) benchmark::DoNotOptimize(outline_field(detections, 640, 480, 68));
}
BENCHMARK(edge_aligned_field)->Unit(benchmark::kMillisecond);

void edge_aligned_alignment(benchmark::State& state) {
  const Calibration believed = misregistered();
  const std::vector<Detection> detections = detections_of(person().label, person().table);
  const DepthEdges edges = find_depth_edges(person().depth, believed);
  const OutlineField field = outline_field(detections, 640, 480, 68);
  for (auto _ : state) benchmark::DoNotOptimize(align_outlines(edges, field, believed, 40));
}
BENCHMARK(edge_aligned_alignment)->Unit(benchmark::kMillisecond);

}  // namespace
