// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#include "sim/robot/clearance.hpp"

#include "sim/sensors/ray_cast.hpp"

#include <algorithm>
#include <array>
#include <cmath>

namespace mapscore::sim {
namespace {

constexpr double kHighestFloorM = 0.06, kLowestFloorM = -0.04;

}  // namespace

Obstacle obstacle_of(const DriveModel& drive, const mjContact& contact) {
  const bool first = drive.role[contact.geom[0]] == GeomRole::scene;
  return {drive.scene_body[contact.geom[first ? 0 : 1]], contact.pos[0], contact.pos[1],
          contact.pos[2]};
}

Clearance::Clearance(const DriveModel& drive)
    : drive_(drive), data_(mj_makeData(drive.probe.get())) {
  mj_kinematics(drive.probe.get(), data_.get());  // places the scene's geoms, once for all
}

std::optional<Obstacle> Clearance::obstacle_at(const PlanarState& place, double floor_m) {
  const mjModel& model = *drive_.probe;
  mjtNum* pose = data_->qpos + drive_.base_qpos;
  const double half = 0.5 * place.yaw_rad;
  const std::array<double, 7> upright = {place.x_m, place.y_m, floor_m,       std::cos(half),
                                         0.0,       0.0,       std::sin(half)};
  std::copy(upright.begin(), upright.end(), pose);
  mj_kinematics(&model, data_.get());
  mj_comPos(&model, data_.get());
  mj_collision(&model, data_.get());
  const mjContact* deepest = nullptr;
  for (int i = 0; i < data_->ncon; ++i) {
    const mjContact& contact = data_->contact[i];
    const bool bumps = drive_.role[contact.geom[0]] == GeomRole::bump ||
                       drive_.role[contact.geom[1]] == GeomRole::bump;
    if (bumps && (!deepest || contact.dist < deepest->dist)) deepest = &contact;
  }
  if (!deepest) return std::nullopt;
  return obstacle_of(drive_, *deepest);
}

std::optional<double> Clearance::floor_at(const PlanarState& place) {
  const double reach_m = 0.5 * drive_.wheels.track_m;
  const double dx = -std::sin(place.yaw_rad) * reach_m, dy = std::cos(place.yaw_rad) * reach_m;
  const auto left = floor_below(place.x_m + dx, place.y_m + dy);
  const auto right = floor_below(place.x_m - dx, place.y_m - dy);
  if (!left || !right) return std::nullopt;
  return std::max(*left, *right);
}

std::optional<double> Clearance::floor_below(double x_m, double y_m) {
  const mjtNum from[3] = {x_m, y_m, kHighestFloorM}, down[3] = {0, 0, -1};
  const double distance_m = cast_ray(*drive_.probe, *data_, from, down, kFirstGroup);
  const double floor_m = kHighestFloorM - distance_m;
  if (distance_m < 0.0 || floor_m < kLowestFloorM) return std::nullopt;
  return floor_m;
}

}  // namespace mapscore::sim
