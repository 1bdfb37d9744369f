// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#pragma once

#include "sim/recorder/recorded_drive.hpp"
#include "sim/robot/drive_model.hpp"

#include <mujoco/mujoco.h>

#include <optional>
#include <string>
#include <vector>

namespace mapscore::sim {

/// Of an ideal edge sensor, before and behind the axle, beyond the casters.
inline constexpr double kEdgeSensorM = 0.2;

/// Something in the way.
struct Obstacle {
  std::string body;                        ///< of the scene
  double x_m = 0.0, y_m = 0.0, z_m = 0.0;  ///< where it would be touched, in the world
  double depth_m = 0.0;  ///< how far it reaches into the robot, clearance included
};

/// The scene's side of a contact with the robot.
[[nodiscard]] Obstacle obstacle_of(const DriveModel& drive, const mjContact& contact);

/// Where the robot can stand: its bumper, mast and head, wider by the clearance, against the
/// scene's geoms, and the floor under its wheels. An ideal proximity sensor: it knows exact shapes,
/// table tops above the lidar's plane too. Not thread-safe; make one where it is used.
class Clearance {
 public:
  explicit Clearance(const DriveModel& drive);

  /// The deepest obstacle of the robot that stands upright at a place on the floor z = `floor_m`.
  [[nodiscard]] std::optional<Obstacle> obstacle_at(const PlanarPose& place, double floor_m = 0.0);

  /// Height of the higher of the floors under the two wheels, looked for within 6 cm above and 4 cm
  /// below z = 0; nothing where a wheel has none.
  [[nodiscard]] std::optional<double> floor_at(const PlanarPose& place);

  /// Whether there is no floor kEdgeSensorM before or behind the axle.
  [[nodiscard]] bool ends_at(const PlanarPose& place);

 private:
  std::optional<double> floor_below(double x_m, double y_m);

  const DriveModel& drive_;
  DataPtr data_;
};

/// `waypoint 3 (2.100, 1.500 m)`, counted from 1.
[[nodiscard]] std::string waypoint_text(const std::vector<Drive::Waypoint>& waypoints,
                                        std::size_t index);

/// Throws Error when the robot would stand in something at a waypoint, or has no floor there, or
/// when something stands in the way of a straight leg, sampled every 2 cm. `start_only`: looks at
/// the first waypoint alone.
void check_way(const std::vector<Drive::Waypoint>& waypoints, bool start_only,
               Clearance& clearance);

/// The Error of a leg that something blocks, seen from where the robot then is. `target`: the
/// waypoint it leads to.
[[noreturn]] void refuse_blocked(const std::vector<Drive::Waypoint>& waypoints, std::size_t target,
                                 const Obstacle& obstacle, const char* what);

}  // namespace mapscore::sim
