// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#include "eval/cli/sweep/slurm_sweep.hpp"

#include "eval/cli/shared/shard_stores.hpp"
#include "eval/cli/shared/slurm_jobs.hpp"
#include "eval/lab/runner.hpp"
#include "files/text.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <iostream>
#include <numeric>
#include <unordered_set>

namespace mapscore::eval {
namespace {

/// For a person to paste into a shell.
std::string command_text(std::vector<std::string> words) {
  for (std::string& word : words) word = shell_word(word);
  return fmt::format("`mapscore {}`", fmt::join(words, " "));
}

/// The command that was given, from any folder.
std::vector<std::string> command_again(const SharedOutSweep& sweep, int cpus) {
  std::vector<std::string> words = sweep.flags.words(sweep.results, cpus);
  words.emplace_back("--slurm");
  if (sweep.flags.tasks) {
    words.emplace_back("--tasks");
    words.push_back(std::to_string(*sweep.flags.tasks));
  }
  if (!sweep.flags.sbatch_options.empty()) words.emplace_back("--");
  words.insert(words.end(), sweep.flags.sbatch_options.begin(), sweep.flags.sbatch_options.end());
  return words;
}

/// How many batches the trials are cut into.
int batches_of(const SharedOutSweep& sweep, int cpus) {
  const int count = sweep.flags.tasks.value_or(
      batch_count(sweep.tasks.size(), measured_seconds_per_trial(sweep.results), cpus));
  return static_cast<int>(std::min(static_cast<std::size_t>(count), sweep.tasks.size()));
}

std::size_t sum_of(const std::vector<std::size_t>& counts) {
  return std::accumulate(counts.begin(), counts.end(), std::size_t{0});
}

/// Says that nothing is left to compute. Returns the exit code: 1 where commands failed.
int say_that_all_is_there(const SharedOutSweep& sweep, std::size_t failed) {
  tell_failed_commands(failed, sweep.results);
  if (!sweep.flags.work.quiet)
    std::cerr << fmt::format("sweep {}: all {} {}trials are in {}\n", sweep.study,
                             sweep.tasks.size() - failed, failed > 0 ? "other " : "",
                             shown(sweep.results / "results.sqlite"));
  return failed > 0 ? 1 : 0;
}

/// ": 12 of shard 3/8, 11 of shard 5/8"; empty where nothing was cut into shards.
std::string shards_text(const std::vector<std::size_t>& missing) {
  constexpr std::size_t kNamed = 10;
  std::string text;
  std::size_t shards = 0;
  for (std::size_t n = 0; n < missing.size() && missing.size() > 1; ++n)
    if (missing[n] > 0 && ++shards <= kNamed)
      text += fmt::format("{} {} of shard {}/{}", shards > 1 ? "," : ":", missing[n], n + 1,
                          missing.size());
  if (shards > kNamed) text += fmt::format(", and of {} more shards", shards - kNamed);
  return text;
}

/// How many trials each shard misses that are not kept and none of `failed`.
std::vector<std::size_t> missing_but(const SharedOutSweep& sweep,
                                     const std::unordered_set<std::string>& failed, int shards) {
  auto settled = kept_keys(sweep.store, sweep.flags.keep_builds);
  settled.insert(failed.begin(), failed.end());
  return missing_by_shard(sweep.tasks, settled, shards);
}

}  // namespace

void tell_failed_commands(std::size_t count, const std::filesystem::path& results) {
  if (count > 0)
    std::cerr << fmt::format(
        "sweep: {} trial{} failed before; `mapscore trials {} --state failed` lists them, "
        "--retry_failed tries them again\n",
        count, count > 1 ? "s" : "", shell_word(results.native()));
}

int submit_missing(const SharedOutSweep& sweep) {
  const SweepFlags& flags = sweep.flags;
  const int cpus = flags.jobs_given ? flags.work.jobs : 1;
  std::unordered_set<std::string> failed;
  if (!flags.retry_failed) failed = failed_commands(sweep.store, sweep.tasks);
  SlurmSweep jobs;
  jobs.missing_by_shard = missing_but(sweep, failed, batches_of(sweep, cpus));
  const std::size_t missing = sum_of(jobs.missing_by_shard);
  if (missing == 0) return say_that_all_is_there(sweep, failed.size());
  jobs.results = std::filesystem::absolute(sweep.results).lexically_normal();
  jobs.task = flags.words(sweep.results, cpus);
  jobs.task.insert(jobs.task.begin(), std::filesystem::read_symlink("/proc/self/exe"));
  jobs.merge = jobs.task;
  jobs.task.emplace_back("--shard");
  jobs.merge.insert(jobs.merge.end(),
                    {"--merge_only", "--tasks", std::to_string(jobs.missing_by_shard.size())});
  jobs.options = flags.sbatch_options;
  jobs.cpus = cpus;
  jobs.command = command_text(command_again(sweep, cpus));
  const SlurmJobs submitted = submit_sweep(jobs);
  if (!flags.work.quiet)
    std::cerr << fmt::format(
        "sweep {}: {} missing trials submitted, array job {}, merge job {}; `mapscore status {}` "
        "tells how far they are\n",
        sweep.study, missing, submitted.array, submitted.merge, shell_word(sweep.results.native()));
  return 0;
}

int tell_missing(const SharedOutSweep& sweep) {
  const SweepFlags& flags = sweep.flags;
  // Also with --retry_failed, which the batches have done.
  const auto failed = failed_commands(sweep.store, sweep.tasks);
  const std::vector<std::size_t> missing = missing_but(sweep, failed, flags.tasks.value_or(1));
  if (sum_of(missing) == 0) return say_that_all_is_there(sweep, failed.size());
  tell_failed_commands(failed.size(), sweep.results);
  const auto jobs = read_slurm_jobs(sweep.results);
  const std::string words = command_text(flags.words(sweep.results, flags.work.jobs));
  std::cerr << fmt::format(
      "sweep: {} of {} trials are missing{}; `mapscore trials {}` lists them, {} goes on\n",
      sum_of(missing), sweep.tasks.size(), shards_text(missing), shell_word(sweep.results.native()),
      jobs ? jobs->command : words);
  return 1;
}

}  // namespace mapscore::eval
