// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#pragma once

#include "core/localization/planar_pose.hpp"
#include "sim/world/world.hpp"

#include <vector>

namespace mapscore::sim {

/// Drive along waypoints: position and heading are interpolated linearly, the heading the short
/// way.
struct Drive {
  using Waypoint = PlanarPose;
  std::vector<Waypoint> waypoints;
  double speed_mps = 0.4;
  double turn_rate_radps = 0.7;
  double frames_per_s = 2.0;
  int max_frames = 0;  ///< 0: no limit
  double until_s = 0;  ///< stand at the last waypoint until then, e.g. the end of a motion
};

/// Poses at i / frames_per_s from the first waypoint to the last; a leg takes
/// max(distance / speed, |turn| / turn rate). A single waypoint gives one pose, or as many as fit
/// until `until_s`.
[[nodiscard]] std::vector<StampedPose> poses_along(const Drive& drive);

}  // namespace mapscore::sim
