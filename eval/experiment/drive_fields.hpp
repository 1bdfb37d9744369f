// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#pragma once

#include "eval/experiment/drive_settings.hpp"
#include "eval/experiment/fields.hpp"

namespace mapscore::eval {

void fields(auto&&, Of<PoseDriveSettings> auto&) {}

void fields(auto&& visit, Of<WheelDriveSettings> auto& s) {
  visit(Field{"acceleration_mps2", "greatest change of the commanded speed", above(0, 100)},
        s.acceleration_mps2);
  visit(Field{"turn_acceleration_dps2", "greatest change of the commanded turn rate",
              above(0, 36000)},
        s.turn_acceleration_dps2);
  visit(
      Field{
          "encoder_ticks_per_turn", "edges that a wheel's encoder counts in a turn", {1, 1000000}},
      s.encoder_ticks_per_turn);
  visit(Field{"wheel_radius_error_percent",
              "error of the wheel radius that the odometry believes, of the true one",
              {.low = -50, .high = 50}},
        s.wheel_radius_error_percent);
  visit(
      Field{"track_error_percent",
            "error of the distance between the wheels that the odometry believes, of the true one",
            {.low = -50, .high = 50}},
      s.track_error_percent);
  visit(Field{"clearance_m",
              "kept between the robot and what stands around it",
              {.low = 0, .high = 1, .open_high = true}},
        s.clearance_m);
}

void fields(auto&& visit, Of<LidarStudySettings> auto& s) {
  visit(Field{.key = "scans_per_s",
              .meaning = "turns in a second of the drive, each at one instant",
              .range = above(0, 1000),
              .unkeyed = "10"},
        s.scans_per_s);
  visit(Field{.key = "beams",
              .meaning = "beams of a turn, evenly around",
              .range = {1, 100000},
              .unkeyed = "360"},
        s.beams);
  visit(Field{.key = "range_min_m",
              .meaning = "anything nearer is not measured",
              .range = {0, 1000},
              .unkeyed = "0.15"},
        s.range_min_m);
  visit(Field{.key = "range_max_m",
              .meaning = "anything farther is not seen",
              .range = above(0, 1000),
              .unkeyed = "12"},
        s.range_max_m);
}

}  // namespace mapscore::eval
