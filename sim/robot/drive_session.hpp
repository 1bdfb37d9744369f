// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#pragma once

#include "sim/recorder/recorded_drive.hpp"
#include "sim/robot/clearance.hpp"
#include "sim/robot/drive_physics.hpp"
#include "sim/robot/odometry.hpp"
#include "sim/robot/waypoint_controller.hpp"

#include <cstddef>
#include <optional>
#include <vector>

namespace mapscore::sim {

/// How a drive is simulated. Speed and turn rate of the controller are those of the Drive.
struct DriveSettings {
  ControllerParams controller;
  double control_hz = 50.0;  ///< of commands; a whole share of 500, the physics' rate
  double log_hz = 50.0;      ///< of samples and of the odometry; a whole share of control_hz
  int encoder_ticks_per_turn = 4096;
  /// Of the wheels that the odometry believes, as shares of the true radius and track; above -1.
  double radius_error = 0.0, track_error = 0.0;
  double clearance_m = 0.02;    ///< kept between bumper and furniture
  bool check_way_first = true;  ///< look for obstacles along all legs before driving
};

/// State at one instant of a drive.
struct DriveSample {
  double stamp_s = 0.0;                  ///< from 0, settled on the floor
  Pose T_world_base = Pose::Identity();  ///< base_footprint, with the tilt that physics gave it
  WheelTicks ticks;
  Pose T_odom_base = Pose::Identity();  ///< odom: base_footprint at stamp 0
  VelocityCommand command;
};

/// When and how well a waypoint was reached; waypoint 0 is the start.
struct WaypointArrival {
  std::size_t waypoint = 0;
  double stamp_s = 0.0, position_error_m = 0.0, yaw_error_rad = 0.0;
};

struct DriveLog {
  std::vector<DriveSample> samples;  ///< at i / log_hz
  std::vector<WaypointArrival> arrivals;
  DriveHealth health;
  double distance_m = 0.0;  ///< driven, of the true base
  double end_s = 0.0;       ///< when the last waypoint was reached
};

/// How far a way was driven.
enum class WayState {
  driving,
  arrived,
  blocked,  ///< something would be touched, or there is no floor; the robot has stopped before it
  stuck     ///< the wheels turn and nothing moves, or it takes far too long
};

/// A drive on wheels that goes on: way after way, each from where the robot stands, in one log.
/// The controller is fed with the true pose. No random numbers. Used by one thread at a time;
/// `model` must outlive it.
class DriveSession {
 public:
  /// Stands the robot at `start` and lets it settle. Throws Error where a setting is out of range;
  /// whether the robot can stand there is for check_way to say.
  DriveSession(const DriveModel& model, const PlanarPose& start, const DriveSettings& settings);
  DriveSession(const DriveSession&) = delete;
  DriveSession& operator=(const DriveSession&) = delete;

  /// Gives a further way; its first waypoint is where the robot stands, or should.
  void follow(std::vector<Drive::Waypoint> way);
  /// Drives on for one command (1 / control_hz). An ideal proximity sensor, Clearance, stops the
  /// robot before what it would touch; it then stands, and the way has ended. Throws Error when the
  /// robot tips over, falls, or its state is not finite.
  WayState step();
  /// After `blocked` or `stuck`: drives straight away from what is in the way, forwards where that
  /// is behind the axle, until it has room to turn, at most `most_m`, and not deeper into anything.
  /// For ways that go on elsewhere. A robot that is still too near to something may then leave it:
  /// until it has, only what would bring it nearer blocks.
  void back_off(double most_m);
  /// Brakes, and stands until a time of the drive.
  void rest_until(double time_s);

  /// From now on a way blocks where the floor ends, within 0.2 m before or behind the axle, and
  /// before what lies less than 4 mm below the bumper.
  void mind_edges() { minds_edges_ = true; }

  [[nodiscard]] double time_s() const { return physics_.time_s(); }
  [[nodiscard]] const PlanarPose& place() const { return place_; }
  /// Index in the way of the waypoint that is driven to.
  [[nodiscard]] std::size_t target() const { return controller_ ? controller_->target() : 0; }
  [[nodiscard]] const std::vector<Drive::Waypoint>& way() const { return way_; }
  /// What blocks the way, after `blocked`; none where the floor ends.
  [[nodiscard]] const std::optional<Obstacle>& obstacle() const { return obstacle_; }
  /// What the robot touches from the side.
  [[nodiscard]] std::optional<Obstacle> touched() const { return physics_.touched(); }
  [[nodiscard]] const DriveHealth& health() const { return physics_.health(); }
  /// Samples up to now; arrivals are those of the present way.
  [[nodiscard]] const DriveLog& log() const { return log_; }
  /// The log, with health, moved out at the end.
  [[nodiscard]] DriveLog take_log();

 private:
  /// Notices when a robot that should move does not, or takes far too long for a waypoint.
  struct Patience {
    std::size_t target = 0;
    PlanarPose last;
    double last_s = 0.0, limit_s = 0.0;
  };

  [[nodiscard]] double control_s() const { return steps_ * physics_.step_s(); }
  void advance(const VelocityCommand& command);
  void brake();
  void log_sample();
  void arrive(std::size_t waypoint);
  [[nodiscard]] double away_from_obstacle();
  [[nodiscard]] bool blocked_ahead();
  [[nodiscard]] std::optional<Obstacle> obstacle_at(const PlanarPose& place);
  [[nodiscard]] bool deeper_at(const PlanarPose& place, double depth_m);
  [[nodiscard]] bool edge_at(const PlanarPose& place);
  [[nodiscard]] bool blocked_at(const PlanarPose& place);
  [[nodiscard]] bool lost_patience();

  DriveSettings settings_;
  Clearance clearance_;
  std::optional<WaypointController> controller_;
  Odometry odometry_;
  DrivePhysics physics_;
  std::vector<Drive::Waypoint> way_;
  Patience patience_;
  int steps_ = 1, controls_ = 1, control_ = 0;
  bool minds_edges_ = false;
  double leaving_depth_m_ = 0.0;  ///< of the obstacle that a robot is leaving; 0: of none
  PlanarPose place_;
  VelocityCommand command_;
  std::optional<Obstacle> obstacle_;
  DriveLog log_;
};

}  // namespace mapscore::sim
