// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#include "sim/robot/way_check.hpp"

#include "core/error.hpp"
#include "sim/recorder/recorded_drive.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace mapscore::sim {
namespace {

constexpr double kStepM = 0.02;

void check_waypoint(const std::vector<Drive::Waypoint>& waypoints, std::size_t index,
                    Clearance& clearance) {
  const Drive::Waypoint& w = waypoints[index];
  const PlanarState place{w.x_m, w.y_m, w.yaw_rad};
  if (const auto obstacle = clearance.obstacle_at(place))
    throw Error(fmt::format(
        "trajectory: {}{}: the robot would stand in `{}`; move the waypoint away from it",
        waypoint_text(waypoints, index), index == 0 ? ", the start" : "", obstacle->body));
  if (!clearance.floor_at(place))
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
    const PlanarState place{from.x_m + share * dx, from.y_m + share * dy, std::atan2(dy, dx)};
    if (const auto obstacle = clearance.obstacle_at(place))
      refuse_blocked(waypoints, target, *obstacle, "stands in the way");
  }
}

}  // namespace

std::string waypoint_text(const std::vector<Drive::Waypoint>& waypoints, std::size_t index) {
  return fmt::format("waypoint {} ({:.3f}, {:.3f} m)", index + 1, waypoints[index].x_m,
                     waypoints[index].y_m);
}

void check_waypoints(const std::vector<Drive::Waypoint>& waypoints, bool start_only,
                     Clearance& clearance) {
  const std::size_t count = start_only ? 1 : waypoints.size();
  for (std::size_t i = 0; i < count; ++i) check_waypoint(waypoints, i, clearance);
}

void check_legs(const std::vector<Drive::Waypoint>& waypoints, Clearance& clearance) {
  for (std::size_t target = 1; target < waypoints.size(); ++target)
    check_leg(waypoints, target, clearance);
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
