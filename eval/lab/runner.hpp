// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#pragma once

#include "core/classes.hpp"
#include "eval/recording/recording.hpp"
#include "eval/results/plan.hpp"
#include "eval/results/store.hpp"

#include <cstddef>
#include <cstdint>
#include <functional>
#include <string>
#include <unordered_set>
#include <vector>

namespace mapscore::eval {

struct RunnerOptions {
  int jobs = 1;                                     ///< worker threads
  std::size_t memory_bytes = std::size_t{1} << 30;  ///< decoded frames held at once
  int shard = 1, shards = 1;  ///< this process does the missing tasks of one slice (missing_tasks)
  bool keep_builds = false;   ///< trials that another build made are not missing
  std::unordered_set<std::string> held_elsewhere = {};  ///< keys that are not missing either
  std::function<void(std::int64_t done, std::int64_t total)> progress =
      {};  ///< in frame evaluations
  /// After each trial, one call at a time: how many were computed and how many failed so far.
  std::function<void(std::size_t computed, std::size_t failed)> ended = {};
  std::function<bool()> stop = {};  ///< asked before each frame, from all threads
};

/// A trial that could not be computed.
struct TrialFailure {
  std::string key, reason;
};

struct RunnerOutcome {
  std::size_t computed = 0;  ///< tasks done now
  std::size_t reused = 0;    ///< tasks that the store had, or that other shards or scenes have
  std::size_t sights = 0;  ///< frames under faults that were made, each for all trials that see it
  std::vector<TrialFailure> failures;  ///< in no order
  bool stopped = false;                ///< by RunnerOptions::stop
};

/// Keys of the trials of a store that a sweep does not compute anew: those of this build, or of any
/// with `keep_builds`.
[[nodiscard]] std::unordered_set<std::string> kept_keys(const ResultStore& store, bool keep_builds);

/// Keys of the trials whose commands ran and failed, as the store says: unlike other failures,
/// which may be mended, they would fail again.
[[nodiscard]] std::unordered_set<std::string> failed_commands(const ResultStore& store,
                                                              const TaskList& tasks);

/// Positions of the tasks of a shard whose keys are not `held`. All tasks in the order of their
/// lattices are cut into `shards` slices that differ by one task at most, whatever is held, since
/// tasks of one lattice share its truth, and those of one cell the frames under its faults.
[[nodiscard]] std::vector<std::size_t> missing_tasks(const TaskList& tasks,
                                                     const std::unordered_set<std::string>& held,
                                                     int shard, int shards);
/// How many tasks each shard misses, from the first shard on.
[[nodiscard]] std::vector<std::size_t> missing_by_shard(const TaskList& tasks,
                                                        const std::unordered_set<std::string>& held,
                                                        int shards);

/// Computes the tasks of a plan that are of this recording and that the store does not hold, or
/// holds of another build, and adds each to it as soon as it is done. Trials walk the frames
/// together in blocks that fit the memory, so that a frame is decoded once for many trials. The
/// results depend on neither jobs, memory nor shards. Trials whose method is a command are run
/// first; what they take is stored beside them. One whose program is not there is refused before
/// any trial. A trial that throws is stored as failed, with its reason, and the others go on. What
/// the store or a function of the options throws ends all and is rethrown, std::bad_alloc as an
/// Error that says what helps; what was done stays in the store.
RunnerOutcome run_plan(const Plan& plan, const Recording& recording, const ClassTable& table,
                       ResultStore& store, const RunnerOptions& options);

}  // namespace mapscore::eval
