// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#include "eval/lab/runner.hpp"

#include "core/error.hpp"
#include "core/parallel.hpp"
#include "eval/lab/bench.hpp"
#include "eval/lab/commands/command_trials.hpp"
#include "eval/lab/commands/command_words.hpp"
#include "eval/lab/strand.hpp"
#include "eval/lab/truth_cache.hpp"
#include "eval/results/build_identity.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <atomic>
#include <map>
#include <mutex>
#include <new>
#include <numeric>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

namespace mapscore::eval {
namespace {

/// Maps that are under way at once when the frames do not all fit into memory.
constexpr std::size_t kTrialsAtOnce = 64;

/// Maps of a strand at most.
constexpr std::size_t kTrialsOfAStrand = 16;

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

/// What ends the strands of a sweep that is to stop.
struct Stopped {};

/// The command that a task's method is; none of a method of ours.
const CommandMethod* command_of(const TaskList& tasks, std::size_t position) {
  const auto& command = tasks.config(position).methods.front().command;
  return command && tasks.labels(position) == Labels::detected ? &*command : nullptr;
}

/// Everything that the trials of one recording share.
class Sweep {
 public:
  /// `colour`: whether some task reads colour images.
  Sweep(const TaskList& tasks, const Recording& recording, const ClassTable& table,
        ResultStore& store, const RunnerOptions& options, bool colour)
      : tasks_(tasks),
        recording_(recording),
        store_(store),
        options_(options),
        colour_(colour),
        bench_(recording, table, colour, options.memory_bytes,
               static_cast<std::size_t>(std::max(1, options.jobs)) + 1) {}

  /// `missing`: positions of tasks.
  void run(std::vector<std::size_t> missing) {
    total_ = static_cast<std::int64_t>(missing.size()) * recording_.frame_count();
    const auto own = std::stable_partition(missing.begin(), missing.end(), [&](std::size_t n) {
      return command_of(tasks_, n) != nullptr;
    });
    const std::vector<std::size_t> commands(missing.begin(), own);
    missing.erase(missing.begin(), own);
    if (!commands.empty()) run_commands(commands);
    if (!missing.empty()) run_own(missing);
  }

  /// What was done so far.
  [[nodiscard]] RunnerOutcome outcome() {
    RunnerOutcome outcome;
    outcome.computed = computed_;
    outcome.sights = sights_;
    outcome.failures = std::exchange(failures_, {});
    return outcome;
  }

 private:
  /// Those whose method is a command, as many at a time as their threads leave.
  void run_commands(const std::vector<std::size_t>& missing) {
    std::map<int, std::vector<std::size_t>> by_threads;
    for (const std::size_t position : missing)
      by_threads[command_of(tasks_, position)->threads].push_back(position);
    CommandTrials trials(bench_, options_.stop);
    for (const auto& [threads, positions] : by_threads)
      for_each_in_parallel(positions.size(), std::max(1, options_.jobs / threads),
                           [&](std::size_t n) { run_command_of(tasks_[positions[n]], trials); });
  }

  void run_command_of(const Task& task, CommandTrials& trials) {
    if (options_.stop && options_.stop()) throw Stopped();
    std::optional<TrialCost> cost;
    std::optional<TrialResult> result;
    std::string reason;
    try {
      result = trials.run(task, cost);
      if (!result) throw Stopped();
    } catch (const Error& error) {
      reason = error.what();
    }
    if (!is_as_planned(task)) {  // a failure that the next sweep tries again, under its new key
      result.reset();
      cost.reset();
      reason = fmt::format(
          "methods.{}: a file that the command names or depends on has changed since the sweep "
          "began",
          task.config.methods.front().name);
    }
    if (cost) keep_cost(task, *cost);
    result ? keep(task, *result) : keep_failure(task, reason);
    report(static_cast<std::size_t>(recording_.frame_count()));
  }

