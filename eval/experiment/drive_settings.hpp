// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#pragma once

#include <string_view>
#include <variant>

namespace mapscore::eval {

// How the robot of a study drives, and what of its drive is recorded beside the images; see
// study.hpp.

/// The base is put at poses interpolated between the waypoints.
struct PoseDriveSettings {
  static constexpr std::string_view kKind = "poses";
  static constexpr std::string_view kMeaning =
      "the robot is put at poses between the waypoints; neither odometry nor scans are recorded";
  bool operator==(const PoseDriveSettings&) const = default;
};

/// The base is driven by wheels, motors and contacts.
struct WheelDriveSettings {
  static constexpr std::string_view kKind = "wheels";
  static constexpr std::string_view kMeaning =
      "the robot drives on its wheels, physics simulated at 500 Hz; odometry (50 Hz) and scans of "
      "its lidar are recorded";
  double acceleration_mps2 = 0.5, turn_acceleration_dps2 = 85;
  int encoder_ticks_per_turn = 4096;
  double wheel_radius_error_percent = 0, track_error_percent = 0;
  double clearance_m = 0.02;
  bool operator==(const WheelDriveSettings&) const = default;
};

using DriveChoice = std::variant<PoseDriveSettings, WheelDriveSettings>;

/// The lidar of a drive on wheels.
struct LidarStudySettings {
  double scans_per_s = 10;
  int beams = 360;
  double range_min_m = 0.15, range_max_m = 12;
  bool operator==(const LidarStudySettings&) const = default;
};

}  // namespace mapscore::eval
