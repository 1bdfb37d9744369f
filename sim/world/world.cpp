// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#include "sim/world/world.hpp"

#include "sim/world/class_assignment.hpp"
#include "sim/world/content_hash.hpp"
#include "sim/world/robot_cameras.hpp"
#include "sim/world/scene_builder.hpp"
#include "sim/world/shape_scene.hpp"
#include "sim/world/surfaces.hpp"

#include <algorithm>
#include <utility>

namespace mapscore::sim {

/// A compiled scene at its initial pose.
struct PlacedModel {
  ModelPtr model;
  DataPtr data;
};

struct World::State {
  PlacedModel placed;
  std::vector<bool> robot_body;
  Assignment assignment;
  Calibration calibration;
  DrawnScene drawn;
  std::vector<Shape> shapes;
  std::string hash;
};

namespace {

std::optional<std::filesystem::path> class_file_of(const WorldFiles& files) {
  if (files.classes) return files.classes;
  std::filesystem::path beside = files.scene;
  beside.replace_extension(".classes.yaml");
  return std::filesystem::exists(beside) ? std::optional(beside) : std::nullopt;
}

/// Everything but dynamics: nothing moves at load, and no solver can diverge.
void place(const mjModel& model, mjData& data) {
  mj_kinematics(&model, &data);
  mj_comPos(&model, &data);
  mj_camlight(&model, &data);
}

PlacedModel compile_and_place(SceneBuilder& builder) {
  PlacedModel placed;
  placed.model = builder.compile();
  placed.data.reset(mj_makeData(placed.model.get()));
  place(*placed.model, *placed.data);
  return placed;
}

std::vector<bool> bodies_under(const mjModel& model, int root) {
  std::vector<bool> under(model.nbody, false);
  for (int body = root; body < model.nbody; ++body) {  // parents come first
    under[body] = body == root || under[model.body_parentid[body]];
  }
  return under;
}

/// The drawn geoms that are not the robot's and not transparent; geoms of opaque classes become
/// solid.
DrawnScene solid_scene(const PlacedModel& placed, const Ownership& ownership,
                       const std::vector<bool>& robot_body) {
  DrawnScene drawn = visible_scene(*placed.model, *placed.data);
  std::erase_if(drawn.geoms, [&](mjvGeom& geom) {
    const int body = placed.model->geom_bodyid[geom.objid];
    if (ownership.opaque(body)) geom.rgba[3] = 1.0f;
    return robot_body[body] || geom.rgba[3] < 1.0f;
  });
  return drawn;
}

std::vector<int> ids_of(const DrawnScene& drawn) {
  std::vector<int> ids;
  for (const mjvGeom& geom : drawn.geoms) ids.push_back(geom.objid);
  return ids;
}

void make_finite(const PlacedModel& placed, const std::vector<int>& geoms) {
  cut_infinite_planes(*placed.model, *placed.data, geoms);
  place(*placed.model, *placed.data);
}

std::vector<Shape> surfaces_of(const PlacedModel& placed, const std::vector<int>& geoms,
                               const std::vector<InstanceId>& instances, const std::string& scene) {
  std::vector<Shape> shapes;
  for (const int geom : geoms) {
    shapes.push_back(surface_of(*placed.model, *placed.data, geom, scene));
    shapes.back().instance = instances[geom];
  }
  return shapes;
}

void show_instances(const std::vector<InstanceId>& instances, DrawnScene& drawn) {
  for (mjvGeom& geom : drawn.geoms) geom.segid = instances[geom.objid];
}

/// What renderers need of the model: one sample a pixel, so that nothing blends, room for images,
/// and shadow maps of a size that software rendering can pay for (MuJoCo's default is 4096).
void set_quality(mjModel& model, const CameraOverrides& cameras) {
  constexpr int kLargestShadowMapPx = 1024;
  model.vis.quality.offsamples = 0;
  model.vis.quality.shadowsize = std::min(model.vis.quality.shadowsize, kLargestShadowMapPx);
  model.vis.global.offwidth = cameras.width_px;
  model.vis.global.offheight = cameras.height_px;
}

}  // namespace

// Compiled twice: once as it stands, to know the drawn surfaces, then with facets for the round
// ones.
World World::load(const WorldFiles& files, const CameraOverrides& cameras) {
  quiet_mujoco();
  const std::optional<std::filesystem::path> class_file = class_file_of(files);
  SceneBuilder builder(files.scene, files.robot);
  const PlacedModel plain = compile_and_place(builder);
  const int base = mj_name2id(plain.model.get(), mjOBJ_BODY, "robot/base_footprint");

  auto state = std::make_shared<State>();
  state->calibration =
      read_calibration(*plain.model, *plain.data, base, cameras, files.robot.string());
  state->robot_body = bodies_under(*plain.model, base);
  const Ownership ownership = assign_bodies(*plain.model, class_file, state->robot_body);
  const std::vector<int> geoms = ids_of(solid_scene(plain, ownership, state->robot_body));
  state->assignment = assign_geoms(*plain.model, ownership, geoms, class_file.has_value());
  state->hash = content_hash(*plain.model, files.scene, class_file, files.robot);
  const std::vector<InstanceId>& instances = state->assignment.geom_instances;
  make_finite(plain, geoms);
  state->shapes = surfaces_of(plain, geoms, instances, files.scene.string());

  builder.add_facets(state->shapes);
  state->placed = compile_and_place(builder);
  make_finite(state->placed, geoms);
  set_quality(*state->placed.model, cameras);
  state->drawn = solid_scene(state->placed, ownership, state->robot_body);
  show_instances(instances, state->drawn);
  draw_by_facets(*state->placed.model, state->shapes, state->drawn);

  World world;
  world.state_ = std::move(state);
  return world;
}

World World::of_shapes(std::vector<Shape> shapes, const ClassTable& table) {
  quiet_mujoco();
  auto state = std::make_shared<State>();
  ShapeScene scene = scene_of_shapes(std::move(shapes), table);
  set_quality(*scene.model, {});
  state->placed.model = std::move(scene.model);
  state->drawn = std::move(scene.drawn);
  state->assignment.table = table;
  state->shapes = std::move(scene.shapes);
  for (const Shape& shape : state->shapes)
    state->assignment.geom_instances.push_back(shape.instance);
  World world;
  world.state_ = std::move(state);
  return world;
}

const ClassTable& World::classes() const {
  return state_->assignment.table;
}
const Calibration& World::calibration() const {
  return state_->calibration;
}
const std::vector<Shape>& World::shapes() const {
  return state_->shapes;
}
const std::vector<std::string>& World::unmatched_bodies() const {
  return state_->assignment.unmatched_bodies;
}
const std::string& World::hash() const {
  return state_->hash;
}
const mjModel_& World::model() const {
  return *state_->placed.model;
}
const std::vector<InstanceId>& World::geom_instances() const {
  return state_->assignment.geom_instances;
}
bool World::robot_geom(int geom) const {
  const std::vector<bool>& robot = state_->robot_body;
  return !robot.empty() && robot[state_->placed.model->geom_bodyid[geom]];
}
const DrawnScene& World::drawn() const {
  return state_->drawn;
}

std::string mujoco_version() {
  return mj_versionString();
}

}  // namespace mapscore::sim
