// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#include "eval/report/pictures/scene.hpp"

#include "core/error.hpp"
#include "eval/lab/recorded_surfaces.hpp"
#include "eval/render/study_recording.hpp"
#ifdef MAPSCORE_SIMULATOR
#include "sim/world/motion.hpp"
#endif

#include <utility>

namespace mapscore::eval {

#ifdef MAPSCORE_SIMULATOR

namespace {

/// The study's scene as it was recorded; none when it is gone, refused or another one by now.
std::optional<sim::World> recorded_world(const Study& study, const Recording& recording,
                                         std::optional<double> at_s) try {
  if (!study.scene) return std::nullopt;
  sim::World world = world_of(study);
  const std::string motion_hash = world.motion() ? world.motion()->hash : "";
  if (world.hash() != recording.info().scene_hash || motion_hash != recording.info().motion_hash)
    return std::nullopt;
  return world.motion() && at_s ? world.at(*at_s) : world;
} catch (const Error&) {
  return std::nullopt;
}

std::vector<Shape> shapes_at(const Recording& recording, std::optional<double> at_s) {
  if (!recording.info().has_truth)
    throw Error(recording.folder().string() +
                ": has no truth/, so its scene cannot be drawn; give the scene file");
  return shapes_of(recording).at(at_s);
}

}  // namespace

struct ScenePainter::State {
  explicit State(const sim::World& drawn) : world(drawn), renderer(world, false, true) {}
  sim::World world;
  sim::Renderer renderer;
};

ScenePainter::ScenePainter(const Study& study, const Recording& recording,
                           std::optional<double> at_s) {
  const std::optional<sim::World> world = recorded_world(study, recording, at_s);
  state_ = std::make_unique<State>(
      world ? *world : sim::World::of_shapes(shapes_at(recording, at_s), recording.info().table));
}

ScenePainter::ScenePainter(const std::filesystem::path& scene)
    : state_(std::make_unique<State>(world_of_scene(scene))) {}

ScenePainter::ScenePainter(std::vector<Shape> shapes, const ClassTable& table)
    : state_(std::make_unique<State>(sim::World::of_shapes(std::move(shapes), table))) {}

cv::Mat3b ScenePainter::paint(sim::View view, std::span<const sim::Cube> cubes) {
  for (const SemanticClass& c : state_->world.classes().classes)
    if (c.name == "ceiling") view.hidden_classes.push_back(c.name);
  view.ghost_scene = view.open_ceiling = true;
  return state_->renderer.picture(view, cubes);
}

cv::Mat3b ScenePainter::paint_through(sim::View view, std::span<const sim::Cube> cubes) {
  const cv::Mat3b picture = paint(view, cubes);
  view.ghost_scene = true;
  for (const SemanticClass& c : state_->world.classes().classes)
    view.hidden_classes.push_back(c.name);
  // Alone on white, a cube is darker in some channel than the pale thing that covers it.
  return cv::min(picture, state_->renderer.picture(view, cubes));
}

cv::Mat3b ScenePainter::paint_classes(sim::View view) {
  view.class_colours = view.open_ceiling = true;
  return state_->renderer.picture(view);
}

#else

struct ScenePainter::State {
  State() {
    throw Error(
        "pictures: this mapscore was built without the simulator; build with "
        "-DMAPSCORE_SIMULATOR=ON");
  }
};

ScenePainter::ScenePainter(const Study&, const Recording&, std::optional<double>)
    : state_(std::make_unique<State>()) {}
ScenePainter::ScenePainter(const std::filesystem::path&) : state_(std::make_unique<State>()) {}
ScenePainter::ScenePainter(std::vector<Shape>, const ClassTable&)
    : state_(std::make_unique<State>()) {}

cv::Mat3b ScenePainter::paint(sim::View, std::span<const sim::Cube>) {
  return {};
}

cv::Mat3b ScenePainter::paint_through(sim::View, std::span<const sim::Cube>) {
  return {};
}

cv::Mat3b ScenePainter::paint_classes(sim::View) {
  return {};
}

#endif

ScenePainter::~ScenePainter() = default;

}  // namespace mapscore::eval
