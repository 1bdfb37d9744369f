// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#include "sim/recorder/recorder.hpp"

#include "core/error.hpp"
#include "core/parallel.hpp"
#include "sim/render/renderer.hpp"

#include <algorithm>
#include <mutex>

namespace mapscore::sim {
namespace {

/// Calls `render_one(renderer, n)` for n in 0..count-1, each worker with a renderer of its own.
void render_all(const World& world, std::size_t count, const RecordOptions& options,
                const std::function<void(Renderer&, std::size_t)>& render_one,
                const std::function<void(int, int)>& progress) {
  if (options.jobs < 1) throw Error("record: jobs must be at least 1");
  if (count == 0) return;
  Runs items(count, 1);
  std::mutex mutex;  // guards what follows
  int done = 0;
  run_jobs(static_cast<int>(std::min(count, static_cast<std::size_t>(options.jobs))), [&](int) {
    try {
      Renderer renderer(world, options.shadows);
      for (Runs::Run item; items.next(item);) {
        render_one(renderer, item.first);
        const std::scoped_lock lock(mutex);
        ++done;
        if (progress) progress(done, static_cast<int>(count));
      }
    } catch (...) {
      items.stop();
      throw;
    }
  });
}

Instant instant_of(const StampedPose& pose) {
  return {pose.stamp_s, pose.T_world_base};
}

}  // namespace

void record(const World& world, const std::vector<StampedPose>& poses, const RecordOptions& options,
            const std::function<void(const Frame&)>& sink,
            const std::function<void(int, int)>& progress) {
  const auto render_one = [&](Renderer& renderer, std::size_t n) {
    const Instant instant = instant_of(poses[n]);
    sink(renderer.render(static_cast<int>(n), instant, instant));
  };
  render_all(world, poses.size(), options, render_one, progress);
}

void record(const World& world, const Streams& streams, const RecordOptions& options,
            const StreamSinks& sinks, const std::function<void(int, int)>& progress) {
  const std::size_t colors = streams.color.size();
  const auto render_one = [&](Renderer& renderer, std::size_t n) {
    Frame frame;
    if (n < colors) {
      const StampedPose& pose = streams.color[n];
      frame.index = static_cast<int>(n);
      frame.stamp_s = pose.stamp_s;
      frame.T_world_base = pose.T_world_base;
      renderer.render_color(instant_of(pose), frame);
      return sinks.color(frame);
    }
    frame.depth_index = static_cast<int>(n - colors);
    renderer.render_depth(instant_of(streams.depth[n - colors]), frame);
    sinks.depth(frame);
  };
  render_all(world, colors + streams.depth.size(), options, render_one, progress);
}

}  // namespace mapscore::sim