  /// Those of our own methods, and ceilings.
  void run_own(const std::vector<std::size_t>& missing) {
    const int block = block_of_frames(missing);
    const bool all_fit = block == recording_.frame_count();
    std::vector<Strand> strands = strands_of(tasks_, missing, trials_of_a_strand(missing.size()),
                                             static_cast<std::size_t>(std::max(1, options_.jobs)));
    for (std::span rest(strands); !rest.empty();) {
      std::size_t count = 0, trials = 0;
      while (count < rest.size() && (all_fit || trials < kTrialsAtOnce))
        trials += rest[count++].planned();
      run_batch(rest.first(count), block);
      rest = rest.subspan(count);
    }
  }

  /// So few that every job has a strand.
  [[nodiscard]] std::size_t trials_of_a_strand(std::size_t trials) const {
    const auto jobs = static_cast<std::size_t>(std::max(1, options_.jobs));
    return std::clamp<std::size_t>(trials / jobs, 1, kTrialsOfAStrand);
  }

  [[nodiscard]] int block_of_frames(const std::vector<std::size_t>& missing) const {
    std::size_t fitting = options_.memory_bytes / bytes_of_a_frame(recording_, colour_);
    if (std::ranges::any_of(missing, [this](std::size_t position) {
          return tasks_.config(position).score.unit == ScoreUnit::frame;
        }))
      fitting = std::min<std::size_t>(fitting, kFramesScoredAtOnce);
    return static_cast<int>(
        std::clamp<std::size_t>(fitting, 1, static_cast<std::size_t>(recording_.frame_count())));
  }

  /// All strands of the batch take one block of frames after the other; a strand is started with
  /// the first block, and finished, stored and let go with the last.
  void run_batch(std::span<Strand> batch, int block) {
    for (int first = 0; first < recording_.frame_count(); first += block) {
      const int end = std::min(first + block, recording_.frame_count());
      for_each_in_parallel(batch.size(), options_.jobs,
                           [&](std::size_t i) { advance(batch[i], first, end); });
    }
  }

  /// Takes a strand over the frames from `first` to before `end`.
  void advance(Strand& strand, int first, int end) {
    int index = first;
    const auto failed = [&](const Task& task, const std::string& reason) {
      total_ -= recording_.frame_count() - index;
      keep_failure(task, reason);
    };
    if (!strand.started()) strand.start(tasks_, bench_, failed);
    for (; index < end && strand.size() > 0; ++index) {
      if (options_.stop && options_.stop()) throw Stopped();
      strand.advance(bench_, index, failed);
      ++sights_;
      report(strand.size());
    }
    if (end < recording_.frame_count()) return;
    index = end;
    strand.finish([this](const Task& task, const TrialResult& result) { keep(task, result); },
                  failed);
  }

  void keep(const Task& task, const TrialResult& result) {
    const std::scoped_lock lock(store_mutex_);
    store_.add(task.key, task.description, result);
    ++computed_;
    if (options_.ended) options_.ended(computed_, failures_.size());
  }

  void keep_cost(const Task& task, const TrialCost& cost) {
    const std::scoped_lock lock(store_mutex_);
    store_.add_cost(task.key, cost);
  }

  void keep_failure(const Task& task, const std::string& reason) {
    const std::scoped_lock lock(store_mutex_);
    store_.add_failure(task.key, reason);
    failures_.push_back({task.key, reason});
    if (options_.ended) options_.ended(computed_, failures_.size());
  }

  /// Tells of a frame that so many trials took.
  void report(std::size_t trials) {
    for (std::size_t n = 0; n < trials; ++n) {
      const std::int64_t done = ++done_;
      if (options_.progress) options_.progress(done, total_);
    }
  }

