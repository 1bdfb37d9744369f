// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#include "eval/lab/runner.hpp"

#include "core/error.hpp"
#include "core/parallel.hpp"
#include "eval/lab/bench.hpp"
#include "eval/lab/truth_cache.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <atomic>
#include <map>
#include <memory>
#include <mutex>
#include <new>
#include <span>
#include <string>
#include <utility>
#include <vector>

namespace mapscore::eval {
namespace {

/// Maps that are under way at once when the frames do not all fit into memory.
constexpr std::size_t kTrialsAtOnce = 64;

/// Maps of a strand at most; those that carve hold all free space too and are many times as large.
constexpr std::size_t kTrialsOfAStrand = 16, kCarvingTrialsOfAStrand = 4;

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

/// Trials whose methods see the same, under way together: what they see of a frame is made once.
class Strand {
 public:
  explicit Strand(std::vector<std::size_t> positions) : positions_(std::move(positions)) {}

  [[nodiscard]] std::size_t size() const { return positions_.size(); }

  void start(const TaskList& tasks, Bench& bench) {
    std::shared_ptr<const Sights> sights;
    for (const std::size_t position : positions_) {
      const Task& task = *tasks_.emplace_back(std::make_unique<const Task>(tasks[position]));
      trials_.push_back(bench.start(task, sights));
      sights = trials_.back()->sights();
    }
  }
  [[nodiscard]] bool started() const { return !trials_.empty(); }

  void advance(Bench& bench, int index) {
    const Sights& sights = *trials_.front()->sights();
    const std::shared_ptr<const Frame> frame = bench.frame(index, sights.depth_of(index));
    const Sight sight = sights.of(*frame);
    for (const auto& trial : trials_) trial->advance(*frame, sight);
  }

  /// Scores the maps and lets go of them: done(task, result) for each trial.
  void finish(const auto& done) {
    for (std::size_t n = 0; n < trials_.size(); ++n) {
      done(*tasks_[n], trials_[n]->finish());
      trials_[n].reset();
    }
    trials_.clear();
    tasks_.clear();
  }

 private:
  std::vector<std::size_t> positions_;
  std::vector<std::unique_ptr<const Task>> tasks_;
  std::vector<std::unique_ptr<TrialRun>> trials_;
};

/// Strands of at most `most` trials, in the order of the first of each.
std::vector<Strand> strands_of(const TaskList& tasks, const std::vector<std::size_t>& missing,
                               std::size_t most) {
  std::map<std::string, std::size_t> kinds;     // of sights
  std::map<const Study*, std::size_t> kind_of;  // a configuration serves all seeds
  std::map<std::pair<int, std::size_t>, std::size_t> open;
  std::vector<std::vector<std::size_t>> strands;
  for (const std::size_t position : missing) {
    const Study& config = tasks.config(position);
    const auto [entry, is_new] = kind_of.try_emplace(&config);
    if (is_new)
      entry->second = kinds
                          .try_emplace(fmt::format("{} {}", config.voxel_m,
                                                   Sights::key(config, tasks.labels(position))),
                                       kinds.size())
                          .first->second;
    const std::pair key(tasks.seed_index(position), entry->second);
    const auto strand = open.find(key);
    const std::size_t fitting =
        config.occupancy.carve ? std::min(most, kCarvingTrialsOfAStrand) : most;
    if (strand != open.end() && strands[strand->second].size() < fitting) {
      strands[strand->second].push_back(position);
    } else {
      open[key] = strands.size();
      strands.push_back({position});
    }
  }
  return {strands.begin(), strands.end()};
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

  /// `missing`: positions of tasks. Gives how many frames were made under faults.
  [[nodiscard]] std::size_t run(const std::vector<std::size_t>& missing) {
    const int block = block_of_frames(missing);
    const bool all_fit = block == recording_.frame_count();
    std::vector<Strand> strands = strands_of(tasks_, missing, trials_of_a_strand(missing.size()));
    total_ = static_cast<std::int64_t>(missing.size()) * recording_.frame_count();
    for (std::span rest(strands); !rest.empty();) {
      std::size_t count = 0, trials = 0;
      while (count < rest.size() && (all_fit || trials < kTrialsAtOnce))
        trials += rest[count++].size();
      run_batch(rest.first(count), block);
      rest = rest.subspan(count);
    }
    return sights_;
  }

 private:
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
      for_each_in_parallel(batch.size(), options_.jobs, [&](std::size_t i) {
        Strand& strand = batch[i];
        if (!strand.started()) strand.start(tasks_, bench_);
        for (int index = first; index < end; ++index) {
          strand.advance(bench_, index);
          ++sights_;
          report(strand.size());
        }
        if (end < recording_.frame_count()) return;
        strand.finish([this](const Task& task, const TrialResult& result) {
          const std::scoped_lock lock(store_mutex_);
          store_.add(task.key, task.description, result);
        });
      });
    }
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
  std::mutex store_mutex_;
  std::atomic<std::int64_t> done_{0};
  std::atomic<std::size_t> sights_{0};
  std::int64_t total_ = 0;
};

}  // namespace

RunnerOutcome run_plan(const Plan& plan, const Recording& recording, const ClassTable& table,
                       ResultStore& store, const RunnerOptions& options) {
  const TaskList& tasks = plan.tasks;
  const std::vector<std::size_t> missing = missing_tasks(tasks, store, options);
  const bool colour = std::ranges::any_of(
      missing, [&](std::size_t position) { return reads_colour(tasks.config(position)); });
  std::size_t sights = 0;
  if (!missing.empty()) try {
      sights = Sweep(tasks, recording, table, store, options, colour).run(missing);
    } catch (const std::bad_alloc&) {
      throw Error(
          "out of memory in a trial; use fewer --jobs, less --memory or larger voxels; what is "
          "done stays in the store");
    }
  return {missing.size(), tasks.size() - missing.size(), sights};
}

}  // namespace mapscore::eval
