// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#pragma once

#include "sim/recorder/recorded_drive.hpp"

#include <cstddef>
#include <vector>

namespace mapscore::sim {

/// Command to a differential drive: forwards and counter-clockwise positive.
struct VelocityCommand {
  double v_mps = 0.0, omega_radps = 0.0;
};

/// Limits and gains of the controller. Tolerances are where it takes a target for reached.
struct ControllerParams {
  double speed_mps = 0.4, turn_rate_radps = 0.7;
  double acceleration_mps2 = 0.5, turn_acceleration_radps2 = 1.5;
  double lookahead_m = 0.3;  ///< an offset e from the leg is steered against by atan(e / lookahead)
  double heading_gain_per_s = 3.0;
  double position_tolerance_m = 0.003, yaw_tolerance_rad = 0.003;
  double arrival_tolerance_m = 0.04;  ///< farther off a waypoint it is driven to once more
};

/// Drives from waypoint to waypoint: turn on the spot to face the next one, follow the straight leg
/// to it, turn on the spot to its heading. Legs shorter than 2 cm are turned through, not driven.
/// A robot that slipped or was pushed off sets out anew from where it is.
///
///   speed on a leg      min(speed, sqrt(2 b s)), s the way left, b = 0.8 acceleration
///   turn on a leg       gain * (leg's heading - atan(e / lookahead) - yaw), e the left offset
///   turn on the spot    min(turn rate, sqrt(2 b |error|)), the short way, b likewise
///
/// Commands change at most as fast as the accelerations allow.
///
/// Planar poses are those of base_footprint in the world.
class WaypointController {
 public:
  /// The robot stands at the first waypoint. Throws Error when a parameter is not above 0.
  WaypointController(std::vector<Drive::Waypoint> waypoints, const ControllerParams& params);

  /// The next command, `step_s` after the last one.
  [[nodiscard]] VelocityCommand command(const PlanarPose& robot, double step_s) {
    return slewed(wanted(robot), step_s);
  }
  /// Slows down to a stop whatever the waypoints say.
  [[nodiscard]] VelocityCommand brake(double step_s) { return slewed({}, step_s); }

  [[nodiscard]] bool done() const { return target_ >= waypoints_.size(); }
  /// Index of the waypoint that is driven to; those below are reached.
  [[nodiscard]] std::size_t target() const { return target_; }

 private:
  enum class Phase { face, follow, align };

  VelocityCommand wanted(const PlanarPose& robot);
  double turn_towards(double yaw_rad, const PlanarPose& robot);
  VelocityCommand follow(const PlanarPose& robot);
  VelocityCommand slewed(const VelocityCommand& wanted, double step_s);
  void start_leg(std::size_t target);
  void face_target(double x_m, double y_m);
  bool at_target(const PlanarPose& robot) const;

  std::vector<Drive::Waypoint> waypoints_;
  ControllerParams params_;
  std::size_t target_ = 0;
  Phase phase_ = Phase::face;
  double leg_yaw_rad_ = 0.0;
  VelocityCommand command_;
};

}  // namespace mapscore::sim
