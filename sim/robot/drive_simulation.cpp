// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#include "sim/robot/drive_simulation.hpp"

#include "core/error.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace mapscore::sim {
namespace {

constexpr double kRestS = 0.2;      ///< logged after the last waypoint
constexpr double kReactionS = 0.1;  ///< from a command to the wheels' speed
constexpr double kStuckS = 4.0;     ///< without getting anywhere
constexpr double kStuckM = 0.005, kStuckRad = 0.01;
constexpr double kLongestStandS = 4 * 3600.0;
constexpr double kMostPoses = 1e7;  ///< more than any recording could hold
constexpr double kPatience = 5.0;   ///< times the time that a waypoint should take

int share_of(double hz, double of_hz, const char* name) {
  const double share = of_hz / hz;
  const double whole = std::round(share);
  if (!(hz > 0) || !(whole >= 1) || std::abs(share - whole) > 1e-9)
    throw Error(fmt::format("drive: {} {} must be {} divided by a whole number", name, hz, of_hz));
  return static_cast<int>(whole);
}

void check(const Drive& drive, const DriveSettings& settings) {
  if (drive.waypoints.empty()) throw Error("trajectory: no waypoints; give at least one");
  for (const Drive::Waypoint& w : drive.waypoints)
    if (!std::isfinite(w.x_m) || !std::isfinite(w.y_m) || !std::isfinite(w.yaw_rad))
      throw Error("trajectory: waypoints must be finite numbers");
  if (!(settings.clearance_m >= 0) || !(settings.clearance_m < 1))
    throw Error("drive: clearance_m must lie between 0 and 1");
  for (const double error : {settings.radius_error, settings.track_error})
    if (!(error > -1) || !std::isfinite(error))
      throw Error("drive: errors of the believed wheels must be above -1");
  if (!(drive.until_s <= kLongestStandS))
    throw Error(fmt::format("drive: stands until {} s; a drive on wheels lasts {} s at most",
                            drive.until_s, kLongestStandS));
}

ControllerParams params_of(const Drive& drive, const DriveSettings& settings) {
  ControllerParams params = settings.controller;
  params.speed_mps = drive.speed_mps;
  params.turn_rate_radps = drive.turn_rate_radps;
  return params;
}

WheelGeometry believed(const WheelGeometry& wheels, const DriveSettings& settings) {
  return {wheels.radius_m * (1.0 + settings.radius_error),
          wheels.track_m * (1.0 + settings.track_error)};
}

double turn_between(double from_rad, double to_rad) {
  return std::abs(wrapped_angle(to_rad - from_rad));
}

/// Notices when a robot that should move does not, or takes far too long for a waypoint.
class Patience {
 public:
  Patience(const std::vector<Drive::Waypoint>& waypoints, const ControllerParams& params)
      : waypoints_(waypoints), params_(params) {}

  /// True when it is time to give up.
  bool lost(double time_s, std::size_t target, const PlanarPose& robot) {
    if (target != target_) start(time_s, target);
    const bool moved = std::hypot(robot.x_m - last_.x_m, robot.y_m - last_.y_m) > kStuckM ||
                       turn_between(last_.yaw_rad, robot.yaw_rad) > kStuckRad;
    if (moved) {
      last_ = robot;
      last_s_ = time_s;
    }
    return time_s - last_s_ > kStuckS || time_s > limit_s_;
  }

 private:
  void start(double time_s, std::size_t target) {
    const Drive::Waypoint &from = waypoints_[target - 1], &to = waypoints_[target];
    const double way_s = std::hypot(to.x_m - from.x_m, to.y_m - from.y_m) / params_.speed_mps;
    limit_s_ = time_s + kPatience * (kStuckS + way_s + 4.0 * M_PI / params_.turn_rate_radps);
    target_ = target;
    last_s_ = time_s;
  }

  const std::vector<Drive::Waypoint>& waypoints_;
  const ControllerParams& params_;
  std::size_t target_ = 0;
  PlanarPose last_;
  double last_s_ = 0.0, limit_s_ = 0.0;
};

/// One drive from start to end: controller, physics, odometry and log, in step.
class DriveRun {
 public:
  DriveRun(const DriveModel& model, const Drive& drive, const DriveSettings& settings,
           const std::function<void(std::size_t, std::size_t)>& progress)
      : waypoints_(drive.waypoints),
        settings_(settings),
        params_(params_of(drive, settings)),
        clearance_(model),
        controller_(drive.waypoints, params_),
        odometry_(believed(model.wheels, settings), settings.encoder_ticks_per_turn),
        physics_(model),
        patience_(waypoints_, params_),
        until_s_(drive.until_s),
        progress_(progress) {
    steps_ = share_of(settings.control_hz, 1.0 / physics_.step_s(), "control_hz");
    controls_ = share_of(settings.log_hz, settings.control_hz, "log_hz");
  }

  DriveLog run() {
    stand_at_start();
    while (!controller_.done()) {
      const std::size_t target = controller_.target();
      advance(controller_.command(physics_.planar(), control_s()));
      if (const auto obstacle = ahead()) stop_before(*obstacle);
      if (controller_.target() != target) arrive(target);
      if (!controller_.done() && patience_.lost(physics_.time_s(), controller_.target(), place_))
        give_up();
    }
    log_.end_s = physics_.time_s();
    const double rest_s = std::max(log_.end_s, until_s_) + kRestS;
    while (physics_.time_s() < rest_s) advance(controller_.brake(control_s()));
    log_.health = physics_.health();
    return std::move(log_);
  }

 private:
  double control_s() const { return steps_ * physics_.step_s(); }

