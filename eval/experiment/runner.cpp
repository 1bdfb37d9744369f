// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#include "eval/experiment/runner.hpp"

#include "core/parallel.hpp"
#include "eval/experiment/lattice_truth.hpp"
#include "eval/experiment/trial_refinement.hpp"
#include "eval/experiment/trial_run.hpp"
#include "eval/recording/frame_cache.hpp"

#include <algorithm>
#include <atomic>
#include <memory>
#include <mutex>
#include <vector>

namespace mapscore::eval {
namespace {

/// Maps that are under way at once when the frames do not all fit into memory.
constexpr std::size_t kTrialsAtOnce = 64;

/// Frames of a block where each is scored by itself: their truths are shared by the trials that
/// walk them together, and let go then.
constexpr int kFramesScoredAtOnce = 8;
static_assert(kFramesScoredAtOnce <= static_cast<int>(TruthCache::kFramesOfLattice));

std::size_t bytes_of_a_frame(const Recording& recording, bool colour) {
  const CameraModel& color = recording.info().calibration.color;
  const CameraModel& depth = recording.info().calibration.depth;
  const auto pixels = [](const CameraModel& camera) {
    return static_cast<std::size_t>(camera.width_px) * static_cast<std::size_t>(camera.height_px);
  };
  return sizeof(std::uint16_t) * (pixels(color) + 2 * pixels(depth)) +
         (colour ? sizeof(cv::Vec3b) * pixels(color) : 0);
}

/// The missing tasks of this shard, those of one lattice together.
std::vector<const Task*> missing_tasks(const Plan& plan, const ResultStore& store,
                                       const RunnerOptions& options) {
  const auto done = store.keys();
  std::vector<const Task*> missing;
  int position = 0;
  for (const Task& task : plan.tasks) {
    const bool mine = position++ % options.shards == options.shard - 1;
    if (mine && !done.contains(task.key)) missing.push_back(&task);
  }
  std::stable_sort(missing.begin(), missing.end(), [](const Task* a, const Task* b) {
    return std::pair(a->seed_index, a->config.voxel_m) <
           std::pair(b->seed_index, b->config.voxel_m);
  });
  return missing;
}

/// Everything that the trials of one recording share.
class Sweep {
 public:
  /// `colour`: whether some task reads colour images.
  Sweep(const Recording& recording, const ClassTable& table, ResultStore& store,
        const RunnerOptions& options, bool colour)
      : recording_(recording),
        table_(table),
        store_(store),
        options_(options),
        colour_(colour),
        frames_(recording,
                Channels{.color = colour, .label = true, .depth = true, .depth_label = true},
                options.memory_bytes),
        truths_(recording, table, frames_, static_cast<std::size_t>(std::max(1, options.jobs)) + 1),
        poses_(recording) {}

  void run(const std::vector<const Task*>& tasks) {
    const int block = block_of_frames(tasks);
    const bool all_fit = block == recording_.frame_count();
    const std::size_t batch = all_fit ? tasks.size() : kTrialsAtOnce;
    total_ = static_cast<std::int64_t>(tasks.size()) * recording_.frame_count();
    for (std::size_t first = 0; first < tasks.size(); first += batch) {
      const auto end = std::min(tasks.size(), first + batch);
      run_batch({tasks.begin() + static_cast<std::ptrdiff_t>(first),
                 tasks.begin() + static_cast<std::ptrdiff_t>(end)},
                block);
    }
  }

 private:
  [[nodiscard]] int block_of_frames(const std::vector<const Task*>& tasks) const {
    std::size_t fitting = options_.memory_bytes / bytes_of_a_frame(recording_, colour_);
    if (std::ranges::any_of(
            tasks, [](const Task* task) { return task->config.score.unit == ScoreUnit::frame; }))
      fitting = std::min<std::size_t>(fitting, kFramesScoredAtOnce);
    return static_cast<int>(
        std::clamp<std::size_t>(fitting, 1, static_cast<std::size_t>(recording_.frame_count())));
  }

  /// All trials of the batch take one block of frames after the other; a trial is finished, stored
  /// and let go with the last block.
  void run_batch(const std::vector<const Task*>& batch, int block) {
    std::vector<std::unique_ptr<TrialRun>> runs(batch.size());
    for (int first = 0; first < recording_.frame_count(); first += block) {
      const int end = std::min(first + block, recording_.frame_count());
      for_each_in_parallel(batch.size(), options_.jobs, [&](std::size_t i) {
        if (!runs[i])
          runs[i] = std::make_unique<TrialRun>(*batch[i], recording_, table_, truths_, poses_);
        advance(*runs[i], first, end);
        if (end < recording_.frame_count()) return;
        finish(*batch[i], *runs[i]);
        runs[i].reset();
      });
    }
  }

  void advance(TrialRun& run, int first, int end) {
    for (int index = first; index < end; ++index) {
      run.advance(*frames_.get(index, run.depth_of(index)));
      const std::int64_t done = ++done_;
      if (options_.progress) options_.progress(done, total_);
    }
  }

  void finish(const Task& task, TrialRun& run) {
    const TrialResult result = run.finish();
    const std::scoped_lock lock(store_mutex_);
    store_.add(task.key, task.description, result);
  }

  const Recording& recording_;
  const ClassTable& table_;
  ResultStore& store_;
  const RunnerOptions& options_;
  bool colour_;
  FrameCache frames_;
  TruthCache truths_;
  PoseSources poses_;
  std::mutex store_mutex_;
  std::atomic<std::int64_t> done_{0};
  std::int64_t total_ = 0;
};

}  // namespace

RunnerOutcome run_plan(const Plan& plan, const Recording& recording, const ClassTable& table,
                       ResultStore& store, const RunnerOptions& options) {
  const std::vector<const Task*> missing = missing_tasks(plan, store, options);
  const bool colour =
      std::ranges::any_of(missing, [](const Task* task) { return reads_colour(task->config); });
  if (!missing.empty()) Sweep(recording, table, store, options, colour).run(missing);
  return {missing.size(), plan.tasks.size() - missing.size()};
}

}  // namespace mapscore::eval
