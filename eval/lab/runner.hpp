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

namespace mapscore::eval {

struct RunnerOptions {
  int jobs = 1;                                     ///< worker threads
  std::size_t memory_bytes = std::size_t{1} << 30;  ///< decoded frames held at once
  int shard = 1, shards = 1;  ///< this process does every shards-th missing task
  std::function<void(std::int64_t done, std::int64_t total)> progress;  ///< in frame evaluations
};

struct RunnerOutcome {
  std::size_t computed = 0;  ///< tasks done now
  std::size_t reused = 0;    ///< tasks that the store had
  std::size_t sights = 0;  ///< frames under faults that were made, each for all trials that see it
};

/// Computes the tasks of a plan that the store does not hold and adds each to it as soon as it is
/// done. Trials walk the frames together in blocks that fit the memory, so that a frame is decoded
/// once for many trials. The results depend on neither jobs, memory nor shards. The first exception
/// of a worker ends the others and is rethrown, std::bad_alloc as an Error that says what helps;
/// what was done stays in the store.
RunnerOutcome run_plan(const Plan& plan, const Recording& recording, const ClassTable& table,
                       ResultStore& store, const RunnerOptions& options);

}  // namespace mapscore::eval