  void stand_at_start() {
    check_way(waypoints_, !settings_.check_way_first, clearance_);
    const PlanarPose& start = waypoints_.front();
    physics_.settle(start, clearance_.floor_at(start).value_or(0.0));
    place_ = physics_.planar();
    log_sample();
    arrive(0);
  }

  void advance(const VelocityCommand& command) {
    command_ = command;
    physics_.command(command, steps_);
    for (int i = 0; i < steps_; ++i) physics_.step();
    const PlanarPose before = place_;
    place_ = physics_.planar();
    log_.distance_m += std::hypot(place_.x_m - before.x_m, place_.y_m - before.y_m);
    if (++control_ % controls_ == 0) log_sample();
  }

  void log_sample() {
    const WheelTicks ticks = physics_.ticks(settings_.encoder_ticks_per_turn);
    odometry_.update(ticks);
    const double stamp_s = static_cast<double>(log_.samples.size()) / settings_.log_hz;
    log_.samples.push_back(
        {stamp_s, physics_.T_world_base(), ticks, odometry_.T_odom_base(), command_});
  }

  /// What the robot would touch if it braked now.
  std::optional<Obstacle> ahead() {
    const double v = command_.v_mps, w = command_.omega_radps;
    const double way_m = v * kReactionS + 0.5 * v * std::abs(v) / params_.acceleration_mps2;
    const double turn = w * kReactionS + 0.5 * w * std::abs(w) / params_.turn_acceleration_radps2;
    const double yaw = place_.yaw_rad + 0.5 * turn;
    const PlanarPose stop{place_.x_m + way_m * std::cos(yaw), place_.y_m + way_m * std::sin(yaw),
                          place_.yaw_rad + turn};
    return clearance_.obstacle_at(stop, physics_.T_world_base().translation().z());
  }

  [[noreturn]] void stop_before(const Obstacle& obstacle) {
    const double limit_s = physics_.time_s() + kStuckS;
    while (physics_.time_s() < limit_s && (command_.v_mps != 0.0 || command_.omega_radps != 0.0))
      advance(controller_.brake(control_s()));
    refuse_blocked(waypoints_, controller_.target(), obstacle,
                   physics_.health().bump_contacts == 0 ? "made the robot stop, standing"
                                                        : "was touched, standing");
  }

  [[noreturn]] void give_up() {
    const auto touched = physics_.touched();
    if (touched) refuse_blocked(waypoints_, controller_.target(), *touched, "holds the robot up");
    throw Error(
        fmt::format("trajectory: {} cannot be reached: the robot is stuck at ({:.2f}, {:.2f} m); "
                    "lead it around",
                    waypoint_text(waypoints_, controller_.target()), place_.x_m, place_.y_m));
  }

  void arrive(std::size_t waypoint) {
    const Drive::Waypoint& w = waypoints_[waypoint];
    log_.arrivals.push_back({waypoint, physics_.time_s(),
                             std::hypot(place_.x_m - w.x_m, place_.y_m - w.y_m),
                             turn_between(w.yaw_rad, place_.yaw_rad)});
    if (progress_) progress_(waypoint + 1, waypoints_.size());
  }

  const std::vector<Drive::Waypoint>& waypoints_;
  const DriveSettings& settings_;
  const ControllerParams params_;
  Clearance clearance_;
  WaypointController controller_;
  Odometry odometry_;
  DrivePhysics physics_;
  Patience patience_;
  const double until_s_;
  const std::function<void(std::size_t, std::size_t)>& progress_;
  int steps_ = 1, controls_ = 1, control_ = 0;
  PlanarPose place_;
  VelocityCommand command_;
  DriveLog log_;
};

}  // namespace

DriveLog simulate_drive(const World& world, const std::filesystem::path& robot, const Drive& drive,
                        const DriveSettings& settings,
                        const std::function<void(std::size_t, std::size_t)>& progress) {
  check(drive, settings);
  const DriveModel model = make_drive_model(world, robot, settings.clearance_m);
  return DriveRun(model, drive, settings, progress).run();
}

Pose pose_at(const DriveLog& log, double stamp_s) {
  if (log.samples.empty()) throw Error("drive: an empty log has no poses");
  const auto after = std::lower_bound(
      log.samples.begin(), log.samples.end(), stamp_s,
      [](const DriveSample& sample, double stamp) { return sample.stamp_s < stamp; });
  if (after == log.samples.begin()) return log.samples.front().T_world_base;
  if (after == log.samples.end()) return log.samples.back().T_world_base;
  const DriveSample& before = *std::prev(after);
  const double share = (stamp_s - before.stamp_s) / (after->stamp_s - before.stamp_s);
  const Eigen::Quaterniond from(before.T_world_base.linear()), to(after->T_world_base.linear());
  Pose pose = Pose::Identity();
  pose.linear() = from.slerp(share, to).toRotationMatrix();
  pose.translation() =
      (1.0 - share) * before.T_world_base.translation() + share * after->T_world_base.translation();
  return pose;
}

std::vector<StampedPose> poses_along(const DriveLog& log, double rate_hz, double until_s,
                                     int most) {
  constexpr double kRounding = 1e-9;  // a drive of a whole number of periods keeps its last one
  double count = std::floor(until_s * rate_hz + kRounding) + 1.0;
  if (most > 0) count = std::min(count, static_cast<double>(most));
  if (!(count >= 1.0) || !(count <= kMostPoses))
    throw Error(
        fmt::format("drive: {} poses a second over {:.1f} s are too many to record; lower "
                    "the rate",
                    rate_hz, until_s));
  std::vector<StampedPose> poses(static_cast<std::size_t>(count));
  for (std::size_t i = 0; i < poses.size(); ++i) {
    const double stamp_s = static_cast<double>(i) / rate_hz;
    poses[i] = {stamp_s, pose_at(log, stamp_s)};
  }
  return poses;
}

}  // namespace mapscore::sim
