// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#pragma once

#include "sim/robot/drive_model.hpp"
#include "sim/robot/waypoint_controller.hpp"

#include <mujoco/mujoco.h>

#include <optional>
#include <string>

namespace mapscore::sim {

/// Something in the way.
struct Obstacle {
  std::string body;                        ///< of the scene
  double x_m = 0.0, y_m = 0.0, z_m = 0.0;  ///< where it would be touched, in the world
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
  [[nodiscard]] std::optional<Obstacle> obstacle_at(const PlanarState& place, double floor_m = 0.0);

  /// Height of the higher of the floors under the two wheels, looked for within 6 cm above and 4 cm
  /// below z = 0; nothing where a wheel has none.
  [[nodiscard]] std::optional<double> floor_at(const PlanarState& place);

 private:
  std::optional<double> floor_below(double x_m, double y_m);

  const DriveModel& drive_;
  DataPtr data_;
};

}  // namespace mapscore::sim
