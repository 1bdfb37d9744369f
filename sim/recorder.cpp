// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#include "sim/recorder.hpp"

#include "core/error.hpp"
#include "sim/render/renderer.hpp"

#include <algorithm>
#include <atomic>
#include <exception>
#include <mutex>
#include <optional>
#include <thread>

namespace mapscore::sim {
namespace {

/// What is still to be rendered, how much is done, and the first exception: what workers share.
class Work {
 public:
  Work(std::size_t count, const std::function<void(int, int)>& progress)
      : count_(count), progress_(progress) {}

  /// The next one's number; none when all are taken or a worker failed.
  std::optional<std::size_t> next() {
    if (failed_) return std::nullopt;
    const std::size_t index = next_++;
    return index < count_ ? std::optional(index) : std::nullopt;
  }

  void count_done() {
    const std::scoped_lock lock(mutex_);
    ++done_;
    if (progress_) progress_(done_, static_cast<int>(count_));
  }

  void fail(std::exception_ptr error) {
    const std::scoped_lock lock(mutex_);
    if (!error_) error_ = std::move(error);
    failed_ = true;
  }

  void rethrow() const {
    if (error_) std::rethrow_exception(error_);
  }

 private:
  const std::size_t count_;
  const std::function<void(int, int)>& progress_;
  std::atomic<std::size_t> next_{0};
  std::atomic<bool> failed_{false};
  std::mutex mutex_;
  int done_ = 0;
  std::exception_ptr error_;
};

/// Calls `render_one(renderer, n)` for n in 0..count-1, each worker with a renderer of its own.
void render_all(const World& world, std::size_t count, const RecordOptions& options,
                const std::function<void(Renderer&, std::size_t)>& render_one,
                const std::function<void(int, int)>& progress) {
  if (options.jobs < 1) throw Error("record: jobs must be at least 1");
  Work work(count, progress);
  const auto worker = [&] {
    try {
      Renderer renderer(world, options.shadows);
      while (const std::optional<std::size_t> n = work.next()) {
        render_one(renderer, *n);
        work.count_done();
      }
    } catch (...) {
      work.fail(std::current_exception());
    }
  };
  {
    const std::size_t workers = std::min(static_cast<std::size_t>(options.jobs), count);
    std::vector<std::jthread> threads;
    for (std::size_t i = 0; i < workers; ++i) threads.emplace_back(worker);
  }  // joins
  work.rethrow();
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
