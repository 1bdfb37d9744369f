// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#ifdef MAPSCORE_SIMULATOR

#include "sim/recorder/recorded_drive.hpp"
#include "sim/robot/drive_simulation.hpp"
#include "sim/sensors/lidar.hpp"

#include <benchmark/benchmark.h>

#include <filesystem>
#include <vector>

namespace {

using namespace mapscore;

std::filesystem::path scene_file(const char* name) {
  return std::filesystem::path(MAPSCORE_SOURCE_DIR) / "scenes" / name;
}

const sim::World& apartment() {
  static const sim::World kWorld =
      sim::World::load({scene_file("apartment.xml"), std::nullopt, scene_file("robot.xml")}, {});
  return kWorld;
}

/// Across the living room and back, off the rug: simulated seconds a second.
void drive_apartment(benchmark::State& state) {
  sim::Drive drive;
  drive.waypoints = {{4.213, 1.837, 0}, {4.277, 3.937, 0}, {4.213, 1.837, 0}};
  double simulated_s = 0.0;
  for (auto _ : state)
    simulated_s += sim::simulate_drive(apartment(), scene_file("robot.xml"), drive).end_s;
  state.counters["simulated_s"] = simulated_s / static_cast<double>(state.iterations());
  state.counters["simulated_s_per_s"] =
      benchmark::Counter(simulated_s, benchmark::Counter::kIsRate);
}
BENCHMARK(drive_apartment)->Unit(benchmark::kMillisecond);

/// Turns of 360 beams, by jobs.
void lidar_apartment(benchmark::State& state) {
  const sim::Lidar lidar(apartment());
  std::vector<sim::StampedPose> poses;
  for (int i = 0; i < 500; ++i) poses.push_back({0.0, planar_pose(4.2, 1.9 + 0.004 * i, 0.05 * i)});
  for (auto _ : state)
    benchmark::DoNotOptimize(lidar.scans(poses, static_cast<int>(state.range(0))));
  state.counters["scans_per_s"] = benchmark::Counter(
      static_cast<double>(poses.size() * state.iterations()), benchmark::Counter::kIsRate);
}
BENCHMARK(lidar_apartment)->Arg(1)->Arg(2)->UseRealTime()->Unit(benchmark::kMillisecond);

}  // namespace

#endif
