// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#include "sim/world/world.hpp"

#include "core/error.hpp"
#include "sim/world/compiled_scene.hpp"
#include "sim/world/robot_cameras.hpp"
#include "sim/world/scene_builder.hpp"
#include "sim/world/shape_scene.hpp"
#include "sim/world/surfaces.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>

namespace mapscore::sim {
namespace {

/// A compiled scene at its initial pose.
struct PlacedModel {
  ModelPtr model;
  DataPtr data;
};

PlacedModel compile_and_place(SceneBuilder& builder) {
  PlacedModel placed;
  placed.model = builder.compile();
  placed.data.reset(mj_makeData(placed.model.get()));
  place(*placed.model, *placed.data);
  return placed;
}

/// `root` below 0: none.
std::vector<bool> bodies_under(const mjModel& model, int root) {
  std::vector<bool> under(model.nbody, false);
  if (root < 0) return under;
  for (int body = root; body < model.nbody; ++body) {  // parents come first
    under[body] = body == root || under[model.body_parentid[body]];
  }
  return under;
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

std::vector<Pose> poses_of(const std::vector<Shape>& shapes) {
  std::vector<Pose> poses;
  for (const Shape& shape : shapes) poses.push_back(shape.T_world_shape);
  return poses;
}

/// For each body, whether a joint of the motion moves it.
std::vector<bool> moved_bodies(const mjModel& model, const Motion& motion) {
  std::vector<bool> moved(static_cast<std::size_t>(model.nbody), false);
  for (const std::string& joint : motion.joints)
    moved[model.jnt_bodyid[mj_name2id(&model, mjOBJ_JOINT, joint.c_str())]] = true;
  for (int body = 1; body < model.nbody; ++body)  // parents come first
    if (moved[model.body_parentid[body]]) moved[body] = true;
  return moved;
}

/// Throws Error unless the scene has the joint, and it is a hinge or a slide.
void check_joint(const CompiledScene& scene, const std::string& joint, const std::string& file) {
  const mjModel& model = *scene.model;
  const int id = mj_name2id(&model, mjOBJ_JOINT, joint.c_str());
  if (id >= 0 && !scene.robot_body[model.jnt_bodyid[id]]) {
    if (model.jnt_type[id] == mjJNT_HINGE || model.jnt_type[id] == mjJNT_SLIDE) return;
    throw Error(fmt::format(
        "{}: joint '{}' is neither hinge nor slide; move it by several of these", file, joint));
  }
  std::vector<std::string> names;
  for (int other = 0; other < model.njnt; ++other)
    if (std::string name = element_name(model, mjOBJ_JOINT, other);
        !name.empty() && !scene.robot_body[model.jnt_bodyid[other]])
      names.push_back(std::move(name));
  throw Error(fmt::format("{}: the scene has no joint '{}'; its joints: {}", file, joint,
                          names.empty() ? "none" : fmt::format("{}", fmt::join(names, ", "))));
}

/// OpenGL would keep that many slices of every built-in shape.
void refuse_countless_slices(const mjModel& model, const std::string& scene_file) {
  constexpr int kMost = 512;
  const auto& quality = model.vis.quality;
  if (std::max({quality.numslices, quality.numstacks, quality.numquads}) > kMost)
    throw Error(fmt::format(
        "{}: numslices, numstacks or numquads of its <quality> exceeds {}; lower it there",
        scene_file, kMost));
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

struct World::State {
  std::shared_ptr<const CompiledScene> compiled;
  DrawnScene drawn;
  std::vector<Shape> shapes;
  std::shared_ptr<const Motion> motion;  ///< none for a world that stands still
};

// Compiled twice: once as it stands, to know the drawn surfaces, then with facets for the round
// ones.
World World::load(const WorldFiles& files, const CameraOverrides& cameras) {
  quiet_mujoco();
  const std::optional<std::filesystem::path> class_file =
      files.classes ? files.classes : class_file_beside(files.scene);
  SceneBuilder builder(files.scene, files.robot);
  const PlacedModel plain = compile_and_place(builder);
  const int base = mj_name2id(plain.model.get(), mjOBJ_BODY, "robot/base_footprint");

  auto compiled = std::make_shared<CompiledScene>();
  if (base >= 0)
    compiled->calibration =
        read_calibration(*plain.model, *plain.data, base, cameras, files.robot.string());
  refuse_countless_slices(*plain.model, files.scene.string());
  compiled->robot_body = bodies_under(*plain.model, base);
  compiled->ownership = assign_bodies(*plain.model, class_file, compiled->robot_body);
  const DrawnScene solid =
      solid_scene(*plain.model, *plain.data, compiled->ownership, compiled->robot_body);
  refuse_countless_triangles(*plain.model, solid, files.scene.string());
  const std::vector<int> geoms = ids_of(solid);
  compiled->assignment =
      assign_geoms(*plain.model, compiled->ownership, geoms, class_file.has_value());
  compiled->hash = content_hash(*plain.model, files.scene, class_file, files.robot);
  make_finite(plain, geoms);
  auto state = std::make_shared<State>();
  state->shapes =
      surfaces_of(plain, geoms, compiled->assignment.geom_instances, files.scene.string());

  builder.add_facets(state->shapes);
  PlacedModel faceted = compile_and_place(builder);
  make_finite(faceted, geoms);
  set_quality(*faceted.model, cameras);
  compiled->model = std::move(faceted.model);
  state->drawn = faceted_scene(*compiled, *faceted.data, state->shapes, poses_of(state->shapes));
  state->compiled = std::move(compiled);
  return World(std::move(state));
}

World World::of_shapes(std::vector<Shape> shapes, const ClassTable& table) {
  quiet_mujoco();
  auto state = std::make_shared<State>();
  auto compiled = std::make_shared<CompiledScene>();
  ShapeScene scene = scene_of_shapes(std::move(shapes), table);
  set_quality(*scene.model, {});
  compiled->model = std::move(scene.model);
  state->drawn = std::move(scene.drawn);
  compiled->assignment.table = table;
  state->shapes = std::move(scene.shapes);
  for (const Shape& shape : state->shapes)
    compiled->assignment.geom_instances.push_back(shape.instance);
  state->compiled = std::move(compiled);
  return World(std::move(state));
}

World World::moving(Motion motion) const {
  for (const std::string& joint : motion.joints) check_joint(*state_->compiled, joint, motion.file);
  auto state = std::make_shared<State>(*state_);
  state->motion = std::make_shared<Motion>(std::move(motion));
  return World(std::move(state));
}

World World::at(double stamp_s) const {
  MovingScene scene(*this);
  scene.move_to(stamp_s);
  auto state = std::make_shared<State>(*state_);
  state->motion = nullptr;
  state->drawn = scene.drawn();
  for (std::size_t i = 0; i < state->shapes.size(); ++i)
    state->shapes[i].T_world_shape = scene.poses()[i];
  return World(std::move(state));
}

const Motion* World::motion() const {
  return state_->motion.get();
}
const ClassTable& World::classes() const {
  return state_->compiled->assignment.table;
}
const Calibration& World::calibration() const {
  return state_->compiled->calibration;
}
const std::vector<Shape>& World::shapes() const {
  return state_->shapes;
}
const std::vector<std::string>& World::unmatched_bodies() const {
  return state_->compiled->assignment.unmatched_bodies;
}
bool World::has_light() const {
  return model().nlight > 0;
}
const std::string& World::hash() const {
  return state_->compiled->hash;
}
const mjModel_& World::model() const {
  return *state_->compiled->model;
}
const std::vector<InstanceId>& World::geom_instances() const {
  return state_->compiled->assignment.geom_instances;
}
bool World::robot_geom(int geom) const {
  const std::vector<bool>& robot = state_->compiled->robot_body;
  return !robot.empty() && robot[state_->compiled->model->geom_bodyid[geom]];
}
const DrawnScene& World::drawn() const {
  return state_->drawn;
}

struct MovingScene::State {
  explicit State(std::shared_ptr<const World::State> world_state)
      : world(std::move(world_state)), drawn(world->drawn), poses(poses_of(world->shapes)) {
    if (!world->motion) return;
    const mjModel& model = *world->compiled->model;
    data.reset(mj_makeData(&model));
    const std::vector<bool> moved = moved_bodies(model, *world->motion);
    for (const mjvGeom& geom : world->drawn.geoms)
      moves.push_back(moved[model.geom_bodyid[geom.objid]]);
  }

  std::shared_ptr<const World::State> world;
  DataPtr data;
  std::vector<bool> moves;  ///< by shape
  std::optional<double> stamp_s;
  DrawnScene drawn;
  std::vector<Pose> poses;
};

MovingScene::MovingScene(const World& world) : state_(std::make_unique<State>(world.state_)) {}
MovingScene::~MovingScene() = default;

void MovingScene::move_to(double stamp_s) {
  State& s = *state_;
  if (!s.world->motion || s.stamp_s == stamp_s) return;
  s.stamp_s = stamp_s;
  place_at(*s.world->motion, stamp_s, *s.world->compiled->model, *s.data);
  for (std::size_t i = 0; i < s.poses.size(); ++i)
    if (s.moves[i]) s.poses[i] = geom_pose(*s.data, s.world->drawn.geoms[i].objid);
  s.drawn = faceted_scene(*s.world->compiled, *s.data, s.world->shapes, s.poses);
}

const DrawnScene& MovingScene::drawn() const {
  return state_->drawn;
}

const std::vector<Pose>& MovingScene::poses() const {
  return state_->poses;
}

std::string mujoco_version() {
  return mj_versionString();
}

}  // namespace mapscore::sim
