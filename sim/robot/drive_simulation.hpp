// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#pragma once

#include "sim/recorder/recorded_drive.hpp"
#include "sim/robot/drive_physics.hpp"
#include "sim/robot/odometry.hpp"
#include "sim/robot/waypoint_controller.hpp"

#include <cstddef>
#include <filesystem>
#include <functional>
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

/// Drives along the waypoints with wheels, motors and contacts (see DriveModel), the controller fed
/// with the true pose, as by a perfect localisation. Ends a little after the last waypoint, at
/// rest, or waits there until `drive.until_s`. The scene does not move from its pose of loading. No
/// random numbers: same input, same bytes.
///
/// Throws Error, one line, naming waypoint (counted from 1) and body: when the robot would stand in
/// something at a waypoint or has no floor there; when something stands in the way, found before
/// the drive or, without `check_way_first`, by looking ahead and stopping before it; when the robot
/// gets stuck, tips over, or its state is not finite. `progress(reached, waypoints)` is called at
/// each arrival. Thread-safe.
[[nodiscard]] DriveLog simulate_drive(
    const World& world, const std::filesystem::path& robot, const Drive& drive,
    const DriveSettings& settings = {},
    const std::function<void(std::size_t, std::size_t)>& progress = {});

/// The true pose at an instant of the log, interpolated between its samples: position linearly,
/// rotation along the shortest arc. Clamped to the log's span. Throws Error on an empty log.
[[nodiscard]] Pose pose_at(const DriveLog& log, double stamp_s);

/// True poses at i / rate_hz up to `until_s`, at most `most` of them (0: no limit). Throws Error
/// when they are too many to record.
[[nodiscard]] std::vector<StampedPose> poses_along(const DriveLog& log, double rate_hz,
                                                   double until_s, int most = 0);

}  // namespace mapscore::sim
