// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#include "eval/cli/shared/slurm_jobs.hpp"

#include "core/error.hpp"
#include "core/whole_file.hpp"
#include "files/command.hpp"
#include "files/file_bytes.hpp"
#include "files/text.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <sstream>
#include <string_view>

namespace mapscore::eval {
namespace {

namespace fs = std::filesystem;

constexpr double kBatchSeconds = 60;
constexpr std::size_t kBatchTrials = 20;
constexpr int kMostBatches = 1000;  // Slurm's MaxArraySize is 1001 unless a site sets another

/// Options of sbatch that say what mapscore says.
constexpr std::array kOurOptions{"--array", "-a", "--dependency", "-d", "--wrap", "--wait", "-W"};

/// Whether sbatch takes a word for an option: whole or, as long ones may be, shortened.
bool names(std::string_view word, std::string_view option) {
  const std::string_view name = word.substr(0, word.find('='));
  return option.size() == 2 ? word.starts_with(option)
                            : name.size() > 2 && option.starts_with(name);
}

fs::path jobs_file(const fs::path& results) {
  return results / "slurm" / "jobs.json";
}

bool is_number(std::string_view text) {
  return is_word(text, "") && text.find_first_not_of("0123456789") == std::string_view::npos;
}

/// A script for sbatch. The command is its first line that is no comment, so no word of it is taken
/// for a directive.
std::string script_of(std::vector<std::string> command, const std::string& last_word,
                      const char* run) {
  for (std::string& word : command) word = shell_word(word);
  return fmt::format("#!/bin/sh\n# Written by `mapscore sweep --slurm`.\nset -- {}{}\n{}\n",
                     fmt::join(command, " "), last_word, run);
}

/// "1-3,7": the shards that miss something.
std::string array_of(const std::vector<std::size_t>& missing) {
  std::string text;
  for (std::size_t first = 0; first < missing.size(); ++first) {
    if (missing[first] == 0) continue;
    std::size_t last = first;
    while (last + 1 < missing.size() && missing[last + 1] > 0) ++last;
    text += fmt::format("{}{}", text.empty() ? "" : ",", first + 1);
    if (last > first) text += fmt::format("-{}", last + 1);
    first = last;
  }
  return text;
}

/// Submits a script that lies in `folder`; the number of its job.
std::string submit(const fs::path& folder, const std::vector<std::string>& ours,
                   const std::vector<std::string>& options, const std::string& script) {
  std::vector<std::string> words{"sbatch", "--parsable"};
  words.insert(words.end(), ours.begin(), ours.end());
  words.insert(words.end(), options.begin(), options.end());
  words.push_back("./" + script);
  const CommandOutcome outcome = run_command(words, folder);
  const std::string said = outcome.err.substr(0, outcome.err.find('\n'));
  if (outcome.exit_code != 0)
    throw Error(fmt::format("sbatch refuses {}: {}", script,
                            said.empty() ? "it said nothing" : shown(said)));
  std::string number = outcome.out.substr(0, outcome.out.find_first_of(";\n"));
  if (!is_number(number))
    throw Error(fmt::format("sbatch: gave no number of a job, but {}", excerpt(outcome.out)));
  return number;
}

void write_jobs(const SlurmJobs& jobs, const fs::path& results) {
  const nlohmann::ordered_json object{{"array", jobs.array},
                                      {"merge", jobs.merge},
                                      {"shards", jobs.shards},
                                      {"command", jobs.command}};
  write_whole_file(jobs_file(results),
                   object.dump(2, ' ', false, nlohmann::json::error_handler_t::replace) + '\n');
}

}  // namespace

void check_slurm(const std::vector<std::string>& sbatch_options, const fs::path& results) {
  if (!program_on_path("sbatch"))
    throw Error(
        "--slurm: no sbatch on this machine; give the command where jobs are submitted, or share "
        "the sweep out by --shard i/n (docs/clusters.md)");
  for (const std::string& option : sbatch_options)
    if (std::ranges::any_of(kOurOptions,
                            [&](std::string_view ours) { return names(option, ours); }))
      throw Error("--slurm: " + option + ": mapscore sets this option of sbatch; leave it out");
  const auto jobs = read_slurm_jobs(results);
  if (const std::string queue = jobs ? queue_text(*jobs) : ""; !queue.empty())
    throw Error(fmt::format(
        "--slurm: jobs {0} and {1} of this folder are in the queue ({2}); wait, or `scancel {0} "
        "{1}`",
        jobs->array, jobs->merge, queue));
}

std::optional<SlurmJobs> read_slurm_jobs(const fs::path& results) {
  const fs::path file = jobs_file(results);
  std::error_code none;
  if (!fs::exists(file, none)) return std::nullopt;
  try {
    const auto object = nlohmann::json::parse(read_file(file));
    SlurmJobs jobs{object.at("array"), object.at("merge"), object.at("shards"),
                   object.at("command")};
    if (is_number(jobs.array) && is_number(jobs.merge)) return jobs;
  } catch (const nlohmann::json::exception&) {
  }
  throw Error(file.string() + ": not what `sweep --slurm` writes; remove it");
}

std::string queue_text(const SlurmJobs& jobs) {
  if (!program_on_path("squeue")) return {};
  std::map<std::string, int> counts;
  for (const std::string& job : {jobs.array, jobs.merge}) {  // one that has ended is refused
    const CommandOutcome queue = run_command({"squeue", "-h", "-r", "-j", job, "-o", "%T"}, "/");
    std::istringstream lines(queue.exit_code == 0 ? queue.out : "");
    for (std::string state; lines >> state;) ++counts[lower_case(state)];
  }
  std::string text;
  for (const auto& [state, count] : counts)
    text += fmt::format("{}{} {}", text.empty() ? "" : ", ", count, shown(state));
  return text;
}

SlurmJobs submit_sweep(const SlurmSweep& sweep) {
  const fs::path folder = sweep.results / "slurm";
  std::error_code ignored;  // writing says what is wrong
  fs::create_directories(folder, ignored);
  const int shards = static_cast<int>(sweep.missing_by_shard.size());
  write_whole_file(folder / "array.sh",
                   script_of(sweep.task, fmt::format(" \"$SLURM_ARRAY_TASK_ID/{}\"", shards),
                             "\"$@\" || \"$@\"  # once more where it was killed; what is done "
                             "stays"));
  write_whole_file(folder / "merge.sh", script_of(sweep.merge, "", "exec \"$@\""));
  SlurmJobs jobs;
  jobs.shards = shards;
  jobs.command = sweep.command;
  jobs.array = submit(folder,
                      {"--job-name=mapscore", "--requeue", "--output=%A_%a.log",
                       fmt::format("--cpus-per-task={}", sweep.cpus),
                       "--array=" + array_of(sweep.missing_by_shard)},
                      sweep.options, "array.sh");
  write_jobs(jobs, sweep.results);  // the merge may begin before it is known by number here
  try {
    jobs.merge = submit(folder,
                        {"--job-name=mapscore-merge", "--requeue", "--output=%j_merge.log",
                         "--dependency=afterany:" + jobs.array},
                        sweep.options, "merge.sh");
  } catch (const Error& error) {
    throw Error(fmt::format("{}; array job {} was submitted: `sbatch --dependency=afterany:{} {}`",
                            error.what(), jobs.array, jobs.array,
                            shell_word((folder / "merge.sh").native())));
  }
  write_jobs(jobs, sweep.results);
  return jobs;
}

int batch_count(std::size_t trials, double seconds_per_trial, int cpus) {
  const double batch = seconds_per_trial > 0 ? kBatchSeconds * cpus / seconds_per_trial
                                             : static_cast<double>(kBatchTrials);
  const double count = std::ceil(static_cast<double>(trials) / std::max(1.0, batch));
  return static_cast<int>(std::clamp(count, 1.0, static_cast<double>(kMostBatches)));
}

}  // namespace mapscore::eval
