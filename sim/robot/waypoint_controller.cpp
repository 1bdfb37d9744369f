// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#include "sim/robot/waypoint_controller.hpp"

#include "core/error.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace mapscore::sim {
namespace {

constexpr double kShortestLegM = 0.02;
constexpr double kBrakingShare = 0.8;      ///< of the acceleration; the rest is for the lag
constexpr double kCreepMps = 0.01;         ///< slowest speed that still moves
constexpr double kCreepRadps = 0.02;       ///< slowest turn that still moves
constexpr double kStoppedRadps = 0.05;     ///< a turn has ended
constexpr double kSteepestApproach = 0.6;  ///< rad, towards a leg that the robot is off

void check(const ControllerParams& p) {
  const std::pair<double, const char*> all[] = {{p.speed_mps, "speed_mps"},
                                                {p.turn_rate_radps, "turn_rate"},
                                                {p.acceleration_mps2, "acceleration_mps2"},
                                                {p.turn_acceleration_radps2, "turn_acceleration"},
                                                {p.lookahead_m, "lookahead_m"},
                                                {p.heading_gain_per_s, "heading_gain_per_s"},
                                                {p.position_tolerance_m, "position_tolerance_m"},
                                                {p.yaw_tolerance_rad, "yaw_tolerance"},
                                                {p.arrival_tolerance_m, "arrival_tolerance_m"}};
  for (const auto& [value, name] : all)
    if (!(value > 0) || !std::isfinite(value))
      throw Error(fmt::format("drive: {} must be above 0", name));
}

/// Fastest rate from which `error` can still be braked out.
double braking_rate(double error, double limit, double acceleration, double creep) {
  const double rate = std::sqrt(2.0 * kBrakingShare * acceleration * std::abs(error));
  return std::copysign(std::clamp(rate, creep, std::max(creep, limit)), error);
}

}  // namespace

WaypointController::WaypointController(std::vector<Drive::Waypoint> waypoints,
                                       const ControllerParams& params)
    : waypoints_(std::move(waypoints)), params_(params) {
  check(params);
  start_leg(1);
}

void WaypointController::start_leg(std::size_t target) {
  target_ = target;
  if (!done()) face_target(waypoints_[target - 1].x_m, waypoints_[target - 1].y_m);
}

void WaypointController::face_target(double x_m, double y_m) {
  const double dx = waypoints_[target_].x_m - x_m, dy = waypoints_[target_].y_m - y_m;
  phase_ = std::hypot(dx, dy) < kShortestLegM ? Phase::align : Phase::face;
  leg_yaw_rad_ = std::atan2(dy, dx);
}

bool WaypointController::at_target(const PlanarPose& robot) const {
  const Drive::Waypoint& to = waypoints_[target_];
  return std::hypot(to.x_m - robot.x_m, to.y_m - robot.y_m) <= params_.arrival_tolerance_m;
}

double WaypointController::turn_towards(double yaw_rad, const PlanarPose& robot) {
  const double error = wrapped_angle(yaw_rad - robot.yaw_rad);
  if (std::abs(error) > params_.yaw_tolerance_rad || std::abs(command_.omega_radps) > kStoppedRadps)
    return braking_rate(error, params_.turn_rate_radps, params_.turn_acceleration_radps2,
                        kCreepRadps);
  if (phase_ == Phase::face) {
    phase_ = Phase::follow;
  } else if (at_target(robot)) {
    start_leg(target_ + 1);
  } else {
    face_target(robot.x_m, robot.y_m);
  }
  return 0.0;
}

VelocityCommand WaypointController::follow(const PlanarPose& robot) {
  const Drive::Waypoint& to = waypoints_[target_];
  const double c = std::cos(leg_yaw_rad_), s = std::sin(leg_yaw_rad_);
  const double dx = to.x_m - robot.x_m, dy = to.y_m - robot.y_m;
  const double left_m = dx * c + dy * s, offset_m = dx * s - dy * c;
  if (left_m < params_.position_tolerance_m) {
    if (std::abs(command_.v_mps) > kCreepMps) return {};
    phase_ = Phase::align;
    if (!at_target(robot)) face_target(robot.x_m, robot.y_m);
    return {};
  }
  const double approach =
      std::clamp(std::atan(offset_m / params_.lookahead_m), -kSteepestApproach, kSteepestApproach);
  const double omega =
      params_.heading_gain_per_s * wrapped_angle(leg_yaw_rad_ - approach - robot.yaw_rad);
  return {braking_rate(left_m, params_.speed_mps, params_.acceleration_mps2, kCreepMps),
          std::clamp(omega, -params_.turn_rate_radps, params_.turn_rate_radps)};
}

VelocityCommand WaypointController::wanted(const PlanarPose& robot) {
  if (done()) return {};
  if (phase_ == Phase::face) return {0.0, turn_towards(leg_yaw_rad_, robot)};
  if (phase_ == Phase::follow) return follow(robot);
  return {0.0, turn_towards(waypoints_[target_].yaw_rad, robot)};
}

VelocityCommand WaypointController::slewed(const VelocityCommand& wanted, double step_s) {
  const double dv = params_.acceleration_mps2 * step_s;
  const double dw = params_.turn_acceleration_radps2 * step_s;
  command_.v_mps += std::clamp(wanted.v_mps - command_.v_mps, -dv, dv);
  command_.omega_radps += std::clamp(wanted.omega_radps - command_.omega_radps, -dw, dw);
  return command_;
}

}  // namespace mapscore::sim
