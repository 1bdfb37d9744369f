// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#include "sim/recorder/recorder.hpp"

#include "core/error.hpp"
#include "core/parallel.hpp"
#include "sim/render/renderer.hpp"

#include <algorithm>
#include <mutex>

namespace mapscore::sim {

void record(const World& world, const Streams& streams, const RecordOptions& options,
            const StreamSinks& sinks, const std::function<void(int, int)>& progress) {
  if (options.jobs < 1) throw Error("record: jobs must be at least 1");
  const std::size_t colors = streams.color.size(), count = colors + streams.depth.size();
  if (count == 0) return;
  const auto render_one = [&](Renderer& renderer, std::size_t n) {
    Frame frame;
    if (n < colors) {
      const StampedPose& pose = streams.color[n];
      frame.index = static_cast<int>(n);
      frame.stamp_s = pose.stamp_s;
      frame.T_world_base = pose.T_world_base;
      renderer.render_color(pose, frame);
      return sinks.color(frame);
    }
    frame.depth_index = static_cast<int>(n - colors);
    renderer.render_depth(streams.depth[n - colors], frame);
    sinks.depth(frame);
  };
  Runs images(count, 1);
  std::mutex mutex;  // guards what follows
  int done = 0;
  run_jobs(static_cast<int>(std::min(count, static_cast<std::size_t>(options.jobs))), [&](int) {
    try {
      Renderer renderer(world, options.shadows);
      for (Runs::Run image; images.next(image);) {
        render_one(renderer, image.first);
        const std::scoped_lock lock(mutex);
        ++done;
        if (progress) progress(done, static_cast<int>(count));
      }
    } catch (...) {
      images.stop();
      throw;
    }
  });
}

}  // namespace mapscore::sim
