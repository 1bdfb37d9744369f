// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#pragma once

#include "core/frame.hpp"
#include "sim/world/stamped_pose.hpp"
#include "sim/world/world.hpp"

#include <functional>
#include <vector>

namespace mapscore::sim {

/// Drive along waypoints: position and heading are interpolated linearly, the heading the short
/// way.
struct Drive {
  struct Waypoint {
    double x_m, y_m, yaw_rad;
  };
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

struct RecordOptions {
  int jobs = 1;  ///< worker threads, one rendering context each
  bool shadows = false;
};

/// Renders the frame of every pose, the scene as its motion has it at that stamp, and hands each to
/// `sink`, which is called from several threads and in any order; frames have the same bytes for
/// any number of jobs. `progress(done, total)` is called from one thread at a time. The first
/// exception of a worker ends the others and is rethrown.
void record(const World& world, const std::vector<StampedPose>& poses, const RecordOptions& options,
            const std::function<void(const Frame&)>& sink,
            const std::function<void(int, int)>& progress = {});

/// Where the robot stands at each image of either camera.
struct Streams {
  std::vector<StampedPose> color, depth;
};

/// Takes frames of which one side is rendered, with its stamp and pose: `color` numbered by
/// `index`, `depth` by `depth_index`.
struct StreamSinks {
  std::function<void(const Frame&)> color, depth;
};

/// As above, for cameras with rates of their own; `progress` counts images of either.
void record(const World& world, const Streams& streams, const RecordOptions& options,
            const StreamSinks& sinks, const std::function<void(int, int)>& progress = {});

}  // namespace mapscore::sim
