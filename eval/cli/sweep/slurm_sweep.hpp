// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#pragma once

#include "eval/cli/sweep/sweep_flags.hpp"
#include "eval/results/store.hpp"
#include "eval/results/task_list.hpp"

#include <filesystem>
#include <string>

namespace mapscore::eval {

/// A sweep whose trials others compute.
struct SharedOutSweep {
  const SweepFlags& flags;
  const std::filesystem::path& results;  ///< the whole folder
  const std::string& study;              ///< its name
  const TaskList& tasks;
  const ResultStore& store;  ///< of the folder
};

/// Submits what the store misses to Slurm, and says so on standard error. Returns the exit code;
/// throws Error as submit_sweep.
int submit_missing(const SharedOutSweep& sweep);

/// Says on standard error how many trials each batch misses, and the command that goes on. Returns
/// the exit code: 1 where any is missing.
int tell_missing(const SharedOutSweep& sweep);

}  // namespace mapscore::eval
