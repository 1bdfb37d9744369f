// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#include "sim/recorder.hpp"

#include "core/error.hpp"
#include "sim/render/renderer.hpp"

#include <algorithm>
#include <atomic>
#include <exception>
#include <mutex>
#include <thread>

namespace mapscore::sim {
namespace {

/// The poses still to be rendered, how many are done, and the first exception: what workers share.
class Work {
 public:
  Work(const std::vector<StampedPose>& poses, const std::function<void(int, int)>& progress)
      : poses_(poses), progress_(progress) {}

  /// Index of the next pose, -1 when there is none or a worker failed.
  int next() {
    if (failed_) return -1;
    const std::size_t index = next_++;
    return index < poses_.size() ? static_cast<int>(index) : -1;
  }

  void count_done() {
    const std::scoped_lock lock(mutex_);
    ++done_;
    if (progress_) progress_(done_, static_cast<int>(poses_.size()));
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
  const std::vector<StampedPose>& poses_;
  const std::function<void(int, int)>& progress_;
  std::atomic<std::size_t> next_{0};
  std::atomic<bool> failed_{false};
  std::mutex mutex_;
  int done_ = 0;
  std::exception_ptr error_;
};

void render_frames(const World& world, const std::vector<StampedPose>& poses, bool shadows,
                   const std::function<void(const Frame&)>& sink, Work& work) {
  try {
    Renderer renderer(world, shadows);
    for (int i = work.next(); i >= 0; i = work.next()) {
      sink(renderer.render(i, poses[i].stamp_s, poses[i].T_world_base));
      work.count_done();
    }
  } catch (...) {
    work.fail(std::current_exception());
  }
}

}  // namespace

void record(const World& world, const std::vector<StampedPose>& poses, const RecordOptions& options,
            const std::function<void(const Frame&)>& sink,
            const std::function<void(int, int)>& progress) {
  if (options.jobs < 1) throw Error("record: jobs must be at least 1");
  if (poses.empty()) return;
  Work work(poses, progress);
  {
    const std::size_t workers = std::min(static_cast<std::size_t>(options.jobs), poses.size());
    std::vector<std::jthread> threads;
    for (std::size_t i = 0; i < workers; ++i) {
      threads.emplace_back([&] { render_frames(world, poses, options.shadows, sink, work); });
    }
  }  // joins
  work.rethrow();
}

}  // namespace mapscore::sim
