// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#include "core/random_stream.hpp"
#include "eval/truth/distance.hpp"
#include "eval/truth/surface_truth.hpp"
#include "eval/truth/visible_truth.hpp"

#include <benchmark/benchmark.h>

#include <cmath>
#include <numbers>
#include <vector>

// Surface and visible truth of a synthetic home of 8 m x 6 m x 2.5 m: floor, walls, ceiling and
// some 300 pieces of furniture that stand on the floor, on each other and in each other.

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

std::vector<Shape> home() {
  std::vector<Shape> shapes{
      box_at({4, 3, -0.05}, {4, 3, 0.05}, 0),        box_at({4, 3, 2.557}, {4, 3, 0.05}, 0),
      box_at({4, -0.037, 1.25}, {4, 0.05, 1.25}, 0), box_at({4, 6.043, 1.25}, {4, 0.05, 1.25}, 0),
      box_at({-0.041, 3, 1.25}, {0.05, 3, 1.25}, 0), box_at({8.029, 3, 1.25}, {0.05, 3, 1.25}, 0)};
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
    shape.T_world_shape.translation() =
        Vector3d(8 * random.uniform(), 6 * random.uniform(), 1.5 * random.uniform());
    shapes.push_back(shape);
  }
  return shapes;
}

/// What a camera in the middle of the room sees: a wall 3 m away with furniture before it.
Frame view(int width, int height) {
  Frame frame;
  frame.depth = cv::Mat1w(height, width);
  frame.depth_label = cv::Mat1w(height, width);
  for (int v = 0; v < height; ++v) {
    for (int u = 0; u < width; ++u) {
      const int piece = (u / 40 + v / 60 * 7) % 11;
      frame.depth_label(v, u) = static_cast<std::uint16_t>(piece);
      frame.depth(v, u) = static_cast<std::uint16_t>(8000 + 700 * piece + 2 * (u % 40) + (v % 60));
    }
  }
  return frame;
}

void BM_SurfaceTruth(benchmark::State& state) {
  const std::vector<Shape> shapes = home();
  const ClassTable table = home_classes();
  const SurfaceOptions options{static_cast<double>(state.range(0)) / 1000, 0.0005,
                               static_cast<int>(state.range(1))};
  std::size_t rows = 0;
  for (auto _ : state) {
    const SurfaceTruth truth =
        surface_truth(shapes, table, map_from_world({0.0031, 0.0017, 0.0043}, 0), options);
    rows = truth.voxels().size();
  }
  state.counters["rows"] = static_cast<double>(rows);
}
BENCHMARK(BM_SurfaceTruth)
    ->ArgNames({"mm", "jobs"})
    ->Args({50, 1})
    ->Args({50, 2})
    ->Args({20, 1})
    ->Args({20, 2})
    ->Unit(benchmark::kMillisecond)
    ->UseRealTime();

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

void BM_CountSamplesOfAFrame(benchmark::State& state) {
  const Frame frame = view(640, 480);
  const ClassTable table = home_classes();
  const Calibration calibration = camera();
  SampleCounter counter(static_cast<double>(state.range(0)) / 1000);
  int n = 0;
  for (auto _ : state) counter.add(frame, calibration, table, pose_of_frame(n++ % 100));
  state.SetItemsProcessed(state.iterations() * 640 * 480);
}
BENCHMARK(BM_CountSamplesOfAFrame)->ArgName("mm")->Arg(50)->Arg(20)->Unit(benchmark::kMillisecond);

void BM_VisibleTruthOfAFrame(benchmark::State& state) {
  const double edge_m = static_cast<double>(state.range(0)) / 1000;
  const Frame frame = view(640, 480);
  const ClassTable table = home_classes();
  const SurfaceTruth surface = surface_truth(home(), table, Pose::Identity(), {edge_m, 0.0005, 2});
  for (auto _ : state) {
    SampleCounter counter(edge_m);
    counter.add(frame, camera(), table, pose_of_frame(3));
    benchmark::DoNotOptimize(visible_truth(counter, surface, 1));
  }
}
BENCHMARK(BM_VisibleTruthOfAFrame)->ArgName("mm")->Arg(50)->Arg(20)->Unit(benchmark::kMillisecond);

/// Distances of predicted cubes near a class's surface, as accuracy needs them.
void BM_DistanceToSurface(benchmark::State& state) {
  const SurfaceDistance distance(pieces_of(prepare(home(), Pose::Identity()), home_classes(), 3));
  RandomStream random(1, "cubes");
  std::vector<Box> cubes;
  for (int i = 0; i < 1000; ++i) {
    const Vector3d low(8 * random.uniform(), 6 * random.uniform(), 1.5 * random.uniform());
    cubes.emplace_back(low, (low.array() + 0.05).matrix());
  }
  std::size_t next = 0;
  for (auto _ : state) benchmark::DoNotOptimize(distance(cubes[next++ % cubes.size()]));
}
BENCHMARK(BM_DistanceToSurface);

}  // namespace
}  // namespace mapscore::eval
