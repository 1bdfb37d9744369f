// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#pragma once

#include "core/parameters.hpp"

#include <array>
#include <optional>
#include <string_view>
#include <variant>
#include <vector>

namespace mapscore::eval {

/// The base is put at poses interpolated between the waypoints.
struct PoseDrive : NoFields {
  static constexpr std::string_view kKind = "poses";
  static constexpr std::string_view kMeaning =
      "the robot is put at poses between the waypoints; neither odometry nor scans are recorded";
};

/// The base is driven by wheels, motors and contacts.
struct WheelDrive {
  static constexpr std::string_view kKind = "wheels";
  static constexpr std::string_view kMeaning =
      "the robot drives on its wheels, physics simulated at 500 Hz; odometry (50 Hz) and scans of "
      "its lidar are recorded";
  double acceleration_mps2 = 0.5, turn_acceleration_dps2 = 85;
  int encoder_ticks_per_turn = 4096;
  double wheel_radius_error_percent = 0, track_error_percent = 0;
  double clearance_m = 0.02;

  static void fields(auto& s, auto&& visit) {
    visit(s.acceleration_mps2,
          Field{"acceleration_mps2", "greatest change of the commanded speed", above(0, 100)});
    visit(s.turn_acceleration_dps2,
          Field{"turn_acceleration_dps2", "greatest change of the commanded turn rate",
                above(0, 36000)});
    visit(s.encoder_ticks_per_turn, Field{"encoder_ticks_per_turn",
                                          "edges that a wheel's encoder counts in a turn",
                                          {1, 1000000}});
    visit(s.wheel_radius_error_percent,
          Field{"wheel_radius_error_percent",
                "error of the wheel radius that the odometry believes, of the true one",
                {.low = -50, .high = 50}});
    visit(
        s.track_error_percent,
        Field{
            "track_error_percent",
            "error of the distance between the wheels that the odometry believes, of the true one",
            {.low = -50, .high = 50}});
    visit(s.clearance_m, Field{"clearance_m",
                               "kept between the robot and what stands around it",
                               {.low = 0, .high = 1, .open_high = true}});
  }
  bool operator==(const WheelDrive&) const = default;
};

using DriveChoice = std::variant<PoseDrive, WheelDrive>;

/// The drive of a study's robot.
struct TrajectorySettings {
  std::vector<std::array<double, 3>> waypoints_m_deg;  ///< x, y, heading
  double speed_mps = 0.4;
  double turn_rate_dps = 40;
  double frames_per_s = 2;
  std::optional<double> depth_frames_per_s;  ///< empty: see depth_rate
  int max_frames = 0;
  DriveChoice drive;

  static void fields(auto& s, auto&& visit) {
    visit(s.waypoints_m_deg,
          Field{"waypoints_m_deg", "x, y and heading of each waypoint, in the scene's world"});
    visit(s.speed_mps, Field{"speed_mps", "speed along a leg", above(0, 100)});
    visit(s.turn_rate_dps,
          Field{"turn_rate_dps", "greatest turn rate; a leg that turns more takes longer",
                above(0, 36000)});
    visit(s.frames_per_s,
          Field{"frames_per_s", "frames recorded in a second of the drive", above(0, 1000)});
    visit(s.depth_frames_per_s, Field{"depth_frames_per_s",
                                      "depth images in a second of the drive; default: where "
                                      "faults.time_offset_ms is dosed the least multiple of "
                                      "frames_per_s from 30 on, else frames_per_s",
                                      above(0, 1000)});
    visit(s.max_frames,
          Field{"max_frames", "stop after so many frames; 0: at the last waypoint", at_least(0)});
    visit(s.drive, later({"drive", "how the robot gets from waypoint to waypoint"}));
  }
  bool operator==(const TrajectorySettings&) const = default;
};

/// The RGB-D camera of a study's robot.
struct CameraSettings {
  int width_px = 640, height_px = 480;
  double range_min_m = 0.6, range_max_m = 8;
  bool shadows = false;
  std::optional<double> height_m{}, pan_deg{}, tilt_deg{};  ///< empty: as the robot has it

  static void fields(auto& s, auto&& visit) {
    visit(
        s.width_px,
        Field{"width_px", "width of colour and depth images; the fields of view stay", {16, 8192}});
    visit(s.height_px, Field{"height_px", "height of colour and depth images", {16, 8192}});
    visit(s.range_min_m,
          Field{"range_min_m", "least planar depth that the depth camera returns", above(0, 13)});
    visit(s.range_max_m, Field{"range_max_m", "greatest planar depth that the depth camera returns",
                               above(0, 13)});
    visit(s.height_m,
          Field{"height_m", "height of both cameras above the floor; default: the robot's",
                above(0, 10)});
    visit(s.pan_deg,
          Field{"pan_deg", "turn of both cameras to the left; default: the robot's", {-180, 180}});
    visit(s.tilt_deg,
          Field{"tilt_deg", "turn of both cameras downwards; default: the robot's", {-90, 90}});
    visit(s.shadows, Field{"shadows", "draw shadows in the colour images"});
  }
  bool operator==(const CameraSettings&) const = default;
};

/// The lidar of a drive on wheels.
struct LidarStudySettings {
  double scans_per_s = 10;
  int beams = 360;
  double range_min_m = 0.15, range_max_m = 12;

  static void fields(auto& s, auto&& visit) {
    visit(s.scans_per_s,
          later({"scans_per_s", "turns in a second of the drive, each at one instant",
                 above(0, 1000)}));
    visit(s.beams, later({"beams", "beams of a turn, evenly around", {1, 100000}}));
    visit(s.range_min_m, later({"range_min_m", "anything nearer is not measured", {0, 1000}}));
    visit(s.range_max_m, later({"range_max_m", "anything farther is not seen", above(0, 1000)}));
  }
  bool operator==(const LidarStudySettings&) const = default;
};

}  // namespace mapscore::eval
