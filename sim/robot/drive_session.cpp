// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#include "sim/robot/drive_session.hpp"

#include "core/error.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace mapscore::sim {
namespace {

constexpr double kReactionS = 0.1;  ///< from a command to the wheels' speed
constexpr double kStuckS = 4.0;     ///< without getting anywhere
constexpr double kStuckM = 0.005, kStuckRad = 0.01;
constexpr double kPatience = 5.0;  ///< times the time that a waypoint should take
constexpr double kBackMps = 0.1, kTurningRoomM = 0.03;
constexpr double kGrazeM = 0.004;     ///< how far tyres and tilt may lower the bumper
constexpr double kNoDeeperM = 0.001;  ///< counts as no nearer

int share_of(double hz, double of_hz, const char* name) {
  const double share = of_hz / hz;
  const double whole = std::round(share);
  if (!(hz > 0) || !(whole >= 1) || std::abs(share - whole) > 1e-9)
    throw Error(fmt::format("drive: {} {} must be {} divided by a whole number", name, hz, of_hz));
  return static_cast<int>(whole);
}

void check(const DriveSettings& settings) {
  if (!(settings.clearance_m >= 0) || !(settings.clearance_m < 1))
    throw Error("drive: clearance_m must lie between 0 and 1");
  for (const double error : {settings.radius_error, settings.track_error})
    if (!(error > -1) || !std::isfinite(error))
      throw Error("drive: errors of the believed wheels must be above -1");
}

WheelGeometry believed(const WheelGeometry& wheels, const DriveSettings& settings) {
  check(settings);
  return {wheels.radius_m * (1.0 + settings.radius_error),
          wheels.track_m * (1.0 + settings.track_error)};
}

double turn_between(double from_rad, double to_rad) {
  return std::abs(wrapped_angle(to_rad - from_rad));
}

}  // namespace

DriveSession::DriveSession(const DriveModel& model, const PlanarPose& start,
                           const DriveSettings& settings)
    : settings_(settings),
      clearance_(model),
      odometry_(believed(model.wheels, settings), settings.encoder_ticks_per_turn),
      physics_(model) {
  steps_ = share_of(settings.control_hz, 1.0 / physics_.step_s(), "control_hz");
  controls_ = share_of(settings.log_hz, settings.control_hz, "log_hz");
  physics_.settle(start, clearance_.floor_at(start).value_or(0.0));
  place_ = physics_.planar();
  log_sample();
}

void DriveSession::follow(std::vector<Drive::Waypoint> way) {
  way_ = std::move(way);
  controller_.emplace(way_, settings_.controller);
  patience_ = {};
  obstacle_.reset();
  log_.arrivals.clear();
  arrive(0);
}

WayState DriveSession::step() {
  if (!controller_ || controller_->done()) return WayState::arrived;
  const std::size_t target = controller_->target();
  advance(controller_->command(physics_.planar(), control_s()));
  if (blocked_ahead()) {
    brake();
    return WayState::blocked;
  }
  if (controller_->target() != target) arrive(target);
  log_.end_s = physics_.time_s();
  if (controller_->done()) return WayState::arrived;
  return lost_patience() ? WayState::stuck : WayState::driving;
}

void DriveSession::brake() {
  const double limit_s = physics_.time_s() + kStuckS;
  while (physics_.time_s() < limit_s && (command_.v_mps != 0.0 || command_.omega_radps != 0.0))
    advance(controller_->brake(control_s()));
}

void DriveSession::back_off(double most_m) {
  if (!controller_) return;
  brake();
  const double sign = away_from_obstacle();
  const PlanarPose from = place_;
  const double limit_s = physics_.time_s() + kStuckS + most_m / kBackMps;
  const auto gone_m = [&] { return std::hypot(place_.x_m - from.x_m, place_.y_m - from.y_m); };
  const auto ahead = [&](double way_m) {
    return PlanarPose{place_.x_m + sign * way_m * std::cos(place_.yaw_rad),
                      place_.y_m + sign * way_m * std::sin(place_.yaw_rad), place_.yaw_rad};
  };
  double clear_m = 0.0;  // driven since there was room
  while (gone_m() < most_m && clear_m < kTurningRoomM && physics_.time_s() < limit_s) {
    const bool was_blocked = blocked_at(place_);
    const double depth_m = obstacle_ ? obstacle_->depth_m : 0.0;
    if (was_blocked ? deeper_at(ahead(kTurningRoomM), depth_m)
                    : blocked_at(ahead(2.0 * kTurningRoomM)))
      break;
    const double before_m = gone_m();
    advance({sign * kBackMps, 0.0});
    if (!was_blocked) clear_m += gone_m() - before_m;
  }
  brake();
  leaving_depth_m_ = blocked_at(place_) && obstacle_ ? obstacle_->depth_m : 0.0;
}

