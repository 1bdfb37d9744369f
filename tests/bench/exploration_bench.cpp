// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

// One decision of a planner in a home of 10 m x 8 m at 5 cm, after a number of views: processor
// time (bar: 200 ms) and its share for known space, floor and ways.

#include "core/exploration/exploration.hpp"
#include "core/exploration/surroundings.hpp"
#include "tests/core/exploration/flat_run.hpp"

#include <benchmark/benchmark.h>

namespace mapscore::testing {
namespace {

/// Explores with next best view for so many views, and holds the state before the next one.
FlatRun& run_after(const BoxFlat& flat, int views) {
  static std::map<int, std::unique_ptr<FlatRun>> runs;
  std::unique_ptr<FlatRun>& run = runs[views];
  if (!run) {
    run = std::make_unique<FlatRun>(flat, PlanarPose{2.8, 3.2, 0.0}, 1.0);
    run->explore(*make_explorer(NextBestView{}, flat_robot(), 1), views);
  }
  return *run;
}

const BoxFlat& home() {
  static const BoxFlat flat = five_rooms();
  return flat;
}

void decide(benchmark::State& state, const Exploration& planner) {
  const ExplorationState known = run_after(home(), static_cast<int>(state.range(0))).state();
  const auto explorer = make_explorer(planner, flat_robot(), 1);
  benchmark::DoNotOptimize(explorer->next(known));
  for (auto _ : state) benchmark::DoNotOptimize(explorer->next(known));
}

void NextBestViewStep(benchmark::State& state) {
  decide(state, NextBestView{});
}
void NearestFrontierStep(benchmark::State& state) {
  decide(state, NearestFrontier{});
}
void SurroundingsStep(benchmark::State& state) {
  const ExplorationState known = run_after(home(), static_cast<int>(state.range(0))).state();
  for (auto _ : state) {
    const Surroundings now(known, flat_robot(), 0.6);
    benchmark::DoNotOptimize(now.paths.reached().size());
  }
}

BENCHMARK(NextBestViewStep)->Arg(5)->Arg(15)->Arg(30)->Unit(benchmark::kMillisecond);
BENCHMARK(NearestFrontierStep)->Arg(15)->Unit(benchmark::kMillisecond);
BENCHMARK(SurroundingsStep)->Arg(15)->Unit(benchmark::kMillisecond);

}  // namespace
}  // namespace mapscore::testing
