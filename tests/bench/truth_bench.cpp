// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#include "core/parallel.hpp"
#include "core/random_stream.hpp"
#include "eval/render/study_recording.hpp"
#include "eval/truth/distance.hpp"
#include "eval/truth/surface_truth.hpp"
#include "eval/truth/visible_truth.hpp"
#include "tests/bench/peak_memory.hpp"

#include <benchmark/benchmark.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

// Surface and visible truth of a synthetic apartment of 10 m x 7 m x 2.5 m: floor, walls, ceiling
// and 294 pieces of furniture that stand on the floor, on each other and in each other. Counters:
// `bar_ms` the most that it may take on two cores, `peak_MiB` how far memory rises, of which the
// truth that is returned makes `truth_MiB`.

namespace mapscore::eval {
namespace {

using Eigen::Vector3d;

ClassTable home_classes() {
  ClassTable table;
  for (ClassId id = 1; id <= 10; ++id) {
    table.classes.push_back({id, "class_" + std::to_string(id), {}, true});
    table.instances.push_back({id, "body_" + std::to_string(id), id});
  }
  return table;
}

Shape box_at(const Vector3d& centre, const Vector3d& half, InstanceId instance) {
  Shape shape;
  shape.instance = instance;
  shape.size = half;
  shape.T_world_shape.translation() = centre;
  return shape;
}

const Vector3d kRoom_m(10, 7, 2.5);

/// Floor and ceiling of class 1, walls of class 2.
std::vector<Shape> home() {
  const Vector3d half = kRoom_m / 2;
  const double x = half.x(), y = half.y(), z = half.z();
  std::vector<Shape> shapes{
      box_at({x, y, -0.05}, {x, y, 0.05}, 1),  box_at({x, y, 2.557}, {x, y, 0.05}, 1),
      box_at({x, -0.037, z}, {x, 0.05, z}, 2), box_at({x, 2 * y + 0.043, z}, {x, 0.05, z}, 2),
      box_at({-0.041, y, z}, {0.05, y, z}, 2), box_at({2 * x + 0.029, y, z}, {0.05, y, z}, 2)};
  RandomStream random(1, "home");
  constexpr ShapeKind kKinds[] = {ShapeKind::box,      ShapeKind::box,     ShapeKind::box,
                                  ShapeKind::cylinder, ShapeKind::capsule, ShapeKind::sphere,
                                  ShapeKind::ellipsoid};
  while (shapes.size() < 300) {
    Shape shape;
    shape.kind = kKinds[shapes.size() % 7];
    shape.instance = static_cast<InstanceId>(random.uniform() * 11);
    for (int i = 0; i < 3; ++i) shape.size[i] = 0.02 + 0.4 * std::pow(random.uniform(), 2);
    shape.T_world_shape.linear() =
        Eigen::AngleAxisd(2 * std::numbers::pi * random.uniform(), Vector3d::UnitZ())
            .toRotationMatrix();
    const double px = random.uniform(), py = random.uniform(), pz = random.uniform();
    shape.T_world_shape.translation() = Vector3d(kRoom_m.x() * px, kRoom_m.y() * py, 1.5 * pz);
    shapes.push_back(shape);
  }
  return shapes;
}

/// Times the surface truth of the shapes with voxels of range(0) mm on range(1) jobs.
void time_surface_truth(benchmark::State& state, const std::vector<Shape>& shapes,
                        const ClassTable& table) {
  const SurfaceOptions options{static_cast<double>(state.range(0)) / 1000, 0.0005,
                               static_cast<int>(state.range(1))};
  const Pose T_map_world = map_from_world({0.0031, 0.0017, 0.0043}, 0);
  std::size_t rows = 0;
  double peak_MiB = 0.0, truth_MiB = 0.0;
  for (auto _ : state) {
    state.PauseTiming();
    const bench::PeakMemory memory;
    state.ResumeTiming();
    const SurfaceTruth truth = surface_truth(shapes, table, T_map_world, options);
    state.PauseTiming();
    rows = truth.voxels().size();
    peak_MiB = std::max(peak_MiB, memory.peak_MiB());
    truth_MiB = memory.held_MiB();
    state.ResumeTiming();
  }
  state.counters["geoms"] = static_cast<double>(shapes.size());
  state.counters["rows"] = static_cast<double>(rows);
  state.counters["peak_MiB"] = peak_MiB;
  state.counters["truth_MiB"] = truth_MiB;
}

void BM_SurfaceTruth(benchmark::State& state) {
  time_surface_truth(state, home(), home_classes());
  state.counters["bar_ms"] = static_cast<double>(state.range(2));
}
BENCHMARK(BM_SurfaceTruth)
    ->ArgNames({"mm", "jobs", "bar_ms"})
    ->Args({50, 1, 300})
    ->Args({50, 2, 300})
    ->Args({20, 2, 1500})
    ->Args({10, 2, 8000})
    ->Unit(benchmark::kMillisecond)
    ->UseRealTime();

#ifdef MAPSCORE_SIMULATOR
void BM_SurfaceTruthOfTheApartment(benchmark::State& state) {
  const SceneSurfaces scene = surfaces_of_scene(MAPSCORE_SOURCE_DIR "/scenes/apartment.xml");
  time_surface_truth(state, scene.shapes, scene.table);
}
BENCHMARK(BM_SurfaceTruthOfTheApartment)
    ->ArgNames({"mm", "jobs"})
    ->Args({50, 2})
    ->Args({20, 2})
    ->Args({10, 2})
    ->Unit(benchmark::kMillisecond)
    ->UseRealTime();
#endif

Pose pose_of_frame(int n) {
  Pose pose = planar_pose(4 + 0.02 * n, 3, 0.05 * n);
  pose.translate(Vector3d(0, 0, 1));
  pose.rotate(Eigen::AngleAxisd(-std::numbers::pi / 2, Vector3d::UnitX()));
  return pose;
}

Calibration camera() {
  Calibration calibration;
  calibration.depth = CameraModel::from_hfov(640, 480, 1.05);
  return calibration;
}

/// What the camera sees of the empty room, with a piece of furniture in every third patch of 40 x
/// 60 pixels before it.
Frame frame_from(const Pose& T_map_camera) {
  const CameraModel model = camera().depth;
  Frame frame;
  frame.depth = cv::Mat1w(model.height_px, model.width_px);
  frame.depth_label = cv::Mat1w(model.height_px, model.width_px);
  const Vector3d eye = T_map_camera.translation();
  for (int v = 0; v < model.height_px; ++v) {
    for (int u = 0; u < model.width_px; ++u) {
      const Vector3d ray = T_map_camera.linear() * model.back_project(u, v, 1.0);
      const Eigen::Array3d ahead = (ray.array() > 0).select(kRoom_m - eye, -eye);
      int axis = 0;
      double z = (ahead / ray.array()).minCoeff(&axis);
      const int patch = u / 40 + v / 60 * 7;
      const bool furniture = patch % 3 == 0;
      if (furniture) z *= 0.6 + 0.0005 * (u % 40);
      frame.depth(v, u) = static_cast<std::uint16_t>(z * kDepthUnitsPerMetre);
      frame.depth_label(v, u) = static_cast<std::uint16_t>(furniture   ? patch % 11
                                                           : axis == 2 ? 1
                                                                       : 2);
    }
  }
  return frame;
}

void BM_CountSamplesOfAFrame(benchmark::State& state) {
  const Frame frame = frame_from(pose_of_frame(3));
  const ClassTable table = home_classes();
  const Calibration calibration = camera();
  SampleCounter counter(static_cast<double>(state.range(0)) / 1000);
  int n = 0;
  for (auto _ : state) counter.add(frame, calibration, table, pose_of_frame(n++ % 100));
  state.SetItemsProcessed(state.iterations() * 640 * 480);
}
BENCHMARK(BM_CountSamplesOfAFrame)->ArgName("mm")->Arg(50)->Arg(20)->Unit(benchmark::kMillisecond);

/// Of 100 decoded frames of 640 x 480, as make_views does it: a counter for each job, merged.
void BM_VisibleTruthOf100Frames(benchmark::State& state) {
  constexpr int kFrames = 100;
  const double edge_m = static_cast<double>(state.range(0)) / 1000;
  const int jobs = static_cast<int>(state.range(1));
  const ClassTable table = home_classes();
  const Calibration calibration = camera();
  const SurfaceTruth surface = surface_truth(home(), table, Pose::Identity(), {edge_m, 0.0005, 2});
  std::vector<Frame> frames;
  for (int n = 0; n < kFrames; ++n) frames.push_back(frame_from(pose_of_frame(n)));
  std::size_t voxels = 0;
  double peak_MiB = 0.0;
  for (auto _ : state) {
    state.PauseTiming();
    const bench::PeakMemory memory;
    state.ResumeTiming();
    std::vector<SampleCounter> counters(static_cast<std::size_t>(jobs), SampleCounter(edge_m));
    run_jobs(jobs, [&](int job) {
      for (int n = kFrames * job / jobs; n < kFrames * (job + 1) / jobs; ++n) {
        counters[static_cast<std::size_t>(job)].add(frames[static_cast<std::size_t>(n)],
                                                    calibration, table, pose_of_frame(n));
      }
    });
    for (int job = 1; job < jobs; ++job) {
      counters.front().merge(counters[static_cast<std::size_t>(job)]);
    }
    voxels = visible_truth(counters.front(), surface, 1).voxels().size();
    peak_MiB = std::max(peak_MiB, memory.peak_MiB());
  }
  state.counters["voxels"] = static_cast<double>(voxels);
  state.counters["peak_MiB"] = peak_MiB;
  if (state.range(0) == 50) state.counters["bar_ms"] = 500;
}
BENCHMARK(BM_VisibleTruthOf100Frames)
    ->ArgNames({"mm", "jobs"})
    ->Args({50, 1})
    ->Args({50, 2})
    ->Args({20, 2})
    ->Unit(benchmark::kMillisecond)
    ->UseRealTime();

/// Distances of predicted cubes near a class's surface, as accuracy needs them.
void BM_DistanceToSurface(benchmark::State& state) {
  const SurfaceDistance distance(pieces_of(prepare(home(), Pose::Identity()), home_classes(), 3));
  RandomStream random(1, "cubes");
  std::vector<Box> cubes;
  for (int i = 0; i < 1000; ++i) {
    const double x = random.uniform(), y = random.uniform(), z = random.uniform();
    const Vector3d low(kRoom_m.x() * x, kRoom_m.y() * y, 1.5 * z);
    cubes.emplace_back(low, (low.array() + 0.05).matrix());
  }
  std::size_t next = 0;
  for (auto _ : state) benchmark::DoNotOptimize(distance(cubes[next++ % cubes.size()]));
}
BENCHMARK(BM_DistanceToSurface);

}  // namespace
}  // namespace mapscore::eval
