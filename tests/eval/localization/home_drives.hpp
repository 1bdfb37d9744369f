// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#pragma once

#include "sim/recorder/recorded_drive.hpp"

#include <cstddef>
#include <initializer_list>
#include <numbers>

namespace mapscore::eval::testing {

/// x and y in metres, heading in degrees.
struct Stop {
  double x_m, y_m, yaw_deg;
};

inline sim::Drive drive_along(std::initializer_list<Stop> stops) {
  sim::Drive drive;
  for (const Stop& stop : stops)
    drive.waypoints.push_back({stop.x_m, stop.y_m, stop.yaw_deg * std::numbers::pi / 180.0});
  return drive;
}

/// The drive of scenes/README.md through the home: 31 m.
inline sim::Drive home_drive() {
  return drive_along(
      {{5.413, 1.203, 75},  {5.413, 3.093, 95},  {4.013, 3.093, 205}, {3.897, 1.413, 150},
       {3.613, 0.893, 130}, {3.613, 0.893, 200}, {3.613, 0.893, 8},   {3.897, 1.413, 95},
       {3.977, 3.097, 140}, {3.797, 3.613, 150}, {2.703, 3.653, 170}, {1.603, 3.653, 200},
       {1.603, 3.653, 0},   {2.703, 3.653, 70},  {2.703, 5.103, 160}, {2.447, 6.203, 235},
       {2.447, 6.203, 85},  {2.847, 5.603, 80},  {3.613, 5.393, 115}, {3.613, 5.393, -62},
       {4.013, 5.393, 45},  {5.263, 5.393, 60},  {5.263, 6.403, 75},  {5.263, 4.903, -80},
       {5.413, 3.793, -40}, {6.903, 3.807, 50},  {7.903, 4.093, -30}, {7.903, 4.093, 70},
       {6.913, 3.907, 100}, {6.913, 3.907, -80}, {6.103, 3.793, 180}, {5.413, 3.703, -90},
       {5.413, 1.393, 0},   {6.703, 1.353, 20},  {7.313, 1.253, 50},  {8.003, 1.213, 20},
       {8.003, 1.213, 215}, {8.003, 1.213, 120}});
}

/// The drive of scenes/README.md through the cottage, and back to the far room: 31 m.
inline sim::Drive cottage_drive() {
  return drive_along(
      {{4.373, 0.913, 80},  {4.363, 3.493, 150},  {3.493, 4.063, 160},  {3.493, 4.063, 116},
       {4.113, 4.413, 80},  {4.213, 6.013, -30},  {4.213, 6.013, -140}, {4.153, 4.213, -40},
       {4.503, 3.657, 20},  {6.453, 3.717, 40},   {6.847, 4.513, 60},   {6.847, 4.513, 170},
       {6.453, 3.717, 160}, {4.373, 3.513, -100}, {4.373, 2.093, 180},  {2.813, 2.093, 200},
       {2.613, 1.613, 150}, {2.613, 1.613, 200},  {2.613, 1.613, -42},  {2.813, 2.093, 20},
       {4.373, 2.093, -45}, {4.413, 1.493, 0},    {6.013, 1.497, -35},  {6.013, 1.497, 62},
       {6.713, 1.503, 10},  {6.713, 1.503, 120},  {6.013, 1.497, 180},  {4.413, 1.493, 90},
       {4.373, 3.513, 90},  {4.503, 3.657, 0},    {6.453, 3.717, 40},   {6.847, 4.513, 60}});
}

}  // namespace mapscore::eval::testing
