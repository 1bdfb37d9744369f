// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#include "sim/world/scene_builder.hpp"

#include "core/error.hpp"
#include "sim/world/costly_scene.hpp"
#include "sim/world/facets.hpp"
#include "sim/world/robot_cameras.hpp"

#include <fmt/format.h>

#include <array>
#include <set>

namespace mapscore::sim {
namespace {

[[noreturn]] void refuse(const std::filesystem::path& file, const char* reason) {
  if (std::string_view(reason).find("allocate memory") != std::string_view::npos)
    throw Error(fmt::format(
        "{}: MuJoCo needs more memory for it than there is ({} GB at most while it is tried); take "
        "smaller counts (njmax, nconmax, memory), height fields, textures and meshes",
        file.string(), TrialLimits{}.memory_gb));
  throw Error(fmt::format("{}: MuJoCo refuses it: {}; mend the MJCF there", file.string(),
                          one_line(reason)));
}

SpecPtr parse(const std::filesystem::path& file, const char* what) {
  if (!std::filesystem::is_regular_file(file))
    throw Error(fmt::format(
        "{}: no such {} file in {}; check the path, the key {} of a study or --set {}=FILE",
        file.string(), what, std::filesystem::absolute(file).parent_path().string(), what, what));
  std::array<char, 1024> reason{};
  SpecPtr spec(mj_parseXML(file.c_str(), nullptr, reason.data(), static_cast<int>(reason.size())));
  if (!spec) refuse(file, reason.data());
  spec->compiler.fusestatic = 0;  // bodies are objects here, and the robot hangs on one
  return spec;
}

/// Meshes are named by what they look like, to the last bit.
std::string facets_name(const Shape& shape) {
  return fmt::format("mapscore/{}/{:a}/{:a}/{:a}", name_of(shape.kind), shape.size.x(),
                     shape.size.y(), shape.size.z());
}

}  // namespace

SceneBuilder::SceneBuilder(const std::filesystem::path& scene, const std::filesystem::path& robot)
    : scene_(scene) {
  const auto build = [&] {
    spec_ = parse(scene, "scene");
    if (!robot.empty()) attach(robot);
  };
  if (may_cost_much(scene) || may_cost_much(robot)) {
    try_apart(scene, [&] {
      build();
      const ModelPtr model = compile();
      const DataPtr data(mj_makeData(model.get()));
    });
  }
  build();
}

void SceneBuilder::attach(const std::filesystem::path& robot) {
  robot_spec_ = parse(robot, "robot");
  mjsBody* base = mjs_findBody(robot_spec_.get(), "base_footprint");
  if (!base)
    throw Error(
        fmt::format("{}: no body `base_footprint`; name the robot's root so", robot.string()));
  mjsFrame* frame = mjs_addFrame(mjs_findBody(spec_.get(), "world"), nullptr);
  if (!mjs_attach(frame->element, base->element, kRobotPrefix, ""))
    throw Error(fmt::format("{}: cannot be attached to {}: {}", robot.string(), scene_.string(),
                            one_line(mjs_getError(spec_.get()))));
}

ModelPtr SceneBuilder::compile() {
  ModelPtr model(mj_compile(spec_.get(), nullptr));
  if (!model) refuse(scene_, mjs_getError(spec_.get()));
  return model;
}

void SceneBuilder::add_facets(const std::vector<Shape>& shapes) {
  std::set<std::string> names;
  for (const Shape& shape : shapes) {
    const std::string name = facets_name(shape);
    if (!is_round(shape.kind) || !names.insert(name).second) continue;
    add_mesh(spec_.get(), name, facets_of(shape.kind, shape.size, kFacetToleranceM));
  }
}

void draw_by_facets(const mjModel& model, const std::vector<Shape>& shapes,
                    const std::vector<Pose>& T_world_shape, DrawnScene& drawn) {
  for (std::size_t i = 0; i < shapes.size(); ++i) {
    if (!is_round(shapes[i].kind)) continue;
    const int mesh = mj_name2id(&model, mjOBJ_MESH, facets_name(shapes[i]).c_str());
    if (mesh >= 0) draw_mesh(model, mesh, T_world_shape[i], drawn.geoms[i]);
  }
}

}  // namespace mapscore::sim
