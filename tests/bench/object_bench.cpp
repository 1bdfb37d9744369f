// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#include "core/objects/box_depth.hpp"
#include "core/objects/object_map.hpp"
#include "core/objects/simulated_perception.hpp"
#include "core/random_stream.hpp"

#include <benchmark/benchmark.h>

#include <vector>

namespace {

using namespace mapscore;

/// A 640 x 480 image of a wall at 5 m, and boxes of 0.2 to 1 m around the camera, as in a home.
PosedDepth view_of_a_wall() {
  PosedDepth view;
  view.camera = CameraModel::from_hfov(640, 480, 1.02);
  view.depth = cv::Mat1w(480, 640, static_cast<std::uint16_t>(5 * kDepthUnitsPerMetre));
  return view;
}

std::vector<ObjectBox> boxes_around(int count) {
  RandomStream stream(1, "bench", {});
  std::vector<ObjectBox> boxes(static_cast<std::size_t>(count));
  for (ObjectBox& box : boxes) {
    for (double& x : box.T_frame_box.translation()) x = 12.0 * stream.uniform() - 6.0;
    box.T_frame_box.linear() = exp_rotation({0, stream.uniform(), 0});
    for (double& size : box.size_m) size = 0.2 + 0.8 * stream.uniform();
  }
  return boxes;
}

/// What ageing costs a frame: the votes of 100 objects, most of them out of view.
void BM_VotesOfAHundredObjects(benchmark::State& state) {
  const PosedDepth view = view_of_a_wall();
  const std::vector<ObjectBox> boxes = boxes_around(100);
  int pixels = 0;
  for (auto _ : state) {
    pixels = 0;
    for (const ObjectBox& box : boxes) pixels += vote(box, view, 0.02).looked();
    benchmark::DoNotOptimize(pixels);
  }
  state.counters["pixels"] = pixels;
}
BENCHMARK(BM_VotesOfAHundredObjects)->Unit(benchmark::kMillisecond);

/// Label image of 100 boxes from a depth image.
void BM_PerceiveAHundredObjects(benchmark::State& state) {
  const PosedDepth view = view_of_a_wall();
  std::vector<PerceivedModel> models;
  for (const ObjectBox& box : boxes_around(100))
    models.push_back({static_cast<InstanceId>(models.size() + 1), {box}});
  for (auto _ : state) benchmark::DoNotOptimize(perceive(models, view, 0.01).data);
}
BENCHMARK(BM_PerceiveAHundredObjects)->Unit(benchmark::kMillisecond);

/// Association and merging alone: 100 objects, all detected again.
void BM_IntegrateAHundredDetections(benchmark::State& state) {
  std::vector<ObjectDetection> frame;
  for (const ObjectBox& box : boxes_around(100))
    frame.push_back({static_cast<ClassId>(1 + frame.size() % 8), box, 1.0, {}});
  ObjectMap map(9);
  map.integrate(frame, 0.0);
  for (auto _ : state) map.integrate(frame, 1.0);
  state.counters["objects"] = static_cast<double>(map.objects().size());
}
BENCHMARK(BM_IntegrateAHundredDetections)->Unit(benchmark::kMillisecond);

}  // namespace
