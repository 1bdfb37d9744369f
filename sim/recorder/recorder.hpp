// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#pragma once

#include "core/frame.hpp"
#include "sim/world/world.hpp"

#include <functional>
#include <vector>

namespace mapscore::sim {

struct RecordOptions {
  int jobs = 1;  ///< worker threads, one rendering context each
  bool shadows = false;
};

/// Where the robot stands at each image of either camera.
struct Streams {
  std::vector<StampedPose> color, depth;
};

/// Takes frames of which one side is rendered, with its stamp and pose: `color` numbered by
/// `index`, `depth` by `depth_index`.
struct StreamSinks {
  std::function<void(const Frame&)> color, depth;
};

/// Renders each image, the scene as its motion has it at that stamp, and hands it to its sink,
/// which is called from several threads and in any order; images have the same bytes for any number
/// of jobs. `progress(done, total)` counts images of either camera, from one thread at a time. An
/// exception of a worker ends the others and is rethrown.
void record(const World& world, const Streams& streams, const RecordOptions& options,
            const StreamSinks& sinks, const std::function<void(int, int)>& progress = {});

}  // namespace mapscore::sim
