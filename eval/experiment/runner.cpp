// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#include "eval/experiment/runner.hpp"

#include "core/error.hpp"
#include "core/parallel.hpp"
#include "eval/experiment/lattice_truth.hpp"
#include "eval/experiment/trial_refinement.hpp"
#include "eval/experiment/trial_run.hpp"
#include "eval/recording/frame_cache.hpp"

#include <algorithm>
#include <atomic>
#include <memory>
#include <mutex>
#include <new>
#include <span>
#include <utility>
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

/// Positions of the missing tasks of this shard, those of one lattice together.
std::vector<std::size_t> missing_tasks(const TaskList& tasks, const ResultStore& store,
                                       const RunnerOptions& options) {
  const auto done = store.keys();
  std::vector<std::size_t> missing;
  for (auto position = static_cast<std::size_t>(options.shard - 1); position < tasks.size();
       position += static_cast<std::size_t>(options.shards))
    if (done.empty() || !done.contains(tasks.key(position))) missing.push_back(position);
  std::ranges::stable_sort(missing, {}, [&tasks](std::size_t position) {
    return std::pair(tasks.seed_index(position), tasks.config(position).voxel_m);
  });
  return missing;
}

/// A trial under way, with its task, which must stay where it is.
struct RunningTask {
  RunningTask(Task of, const Recording& recording, const ClassTable& table, TruthCache& truths,
              PoseSources& poses)
      : task(std::move(of)), trial(task, recording, table, truths, poses) {}

  const Task task;
  TrialRun trial;
};

/// Everything that the trials of one recording share.
class Sweep {
 public:
  /// `colour`: whether some task reads colour images.
  Sweep(const TaskList& tasks, const Recording& recording, const ClassTable& table,
        ResultStore& store, const RunnerOptions& options, bool colour)
      : tasks_(tasks),
        recording_(recording),
        table_(table),
        store_(store),
        options_(options),
        colour_(colour),
        frames_(recording,
                Channels{.color = colour, .label = true, .depth = true, .depth_label = true},
                options.memory_bytes),
        truths_(recording, table, frames_, static_cast<std::size_t>(std::max(1, options.jobs)) + 1),
        poses_(recording) {}

  /// `missing`: positions of tasks.
  void run(const std::vector<std::size_t>& missing) {
    const int block = block_of_frames(missing);
    const bool all_fit = block == recording_.frame_count();
    const std::size_t batch = all_fit ? missing.size() : kTrialsAtOnce;
    total_ = static_cast<std::int64_t>(missing.size()) * recording_.frame_count();
    for (std::span rest(missing); !rest.empty();) {
      const std::size_t count = std::min(rest.size(), batch);
      run_batch(rest.first(count), block);
      rest = rest.subspan(count);
    }
  }

 private:
  [[nodiscard]] int block_of_frames(const std::vector<std::size_t>& missing) const {
    std::size_t fitting = options_.memory_bytes / bytes_of_a_frame(recording_, colour_);
    if (std::ranges::any_of(missing, [this](std::size_t position) {
          return tasks_.config(position).score.unit == ScoreUnit::frame;
        }))
      fitting = std::min<std::size_t>(fitting, kFramesScoredAtOnce);
    return static_cast<int>(
        std::clamp<std::size_t>(fitting, 1, static_cast<std::size_t>(recording_.frame_count())));
  }

  /// All trials of the batch take one block of frames after the other; a trial is made with the
  /// first block, and finished, stored and let go with the last.
  void run_batch(std::span<const std::size_t> batch, int block) {
    std::vector<std::unique_ptr<RunningTask>> running(batch.size());
    for (int first = 0; first < recording_.frame_count(); first += block) {
      const int end = std::min(first + block, recording_.frame_count());
      for_each_in_parallel(batch.size(), options_.jobs, [&](std::size_t i) {
        if (!running[i])
          running[i] =
              std::make_unique<RunningTask>(tasks_[batch[i]], recording_, table_, truths_, poses_);
        advance(running[i]->trial, first, end);
        if (end < recording_.frame_count()) return;
        finish(*running[i]);
        running[i].reset();
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

  void finish(RunningTask& running) {
    const TrialResult result = running.trial.finish();
    const std::scoped_lock lock(store_mutex_);
    store_.add(running.task.key, running.task.description, result);
  }

  const TaskList& tasks_;
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
  const TaskList& tasks = plan.tasks;
  const std::vector<std::size_t> missing = missing_tasks(tasks, store, options);
  const bool colour = std::ranges::any_of(
      missing, [&](std::size_t position) { return reads_colour(tasks.config(position)); });
  if (!missing.empty()) try {
      Sweep(tasks, recording, table, store, options, colour).run(missing);
    } catch (const std::bad_alloc&) {
      throw Error(
          "out of memory in a trial; use fewer --jobs, less --memory or larger voxels; what is "
          "done stays in the store");
    }
  return {missing.size(), tasks.size() - missing.size()};
}

}  // namespace mapscore::eval