/// 1: straight on, away from what is behind the axle; -1: back.
double DriveSession::away_from_obstacle() {
  std::optional<Obstacle> nearest = obstacle_;
  if (blocked_at(place_) && obstacle_) nearest = obstacle_;
  if (!nearest) return -1.0;
  const double ahead_m = (nearest->x_m - place_.x_m) * std::cos(place_.yaw_rad) +
                         (nearest->y_m - place_.y_m) * std::sin(place_.yaw_rad);
  return ahead_m < 0.0 ? 1.0 : -1.0;
}

void DriveSession::rest_until(double time_s) {
  while (physics_.time_s() < time_s)
    advance(controller_ ? controller_->brake(control_s()) : VelocityCommand{});
}

DriveLog DriveSession::take_log() {
  log_.health = physics_.health();
  return std::move(log_);
}

void DriveSession::advance(const VelocityCommand& command) {
  command_ = command;
  physics_.command(command, steps_);
  for (int i = 0; i < steps_; ++i) physics_.step();
  const PlanarPose before = place_;
  place_ = physics_.planar();
  log_.distance_m += std::hypot(place_.x_m - before.x_m, place_.y_m - before.y_m);
  if (++control_ % controls_ == 0) log_sample();
}

void DriveSession::log_sample() {
  const WheelTicks ticks = physics_.ticks(settings_.encoder_ticks_per_turn);
  odometry_.update(ticks);
  const double stamp_s = static_cast<double>(log_.samples.size()) / settings_.log_hz;
  log_.samples.push_back(
      {stamp_s, physics_.T_world_base(), ticks, odometry_.T_odom_base(), command_});
}

void DriveSession::arrive(std::size_t waypoint) {
  const Drive::Waypoint& w = way_[waypoint];
  log_.arrivals.push_back({waypoint, physics_.time_s(),
                           std::hypot(place_.x_m - w.x_m, place_.y_m - w.y_m),
                           turn_between(w.yaw_rad, place_.yaw_rad)});
}

/// Whether the robot would touch something, or lose its floor, if it braked now.
bool DriveSession::blocked_ahead() {
  const double v = command_.v_mps, w = command_.omega_radps;
  const ControllerParams& limits = settings_.controller;
  const double way_m = v * kReactionS + 0.5 * v * std::abs(v) / limits.acceleration_mps2;
  const double turn = w * kReactionS + 0.5 * w * std::abs(w) / limits.turn_acceleration_radps2;
  const double yaw = place_.yaw_rad + 0.5 * turn;
  const PlanarPose braked{place_.x_m + way_m * std::cos(yaw), place_.y_m + way_m * std::sin(yaw),
                          place_.yaw_rad + turn};
  if (leaving_depth_m_ > 0.0) {
    const bool near = blocked_at(place_) && obstacle_;
    leaving_depth_m_ = near ? std::min(leaving_depth_m_, obstacle_->depth_m) : 0.0;
  }
  if (leaving_depth_m_ > 0.0) return deeper_at(braked, leaving_depth_m_) || edge_at(braked);
  return blocked_at(braked);
}

bool DriveSession::blocked_at(const PlanarPose& place) {
  obstacle_ = obstacle_at(place);
  return obstacle_ || edge_at(place);
}

/// Of a robot that chooses its way what its bumper would only graze from above, such as the foot of
/// a lamp, is in the way too.
std::optional<Obstacle> DriveSession::obstacle_at(const PlanarPose& place) {
  const double floor_m = physics_.T_world_base().translation().z();
  return clearance_.obstacle_at(place, minds_edges_ ? floor_m - kGrazeM : floor_m);
}

/// Whether something would reach more than `depth_m` into the robot.
bool DriveSession::deeper_at(const PlanarPose& place, double depth_m) {
  obstacle_ = obstacle_at(place);
  return obstacle_ && obstacle_->depth_m > depth_m + kNoDeeperM;
}

bool DriveSession::edge_at(const PlanarPose& place) {
  return minds_edges_ && clearance_.ends_at(place);
}

bool DriveSession::lost_patience() {
  const std::size_t target = controller_->target();
  const double time_s = physics_.time_s();
  Patience& p = patience_;
  if (target != p.target) {
    const Drive::Waypoint &from = way_[target - 1], &to = way_[target];
    const double way_s =
        std::hypot(to.x_m - from.x_m, to.y_m - from.y_m) / settings_.controller.speed_mps;
    const double turns_s = 4.0 * M_PI / settings_.controller.turn_rate_radps;
    p.limit_s = time_s + kPatience * (kStuckS + way_s + turns_s);
    p.target = target;
    p.last_s = time_s;
  }
  const bool moved = std::hypot(place_.x_m - p.last.x_m, place_.y_m - p.last.y_m) > kStuckM ||
                     turn_between(p.last.yaw_rad, place_.yaw_rad) > kStuckRad;
  if (moved) {
    p.last = place_;
    p.last_s = time_s;
  }
  return time_s - p.last_s > kStuckS || time_s > p.limit_s;
}

}  // namespace mapscore::sim
