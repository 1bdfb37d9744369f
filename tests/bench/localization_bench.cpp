// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#include "core/localization/occupancy_grid.hpp"
#include "core/localization/particle_filter.hpp"

#include <benchmark/benchmark.h>

#include <limits>
#include <memory>
#include <numbers>
#include <utility>

// Particle filter in a synthetic home of 10 m x 7 m at 5 cm: four rooms and their furniture.
// Counter `bar_ms` is the most that a step may take on one thread.

namespace {

using namespace mapscore;

void fill(OccupancyGrid& grid, GridCell low, GridCell high) {
  for (GridCell cell = low; cell.row <= high.row; ++cell.row)
    for (cell.column = low.column; cell.column <= high.column; ++cell.column)
      grid.set(cell, kOccupiedCell);
}

OccupancyGrid home_grid() {
  OccupancyGrid grid({0.05, {}, 200, 140}, kFreeCell);
  fill(grid, {0, 0}, {199, 1});
  fill(grid, {0, 138}, {199, 139});
  fill(grid, {0, 0}, {1, 139});
  fill(grid, {198, 0}, {199, 139});
  fill(grid, {80, 0}, {81, 40});
  fill(grid, {80, 60}, {81, 139});
  fill(grid, {82, 80}, {110, 81});
  fill(grid, {130, 80}, {199, 81});
  for (int n = 0; n < 12; ++n)
    fill(grid, {10 + 15 * n, 10 + 37 * n % 100}, {16 + 15 * n, 18 + 37 * n % 100});
  return grid;
}

LaserScan scan_at(const OccupancyGrid& grid, const PlanarPose& pose) {
  LaserScan scan;
  scan.first_angle_rad = -std::numbers::pi;
  scan.angle_step_rad = std::numbers::pi / 180.0;
  for (int n = 0; n < 360; ++n) {
    const double angle = pose.yaw_rad + scan.first_angle_rad + n * scan.angle_step_rad;
    const auto range = cast_ray(grid, {pose.x_m, pose.y_m}, angle, scan.range_max_m);
    scan.ranges_m.push_back(
        static_cast<float>(range.value_or(std::numeric_limits<double>::infinity())));
  }
  return scan;
}

/// Steps of 6 cm on the spot of one scan: the time does not depend on where the particles are.
void run_filter(benchmark::State& state, ScanModel model) {
  const OccupancyGrid grid = home_grid();
  const PlanarPose start{3.0, 2.5, 0.4};
  const LaserScan scan = scan_at(grid, start);
  ParticleFilterParams params;
  params.kld.min_particles = params.kld.max_particles = static_cast<std::size_t>(state.range(0));
  ParticleFilter filter(std::make_shared<const ScanModel>(std::move(model)), params, 1);
  PoseEstimate estimate{start, Eigen::Matrix3d::Identity() * 0.01};
  filter.start_at(estimate);
  double x_m = 0.0;
  for (auto _ : state) {
    x_m = x_m > 0.0 ? 0.0 : 0.06;
    benchmark::DoNotOptimize(filter.step({x_m, 0.0, 0.0}, scan));
  }
  state.counters["bar_ms"] = 10.0;
}

void filter_step_field(benchmark::State& state) {
  run_filter(state, LikelihoodField(home_grid(), {}, 12.0));
}
BENCHMARK(filter_step_field)->Arg(500)->Arg(5000)->Unit(benchmark::kMillisecond);

/// Particles, beams of the 360 that are used.
void filter_step_beams(benchmark::State& state) {
  BeamModelParams params;
  params.beams = static_cast<std::size_t>(state.range(1));
  run_filter(state, BeamModel(home_grid(), params, 12.0));
}
BENCHMARK(filter_step_beams)->Args({500, 60})->Args({500, 360})->Unit(benchmark::kMillisecond);

void field_of_grid(benchmark::State& state) {
  const OccupancyGrid grid = home_grid();
  for (auto _ : state) benchmark::DoNotOptimize(squared_distances(grid));
}
BENCHMARK(field_of_grid)->Unit(benchmark::kMillisecond);

}  // namespace
