// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#include "core/segmentation/edge_aligned/depth_edges.hpp"
#include "core/segmentation/edge_aligned/edge_aligned.hpp"
#include "core/segmentation/edge_aligned/outline_alignment.hpp"
#include "core/segmentation/edge_aligned/outline_field.hpp"
#include "core/segmentation/edge_aligned/settled_depth.hpp"
#include "core/segmentation/edge_aligned/surface_creases.hpp"
#include "core/segmentation/edge_aligned/surface_vote.hpp"
#include "sim/faults/depth_noise.hpp"
#include "sim/faults/label_noise.hpp"
#include "synthetic_person.hpp"
#include "tests/core/segmentation/edge_aligned/plain_edge_aligned.hpp"

#include <benchmark/benchmark.h>

#include <ctime>

namespace {

using namespace mapscore;
using mapscore::testing::person;

constexpr double kFrameBar_ms = 8.0, kNoisyFrameBar_ms = 25.0;

/// One frame of 640 x 480 whose labels lie 20 mm off: the search has something to find.
struct BenchFrame {
  Calibration believed = person().calibration;
  cv::Mat1w depth = person().depth;
  std::vector<Detection> detections = detections_of(person().label, person().table);

  explicit BenchFrame(bool noisy) {
    believed.T_color_depth.translation().x() += 0.02;
    if (!noisy) return;
    depth = sim::corrupt_depth(depth, believed.depth, sim::DepthDose::of(sim::DepthPreset::astra),
                               1, 0);
    detections = sim::corrupt_detections(person().label, person().table,
                                         sim::LabelDose::of(sim::LabelPreset::typical), 1, 0);
  }
};

/// The steps of a frame.
struct BenchSteps : BenchFrame {
  DepthEdges edges = find_depth_edges(depth, believed);
  OutlineField field = outline_field(detections, 640, 480, 68);
  MaskField masks = open_grooves(outline_field(detections, 640, 480, 68));
  OutlineAlignment alignment;
  OutlineShifts shifts;

  /// Nothing mended, so that shifts are sought everywhere.
  explicit BenchSteps(bool noisy) : BenchFrame(noisy) {
    alignment.score = alignment.sharpness = 0.5F;
    shifts = find_outline_shifts(edges, field, alignment, believed);
  }
  [[nodiscard]] cv::Mat1w votes() const {
    Continuity on = is_noisy(edges) ? Continuity{edges.right.clone(), edges.down.clone()}
                                    : part_at_creases(edges);
    return vote_on_surfaces(edges, masks, alignment, shifts, believed, detections.size(), on, 3.0);
  }
};

/// Everything; `bar_ms` is what a frame may take.
void edge_aligned_frame(benchmark::State& state, bool noisy, OutlineFit fit) {
  const BenchFrame frame(noisy);
  const Sight sight(frame.believed, frame.depth, frame.detections);
  for (auto _ : state) benchmark::DoNotOptimize(label_surfaces(sight, {.fit = fit}).labels);
  state.counters["bar_ms"] = noisy ? kNoisyFrameBar_ms : kFrameBar_ms;
}
BENCHMARK_CAPTURE(edge_aligned_frame, exact, false, OutlineFit::calibration)
    ->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(edge_aligned_frame, exact_known, false, OutlineFit::masks)
    ->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(edge_aligned_frame, noisy, true, OutlineFit::calibration)
    ->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(edge_aligned_frame, noisy_known, true, OutlineFit::masks)
    ->Unit(benchmark::kMillisecond);

void edge_aligned_field(benchmark::State& state) {
  const BenchFrame frame(false);
  for (auto _ : state) benchmark::DoNotOptimize(outline_field(frame.detections, 640, 480, 68));
}
BENCHMARK(edge_aligned_field)->Unit(benchmark::kMillisecond);

void edge_aligned_alignment(benchmark::State& state) {
  const BenchSteps steps(false);
  for (auto _ : state)
    benchmark::DoNotOptimize(align_outlines(steps.edges, steps.field, steps.believed, 40));
}
BENCHMARK(edge_aligned_alignment)->Unit(benchmark::kMillisecond);

double processor_ms() {
  timespec now{};
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &now);
  return 1e3 * static_cast<double>(now.tv_sec) + 1e-6 * static_cast<double>(now.tv_nsec);
}

/// A step of the core and its plain twin in turns: processor time of each, and their ratio.
void beside_plain(benchmark::State& state, const auto& fast, const auto& plain) {
  double fast_ms = 0, plain_ms = 0;
  for (auto _ : state) {
    const double start = processor_ms();
    benchmark::DoNotOptimize(fast());
    const double middle = processor_ms();
    benchmark::DoNotOptimize(plain());
    fast_ms += middle - start, plain_ms += processor_ms() - middle;
  }
  const auto rounds = static_cast<double>(state.iterations());
  state.counters["fast_ms"] = fast_ms / rounds;
  state.counters["plain_ms"] = plain_ms / rounds;
  state.counters["ratio"] = plain_ms / fast_ms;
}

/// The plain one is given what both share: the inverse depth, its noise and its holes.
void edge_aligned_edges(benchmark::State& state) {
  const BenchSteps steps(true);
  beside_plain(
      state, [&] { return find_depth_edges(steps.depth, steps.believed); },
      [&] { return mapscore::testing::plain_steps(steps.edges, steps.believed); });
}
BENCHMARK(edge_aligned_edges)->Unit(benchmark::kMillisecond);

void edge_aligned_shifts(benchmark::State& state) {
  const BenchSteps steps(true);
  beside_plain(
      state,
      [&] {
        return find_outline_shifts(steps.edges, steps.field, steps.alignment, steps.believed);
      },
      [&] {
        return mapscore::testing::plain_shifts(steps.edges, steps.field, steps.alignment,
                                               steps.believed);
      });
}
BENCHMARK(edge_aligned_shifts)->Unit(benchmark::kMillisecond);

void edge_aligned_creases(benchmark::State& state) {
  const BenchSteps steps(false);
  beside_plain(
      state, [&] { return part_at_creases(steps.edges).down; },
      [&] { return mapscore::testing::plain_creases(steps.edges).down; });
}
BENCHMARK(edge_aligned_creases)->Unit(benchmark::kMillisecond);

void edge_aligned_votes(benchmark::State& state) {
  const BenchSteps steps(false);
  beside_plain(
      state, [&] { return steps.votes(); },
      [&] {
        return mapscore::testing::plain_surface_votes(steps.edges, steps.masks, steps.alignment,
                                                      steps.shifts, steps.believed,
                                                      steps.detections.size(), 3.0F);
      });
}
BENCHMARK(edge_aligned_votes)->Unit(benchmark::kMillisecond);

void edge_aligned_settle(benchmark::State& state) {
  const BenchSteps steps(true);
  const cv::Mat1w votes = steps.votes();
  const auto settled = [&](auto&& settle) {
    cv::Mat1w labels = votes.clone();
    return settle(steps.edges, labels);
  };
  beside_plain(
      state, [&] { return settled(settle_on_surfaces); },
      [&] { return settled(mapscore::testing::settle_plainly); });
}
BENCHMARK(edge_aligned_settle)->Unit(benchmark::kMillisecond);

}  // namespace
