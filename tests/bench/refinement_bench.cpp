// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#include "core/refinement/dense_crf.hpp"
#include "tests/core/refinement/plain_crf.hpp"

#include <benchmark/benchmark.h>

namespace {

using namespace mapscore;

/// Mean-field inference of ten iterations on two noisy walls. Arguments: filter (0 neighbours, 1
/// lattice), voxels on a side, labels, sigmas in percent of the defaults.
void refine_walls(benchmark::State& state) {
  Crf params;
  params.filter = state.range(0) == 0 ? CrfFilter::neighbours : CrfFilter::lattice;
  params.tolerance = 0;
  params.smoothness_sigma_m *= 0.01 * static_cast<double>(state.range(3));
  params.appearance_sigma_m *= 0.01 * static_cast<double>(state.range(3));
  const CrfVoxels voxels = testing::noisy_corner(static_cast<int>(state.range(1)),
                                                 static_cast<int>(state.range(2)), 0.2);
  for (auto _ : state) benchmark::DoNotOptimize(refine(voxels, params, 1));
  state.counters["voxels"] = static_cast<double>(voxels.keys.size());
}
BENCHMARK(refine_walls)
    ->ArgNames({"lattice", "side", "labels", "sigma_percent"})
    ->ArgsProduct({{0, 1}, {100}, {5, 20}, {100, 200, 400}})
    ->Unit(benchmark::kMillisecond)
    ->Iterations(1);

/// Agreement with mean field over all pairs in doubles: largest and mean difference of a
/// probability, and the share of voxels whose best label differs.
void refine_against_all_pairs(benchmark::State& state) {
  Crf params;
  params.filter = state.range(0) == 0 ? CrfFilter::neighbours : CrfFilter::lattice;
  params.smoothness_sigma_m *= 0.01 * static_cast<double>(state.range(1));
  params.appearance_sigma_m *= 0.01 * static_cast<double>(state.range(1));
  const CrfVoxels voxels = testing::noisy_corner(30, 5, 0.3);
  const Eigen::MatrixXd plain = testing::plain_refine(voxels, params, 1e9);
  CrfResult result;
  for (auto _ : state) result = refine(voxels, params, 1);
  const Eigen::MatrixXd difference = (result.probability.cast<double>() - plain).cwiseAbs();
  int other = 0;
  for (Eigen::Index i = 0; i < plain.cols(); ++i) {
    Eigen::Index of_plain = 0, of_result = 0;
    plain.col(i).maxCoeff(&of_plain);
    result.probability.col(i).maxCoeff(&of_result);
    other += of_plain != of_result ? 1 : 0;
  }
  state.counters["largest"] = difference.maxCoeff();
  state.counters["mean"] = difference.mean();
  state.counters["other_label_percent"] = 100.0 * other / static_cast<double>(plain.cols());
}
BENCHMARK(refine_against_all_pairs)
    ->ArgNames({"lattice", "sigma_percent"})
    ->ArgsProduct({{0, 1}, {50, 100, 200}})
    ->Unit(benchmark::kMillisecond)
    ->Iterations(1);

}  // namespace
