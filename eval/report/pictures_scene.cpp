// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#include "eval/report/pictures_scene.hpp"

#include "core/error.hpp"
#include "eval/experiment/study_recording.hpp"

namespace mapscore::eval {

#ifdef MAPSCORE_SIMULATOR

struct ScenePainter::State {
  explicit State(const sim::World& drawn) : world(drawn), renderer(world, false) {}
  sim::World world;
  sim::Renderer renderer;
};

ScenePainter::ScenePainter(const Study& study, const Recording& recording) {
  if (!study.scene) throw Error("scene: the study names none; pictures are drawn in its scene");
  const sim::World world = world_of(study);
  if (world.hash() != recording.info().scene_hash)
    throw Error(resolve_path(study, *study.scene).string() +
                ": changed since it was recorded; sweep again to draw pictures");
  state_ = std::make_unique<State>(world);
}

cv::Mat3b ScenePainter::paint(sim::View view, std::span<const sim::Cube> cubes) {
  for (const SemanticClass& c : state_->world.classes().classes)
    if (c.name == "ceiling") view.hidden_classes.push_back(c.name);
  view.ghost_scene = true;
  return state_->renderer.picture(view, cubes);
}

#else

struct ScenePainter::State {};

ScenePainter::ScenePainter(const Study&, const Recording&) {
  throw Error(
      "pictures: this mapscore was built without the simulator; build with "
      "-DMAPSCORE_SIMULATOR=ON");
}

cv::Mat3b ScenePainter::paint(sim::View, std::span<const sim::Cube>) {
  return {};
}

#endif

ScenePainter::~ScenePainter() = default;

}  // namespace mapscore::eval
