// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#include "eval/cli/sweep/sweep_flags.hpp"

#include "core/error.hpp"
#include "eval/cli/shared/slurm_jobs.hpp"
#include "eval/cli/shared/truth_source.hpp"

#include <cstdio>

namespace mapscore::eval {

void SweepFlags::add_to(CLI::App& verb) {
  study.add_to(verb);
  work.add_to(verb);
  add_yes_flag(verb, yes, "Begin a sweep of very many trials, or a truth that takes much memory");
  verb.add_flag("--dry_run", dry_run,
                "Only print how many trials there are, how many are missing, and for how long");
  verb.add_option("--shard", shard,
                  "Only one of n slices of the trials, in a folder of its own below the results: "
                  "i/n, for several processes or machines");
  verb.add_option("--merge", merged,
                  "Take over the trials of another results folder first, and of shards in it")
      ->allow_extra_args(false);
  verb.add_flag("--merge_only", merge_only,
                "Compute nothing: take over what shards in the folder have computed, and end with "
                "1 where trials are missing");
  verb.add_flag("--slurm", slurm,
                "Submit what is missing to Slurm: an array of batches, and a job that merges them; "
                "options of sbatch follow behind --");
  verb.add_option("--tasks", tasks, "How many batches [of about a minute each]")
      ->check(CLI::Range(1, 1'000'000));
  verb.add_option("SBATCH", sbatch_options, "With --slurm: -- and options of sbatch");
  verb.add_flag("--retry_failed", retry_failed,
                "Compute trials anew whose command failed; those of our own methods always are");
  verb.add_flag("--keep_builds", keep_builds, "Keep trials that another build of mapscore made");
}

std::pair<int, int> SweepFlags::shard_of() const {
  int i = 0, n = 0, read = 0;
  if (std::sscanf(shard.c_str(), "%9d/%9d%n", &i, &n, &read) != 2 ||
      read != static_cast<int>(shard.size()) || i < 1 || i > n)
    throw Error("--shard " + shard + ": must be i/n with 1 <= i <= n, e.g. 2/4");
  return {i, n};
}

void SweepFlags::check(const std::filesystem::path& results) const {
  const bool sharded = shard_of().second > 1;
  if (!slurm && !sbatch_options.empty())
    throw Error(sbatch_options.front() + ": one study a sweep; options of sbatch go with --slurm");
  if (!slurm && !merge_only && tasks) throw Error("--tasks: goes with --slurm");
  if (slurm && (sharded || merge_only))
    throw Error("--slurm: submits all shards and their merge; leave --shard and --merge_only out");
  if (sharded && merge_only) throw Error("--merge_only: merges all shards; leave --shard out");
  if (slurm) check_slurm(sbatch_options, results);
}

std::vector<std::string> SweepFlags::words(const std::filesystem::path& results, int jobs) const {
  const auto absolute = [](const std::filesystem::path& path) {
    return std::filesystem::absolute(path).lexically_normal().string();
  };
  std::vector<std::string> words{"sweep", absolute(study.file)};
  for (const std::string& leaf : study.overrides) {
    words.emplace_back("--set");
    words.push_back(leaf);
  }
  for (const std::string& word :
       {std::string("-o"), absolute(results), std::string("--jobs"), std::to_string(jobs),
        std::string("--memory"), std::to_string(work.memory_bytes)})
    words.push_back(word);
  if (yes) words.emplace_back("--yes");
  if (retry_failed) words.emplace_back("--retry_failed");
  if (keep_builds) words.emplace_back("--keep_builds");
  return words;
}

}  // namespace mapscore::eval