  const TaskList& tasks_;
  const Recording& recording_;
  ResultStore& store_;
  const RunnerOptions& options_;
  bool colour_;
  Bench bench_;
  std::mutex store_mutex_;  // guards the two below
  std::size_t computed_ = 0;
  std::vector<TrialFailure> failures_;
  std::atomic<std::int64_t> done_{0}, total_{0};  ///< frame evaluations
  std::atomic<std::size_t> sights_{0};
};

/// Positions of all tasks, those of one lattice together, and of these those of one cell.
std::vector<std::size_t> in_order_of_lattices(const TaskList& tasks) {
  std::vector<std::size_t> order(tasks.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::ranges::stable_sort(order, {}, [&tasks](std::size_t position) {
    return std::pair(tasks.seed_index(position), tasks.config(position).voxel_m);
  });
  return order;
}

/// Where the slice of a shard begins.
std::ptrdiff_t first_of_shard(std::size_t tasks, int shard, int shards) {
  return static_cast<std::ptrdiff_t>(tasks * static_cast<std::size_t>(shard - 1) /
                                     static_cast<std::size_t>(shards));
}

}  // namespace

std::unordered_set<std::string> kept_keys(const ResultStore& store, bool keep_builds) {
  return keep_builds ? store.keys() : store.keys(build_identity());
}

std::vector<std::size_t> missing_tasks(const TaskList& tasks,
                                       const std::unordered_set<std::string>& held, int shard,
                                       int shards) {
  std::vector<std::size_t> missing = in_order_of_lattices(tasks);
  missing.erase(missing.begin() + first_of_shard(missing.size(), shard + 1, shards), missing.end());
  missing.erase(missing.begin(), missing.begin() + first_of_shard(tasks.size(), shard, shards));
  if (!held.empty())
    std::erase_if(missing,
                  [&](std::size_t position) { return held.contains(tasks.key(position)); });
  return missing;
}

std::vector<std::size_t> missing_by_shard(const TaskList& tasks,
                                          const std::unordered_set<std::string>& held, int shards) {
  const std::vector<std::size_t> order = in_order_of_lattices(tasks);
  std::vector<std::size_t> missing;
  for (int shard = 1; shard <= shards; ++shard)
    missing.push_back(static_cast<std::size_t>(
        std::count_if(order.begin() + first_of_shard(order.size(), shard, shards),
                      order.begin() + first_of_shard(order.size(), shard + 1, shards),
                      [&](std::size_t position) { return !held.contains(tasks.key(position)); })));
  return missing;
}

std::unordered_set<std::string> failed_commands(const ResultStore& store, const TaskList& tasks) {
  std::unordered_set<std::string> keys;
  const auto failures = store.failures();
  const auto costs = store.costs();  // of commands that ran; what failed before may not fail again
  const auto held = store.keys();
  for (std::size_t n = 0; n < tasks.size() && !failures.empty(); ++n)
    if (const std::string key = tasks.key(n);
        failures.contains(key) && costs.contains(key) && !held.contains(key))
      keys.insert(key);
  return keys;
}

RunnerOutcome run_plan(const Plan& plan, const Recording& recording, const ClassTable& table,
                       ResultStore& store, const RunnerOptions& options) {
  const TaskList& tasks = plan.tasks;
  std::unordered_set<std::string> held = kept_keys(store, options.keep_builds);
  held.insert(options.held_elsewhere.begin(), options.held_elsewhere.end());
  std::vector<std::size_t> missing = missing_tasks(tasks, held, options.shard, options.shards);
  std::erase_if(missing, [&](std::size_t task) {
    return tasks.recording_hash(task) != recording.content_hash();
  });
  for (const std::size_t position : missing)
    if (command_of(tasks, position)) static_cast<void>(command_words(tasks.config(position)));
  RunnerOutcome outcome;
  if (!missing.empty()) {
    const bool colour = std::ranges::any_of(
        missing, [&](std::size_t position) { return reads_colour(tasks.config(position)); });
    Sweep sweep(tasks, recording, table, store, options, colour);
    bool stopped = false;
    try {
      sweep.run(missing);
    } catch (const Stopped&) {
      stopped = true;
    } catch (const std::bad_alloc&) {
      throw Error(
          "out of memory in a trial; use fewer --jobs, less --memory or larger voxels; what is "
          "done stays in the store");
    }
    outcome = sweep.outcome();
    outcome.stopped = stopped;
  }
  outcome.reused = tasks.size() - missing.size();
  return outcome;
}

}  // namespace mapscore::eval
