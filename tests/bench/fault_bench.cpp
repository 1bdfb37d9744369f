// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#include "sim/faults/depth_noise.hpp"
#include "sim/faults/label_noise.hpp"
#include "synthetic_person.hpp"

#include <benchmark/benchmark.h>

namespace {

using namespace mapscore;
using mapscore::testing::person;

/// A frame of 640 x 480.
void corrupt_depth(benchmark::State& state, const sim::DepthDose& dose) {
  int frame = 0;
  for (auto _ : state)
    benchmark::DoNotOptimize(
        sim::corrupt_depth(person().depth, person().calibration.depth, dose, 1, frame++));
}
BENCHMARK_CAPTURE(corrupt_depth, astra, sim::DepthDose::of(sim::DepthPreset::astra))
    ->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(corrupt_depth, axial, {.axial = 1})->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(corrupt_depth, lateral, {.lateral = 1})->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(corrupt_depth, shadow, {.shadow = 1})->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(corrupt_depth, quantisation, {.quantisation = 1})->Unit(benchmark::kMillisecond);

/// One person of 54 thousand pixels.
void corrupt_labels(benchmark::State& state, const sim::LabelDose& dose) {
  int frame = 0;
  for (auto _ : state)
    benchmark::DoNotOptimize(
        sim::corrupt_detections(person().label, person().table, dose, 1, frame++));
}
BENCHMARK_CAPTURE(corrupt_labels, typical, sim::LabelDose::of(sim::LabelPreset::typical))
    ->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(corrupt_labels, boundary, {.boundary_px = 3})->Unit(benchmark::kMillisecond);

}  // namespace
