// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#pragma once

#include "core/frame.hpp"
#include "sim/world/stamped_pose.hpp"
#include "sim/world/world.hpp"

#include <functional>
#include <vector>

namespace mapscore::sim {

struct RecordOptions {
  int jobs = 1;  ///< worker threads, one rendering context each
  bool shadows = false;
};

/// Renders the frame of every pose, the scene as its motion has it at that stamp, and hands each to
/// `sink`, which is called from several threads and in any order; frames have the same bytes for
/// any number of jobs. `progress(done, total)` is called from one thread at a time. An exception of
/// a worker ends the others and is rethrown.
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
