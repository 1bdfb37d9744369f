// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#include "sim/robot/drive_physics.hpp"

#include "core/error.hpp"
#include "sim/world/mujoco_session.hpp"

#include <fmt/format.h>
#include <mujoco/mujoco.h>

#include <algorithm>
#include <cmath>

namespace mapscore::sim {
namespace {

constexpr double kDropM = 0.001, kSettleS = 1.0;
constexpr double kTippedRad = 0.35, kFallenM = -0.1;

}  // namespace

void DrivePhysics::settle(const PlanarPose& start, double floor_m) {
  mj_resetData(drive_.model.get(), data_.get());
  stand_upright(drive_, start, floor_m + kDropM, *data_);
  ramp_steps_ = 0;
  const int steps = static_cast<int>(std::lround(kSettleS / step_s()));
  for (int i = 0; i < steps; ++i) step();
  steps_ = 0;
  health_ = {};
  airborne_s_ = {};
  for (int side = 0; side < 2; ++side) wheel_zero_rad_[side] = data_->qpos[drive_.wheel_qpos[side]];
}

void DrivePhysics::command(const VelocityCommand& command, int steps) {
  const double half_turn = 0.5 * drive_.wheels.track_m * command.omega_radps;
  const std::array<double, 2> speed_mps = {command.v_mps - half_turn, command.v_mps + half_turn};
  for (int side = 0; side < 2; ++side) {
    const double speed_radps = speed_mps[side] / drive_.wheels.radius_m;
    wheel_step_radps_[side] = (speed_radps - data_->ctrl[drive_.wheel_actuator[side]]) / steps;
  }
  ramp_steps_ = steps;
}

void DrivePhysics::step() {
  for (int side = 0; side < 2 && ramp_steps_ > 0; ++side)
    data_->ctrl[drive_.wheel_actuator[side]] += wheel_step_radps_[side];
  --ramp_steps_;
  mj_step(drive_.model.get(), data_.get());
  ++steps_;
  check_state();
  observe_contacts();
}

void DrivePhysics::check_state() {
  bool finite = true;
  for (int i = 0; i < drive_.model->nq; ++i) finite = finite && std::isfinite(data_->qpos[i]);
  for (int i = 0; i < drive_.model->nv; ++i) finite = finite && std::isfinite(data_->qvel[i]);
  if (!finite)
    throw Error(
        fmt::format("drive: the physics diverged after {:.2f} s; check the robot's masses "
                    "and contacts",
                    time_s()));
  const mjtNum* pose = data_->qpos + drive_.base_qpos;
  const double up = 1.0 - 2.0 * (pose[4] * pose[4] + pose[5] * pose[5]);  // z axis along z
  const double tilt_rad = std::acos(std::clamp(up, -1.0, 1.0));
  health_.largest_tilt_rad = std::max(health_.largest_tilt_rad, tilt_rad);
  if (tilt_rad < kTippedRad && pose[2] > kFallenM) return;
  throw Error(fmt::format(
      "drive: the robot {} at ({:.2f}, {:.2f} m) after {:.2f} s; move the "
      "waypoints, or the start, away from there",
      tilt_rad < kTippedRad ? "falls off the floor" : "tips over", pose[0], pose[1], time_s()));
}

void DrivePhysics::observe_contacts() {
  std::array<bool, 2> grounded{};
  for (int i = 0; i < data_->ncon; ++i) {
    const mjContact& contact = data_->contact[i];
    for (const int geom : contact.geom) {
      if (drive_.role[geom] == GeomRole::bump) ++health_.bump_contacts;
      for (int side = 0; side < 2; ++side) {
        if (geom != drive_.wheel_geom[side]) continue;
        grounded[side] = true;
        health_.deepest_wheel_m = std::max(health_.deepest_wheel_m, -contact.dist);
      }
    }
  }
  for (int side = 0; side < 2; ++side) {
    airborne_s_[side] = grounded[side] ? 0.0 : airborne_s_[side] + step_s();
    health_.longest_airborne_s = std::max(health_.longest_airborne_s, airborne_s_[side]);
  }
}

std::optional<Obstacle> DrivePhysics::touched() const {
  constexpr double kSteepest = 0.9;  // a normal with a larger z belongs to a floor
  const mjContact* most = nullptr;
  for (int i = 0; i < data_->ncon; ++i) {
    const mjContact& contact = data_->contact[i];
    const double limit = most ? std::abs(most->frame[2]) : kSteepest;
    if (std::abs(contact.frame[2]) < limit) most = &contact;
  }
  if (!most) return std::nullopt;
  return obstacle_of(drive_, *most);
}

Pose DrivePhysics::T_world_base() const {
  const mjtNum* pose = data_->qpos + drive_.base_qpos;
  mjtNum rotation[9];
  mju_quat2Mat(rotation, pose + 3);
  return pose_of(pose, rotation);
}

WheelTicks DrivePhysics::ticks(int ticks_per_turn) const {
  const auto turned = [&](int side) {
    return data_->qpos[drive_.wheel_qpos[side]] - wheel_zero_rad_[side];
  };
  return {ticks_of(turned(0), ticks_per_turn), ticks_of(turned(1), ticks_per_turn)};
}

}  // namespace mapscore::sim
