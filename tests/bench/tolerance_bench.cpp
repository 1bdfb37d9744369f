// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

// Coverage and width of the interval of a tolerance on known curves (docs/tolerance.md):
//   mapscore_bench --benchmark_filter=Tolerance
#include "tests/eval/statistics/known_curves.hpp"

#include <benchmark/benchmark.h>

namespace mapscore::eval {
namespace {

void ToleranceCoverage(benchmark::State& state) {
  const KnownCurve curve = known_curves().at(static_cast<std::size_t>(state.range(0)));
  const auto noise = static_cast<Noise>(state.range(1));
  Coverage coverage;
  for (auto _ : state) coverage = coverage_of(curve, noise, 1000, static_cast<int>(state.range(2)));
  state.SetLabel(std::string(curve.name) + ", " + std::string(names_of(noise)[state.range(1)]));
  state.counters["coverage"] = coverage.share;
  state.counters["half_width"] = coverage.half_width;
  state.counters["both_ends"] = coverage.both_ends;
  state.counters["not_monotone"] = coverage.not_monotone;
  state.counters["trials"] = coverage.trials;
}
BENCHMARK(ToleranceCoverage)
    ->ArgNames({"curve", "noise", "trials"})
    ->ArgsProduct({benchmark::CreateDenseRange(0, 14, 1), {0, 1, 2, 3}, {42}})
    ->Iterations(1)
    ->Unit(benchmark::kMillisecond);

void ToleranceDifference(benchmark::State& state) {
  const std::vector<KnownCurve> curves = known_curves();
  const KnownCurve& a = curves.at(static_cast<std::size_t>(state.range(0)));
  const KnownCurve& b = curves.at(static_cast<std::size_t>(state.range(1)));
  PairCoverage coverage;
  for (auto _ : state)
    coverage = coverage_of_pairs(a, b, static_cast<double>(state.range(2)) / 100.0, 1000);
  state.SetLabel(std::string(a.name) + " less " + b.name);
  state.counters["coverage"] = coverage.share;
  state.counters["half_width"] = coverage.half_width;
  state.counters["if_unpaired"] = coverage.if_unpaired;
}
BENCHMARK(ToleranceDifference)
    ->ArgNames({"a", "b", "common_percent"})
    ->ArgsProduct({{0}, {1}, {0, 50, 90}})
    ->ArgsProduct({{2}, {2, 3}, {0, 50, 90}})
    ->ArgsProduct({{8, 9}, {2}, {0, 50, 90}})
    ->ArgsProduct({{4}, {1}, {0, 50, 90}})
    ->Iterations(1)
    ->Unit(benchmark::kMillisecond);

}  // namespace
}  // namespace mapscore::eval
