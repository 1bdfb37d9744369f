// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#pragma once

#include "eval/cli/sweep/sweep_flags.hpp"
#include "eval/results/store.hpp"
#include "eval/results/task_list.hpp"

#include <cstddef>
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

/// Says on standard error how many trials failed whose method is a command, and the flag that tries
/// them again; nothing where none did.
void tell_failed_commands(std::size_t count, const std::filesystem::path& results);

/// Submits what the store misses to Slurm, commands that failed only with --retry_failed, and says
/// so on standard error. Returns the exit code: 1 where nothing but failed commands is missing;
/// throws Error as submit_sweep.
int submit_missing(const SharedOutSweep& sweep);

/// Says on standard error how many trials each batch misses, and the command that goes on. Returns
/// the exit code: 1 where any is missing or failed.
int tell_missing(const SharedOutSweep& sweep);

}  // namespace mapscore::eval
