// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#include "sim/robot/clearance.hpp"

#include "core/error.hpp"
#include "sim/sensors/ray_cast.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace mapscore::sim {
namespace {

constexpr double kHighestFloorM = 0.06, kLowestFloorM = -0.04;
constexpr double kStepM = 0.02;  ///< along a leg

void check_waypoint(const std::vector<Drive::Waypoint>& waypoints, std::size_t index,
                    Clearance& clearance) {
  if (const auto obstacle = clearance.obstacle_at(waypoints[index]))
    throw Error(fmt::format(
        "trajectory: {}{}: the robot would stand in `{}`; move the waypoint away from it",
        waypoint_text(waypoints, index), index == 0 ? ", the start" : "", obstacle->body));
  if (!clearance.floor_at(waypoints[index]))
    throw Error(
        fmt::format("trajectory: {}: no floor near z = 0 under the wheels; move the "
                    "waypoint onto the floor",
                    waypoint_text(waypoints, index)));
}

void check_leg(const std::vector<Drive::Waypoint>& waypoints, std::size_t target,
               Clearance& clearance) {
  const Drive::Waypoint &from = waypoints[target - 1], &to = waypoints[target];
  const double dx = to.x_m - from.x_m, dy = to.y_m - from.y_m;
  const int steps = static_cast<int>(std::ceil(std::hypot(dx, dy) / kStepM));
  for (int step = 1; step < steps; ++step) {
    const double share = static_cast<double>(step) / steps;
    const PlanarPose place{from.x_m + share * dx, from.y_m + share * dy, std::atan2(dy, dx)};
    if (const auto obstacle = clearance.obstacle_at(place))
      refuse_blocked(waypoints, target, *obstacle, "stands in the way");
  }
}

}  // namespace

Obstacle obstacle_of(const DriveModel& drive, const mjContact& contact) {
  const bool first = drive.role[contact.geom[0]] == GeomRole::scene;
  return {drive.scene_body[contact.geom[first ? 0 : 1]], contact.pos[0], contact.pos[1],
          contact.pos[2], -contact.dist};
}

Clearance::Clearance(const DriveModel& drive)
    : drive_(drive), data_(mj_makeData(drive.probe.get())) {
  mj_kinematics(drive.probe.get(), data_.get());  // places the scene's geoms, once for all
}

std::optional<Obstacle> Clearance::obstacle_at(const PlanarPose& place, double floor_m) {
  const mjModel& model = *drive_.probe;
  stand_upright(drive_, place, floor_m, *data_);
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

std::optional<double> Clearance::floor_at(const PlanarPose& place) {
  const double reach_m = 0.5 * drive_.wheels.track_m;
  const double dx = -std::sin(place.yaw_rad) * reach_m, dy = std::cos(place.yaw_rad) * reach_m;
  const auto left = floor_below(place.x_m + dx, place.y_m + dy);
  const auto right = floor_below(place.x_m - dx, place.y_m - dy);
  if (!left || !right) return std::nullopt;
  return std::max(*left, *right);
}

bool Clearance::ends_at(const PlanarPose& place) {
  const double dx = kEdgeSensorM * std::cos(place.yaw_rad);
  const double dy = kEdgeSensorM * std::sin(place.yaw_rad);
  return !floor_at({place.x_m + dx, place.y_m + dy, place.yaw_rad}) ||
         !floor_at({place.x_m - dx, place.y_m - dy, place.yaw_rad});
}

std::optional<double> Clearance::floor_below(double x_m, double y_m) {
  const mjtNum from[3] = {x_m, y_m, kHighestFloorM}, down[3] = {0, 0, -1};
  const double distance_m = cast_ray(*drive_.probe, *data_, from, down);
  const double floor_m = kHighestFloorM - distance_m;
  if (distance_m < 0.0 || floor_m < kLowestFloorM) return std::nullopt;
  return floor_m;
}

std::string waypoint_text(const std::vector<Drive::Waypoint>& waypoints, std::size_t index) {
  return fmt::format("waypoint {} ({:.3f}, {:.3f} m)", index + 1, waypoints[index].x_m,
                     waypoints[index].y_m);
}

void check_way(const std::vector<Drive::Waypoint>& waypoints, bool start_only,
               Clearance& clearance) {
  const std::size_t count = start_only ? 1 : waypoints.size();
  for (std::size_t i = 0; i < count; ++i) check_waypoint(waypoints, i, clearance);
  for (std::size_t target = 1; target < count; ++target) check_leg(waypoints, target, clearance);
}

void refuse_blocked(const std::vector<Drive::Waypoint>& waypoints, std::size_t target,
                    const Obstacle& obstacle, const char* what) {
  throw Error(fmt::format(
      "trajectory: {} cannot be reached: `{}` {} at ({:.2f}, {:.2f}, {:.2f} m); move the waypoint "
      "or add one that leads around it",
      waypoint_text(waypoints, target), obstacle.body, what, obstacle.x_m, obstacle.y_m,
      obstacle.z_m));
}

}  // namespace mapscore::sim
