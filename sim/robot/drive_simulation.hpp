// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#pragma once

#include "sim/recorder/recorded_drive.hpp"
#include "sim/robot/drive_session.hpp"

#include <cstddef>
#include <filesystem>
#include <functional>
#include <vector>

namespace mapscore::sim {

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
