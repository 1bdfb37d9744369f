// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#include "sim/world/moving_scene.hpp"

#include "sim/world/compiled_scene.hpp"
#include "sim/world/mujoco_pose.hpp"

#include <optional>

namespace mapscore::sim {
namespace {

std::vector<Pose> poses_of(const std::vector<Shape>& shapes) {
  std::vector<Pose> poses;
  poses.reserve(shapes.size());
  for (const Shape& shape : shapes) poses.push_back(shape.T_world_shape);
  return poses;
}

/// For each body, whether a joint of the motion moves it.
std::vector<bool> moved_bodies(const mjModel& model, const JointMotion& motion) {
  std::vector<bool> moved(static_cast<std::size_t>(model.nbody), false);
  for (const std::string& joint : motion.motion.joints)
    moved[model.jnt_bodyid[mj_name2id(&model, mjOBJ_JOINT, joint.c_str())]] = true;
  for (int body = 1; body < model.nbody; ++body)  // parents come first
    if (moved[model.body_parentid[body]]) moved[body] = true;
  return moved;
}

}  // namespace

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
  const mjModel& model = *s.world->compiled->model;
  const std::vector<double> values = s.world->motion->motion.at(stamp_s);
  for (std::size_t joint = 0; joint < values.size(); ++joint)
    s.data->qpos[s.world->motion->addresses[joint]] = values[joint];
  place(model, *s.data);
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

}  // namespace mapscore::sim
