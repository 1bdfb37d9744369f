// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#pragma once

#include "sim/recorder/recorded_drive.hpp"
#include "sim/robot/clearance.hpp"

#include <cstddef>
#include <string>
#include <vector>

namespace mapscore::sim {

/// `waypoint 3 (2.100, 1.500 m)`, counted from 1.
[[nodiscard]] std::string waypoint_text(const std::vector<Drive::Waypoint>& waypoints,
                                        std::size_t index);

/// Throws Error when the robot would stand in something at a waypoint, or has no floor there;
/// `start_only`: of the first waypoint only.
void check_waypoints(const std::vector<Drive::Waypoint>& waypoints, bool start_only,
                     Clearance& clearance);

/// Throws Error when something stands in the way of a straight leg, sampled every 2 cm, naming the
/// waypoint it leads to.
void check_legs(const std::vector<Drive::Waypoint>& waypoints, Clearance& clearance);

/// The Error of a leg that something blocks, seen from where the robot then is.
[[noreturn]] void refuse_blocked(const std::vector<Drive::Waypoint>& waypoints, std::size_t target,
                                 const Obstacle& obstacle, const char* what);

}  // namespace mapscore::sim
