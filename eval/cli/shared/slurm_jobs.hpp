// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#pragma once

#include <cstddef>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace mapscore::eval {

/// The jobs of the last `sweep --slurm` into a results folder, as RESULTS/slurm/jobs.json says.
struct SlurmJobs {
  std::string array, merge = "0";  ///< numbers that sbatch gave; 0 where it gave none
  int shards = 1;
  std::string command;  ///< that submits what is missing
};

/// Throws Error where there is no sbatch, where an option would undo what mapscore tells it, and
/// while jobs of the results folder are in the queue.
void check_slurm(const std::vector<std::string>& sbatch_options,
                 const std::filesystem::path& results);

/// Nothing where none was submitted. Throws Error when it is not what submit_sweep writes.
[[nodiscard]] std::optional<SlurmJobs> read_slurm_jobs(const std::filesystem::path& results);

/// "2 running, 6 pending": the tasks of these jobs that squeue lists; empty where it lists none, or
/// where there is no squeue.
[[nodiscard]] std::string queue_text(const SlurmJobs& jobs);

/// What is submitted. The commands are words that no shell has read.
struct SlurmSweep {
  std::filesystem::path results;
  std::vector<std::string> task, merge;       ///< a task's ends where "I/N" of its shard follows
  std::vector<std::string> options;           ///< of sbatch, for both jobs
  std::vector<std::size_t> missing_by_shard;  ///< a task each, where any is missing
  int cpus = 1;                               ///< of a task
  std::string command;                        ///< as of SlurmJobs
};

/// Writes the scripts of both jobs into RESULTS/slurm, where they also log, and submits an array
/// and a merge that waits for the end of all its tasks, however they end. Throws Error with the
/// words of sbatch when it refuses.
SlurmJobs submit_sweep(const SlurmSweep& sweep);

/// How many batches: of about a minute by the measured rate (processor seconds of a trial), of 20
/// trials where none is known, and at most 1000, as Slurm allows by default.
[[nodiscard]] int batch_count(std::size_t trials, double seconds_per_trial, int cpus);

}  // namespace mapscore::eval
