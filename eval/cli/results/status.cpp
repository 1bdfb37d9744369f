// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#include "core/error.hpp"
#include "eval/cli/shared/progress.hpp"
#include "eval/cli/shared/shard_stores.hpp"
#include "eval/cli/shared/slurm_jobs.hpp"
#include "eval/cli/verbs.hpp"
#include "eval/report/failed_tasks.hpp"
#include "eval/results/plan.hpp"
#include "eval/results/searched_trials.hpp"
#include "eval/results/shards.hpp"
#include "eval/results/study_store.hpp"
#include "eval/results/sweep_status.hpp"
#include "files/folder_lock.hpp"
#include "files/suggestion.hpp"
#include "files/text.hpp"

#include <fmt/chrono.h>
#include <fmt/format.h>

#include <algorithm>
#include <ctime>
#include <iostream>
#include <map>
#include <set>
#include <span>
#include <unordered_set>

namespace mapscore::eval {
namespace {

namespace fs = std::filesystem;

struct StatusFlags {
  std::string results;
};

std::string utc(std::int64_t seconds) {
  const auto time = static_cast<std::time_t>(seconds);
  std::tm fields{};
  if (gmtime_r(&time, &fields) == nullptr) return std::to_string(seconds);
  return fmt::format("{:%Y-%m-%d %H:%M:%S} UTC", fields);
}

/// What the last sweep says of itself; `running`: it holds the folder.
std::string text_of(const SweepStatus& status, bool running) {
  const bool killed = status.state == "running" && !running;
  std::string text =
      fmt::format("{} sweep of study {} by {}, shard {}, --jobs {}, started {}, last heard of {}\n",
                  killed ? "killed" : shown(status.state), shown(status.study), shown(status.who),
                  shown(status.shard), status.jobs, utc(status.started_s), utc(status.updated_s));
  text += fmt::format("{} of {} trials computed, {} failed in {}", status.computed, status.missing,
                      status.failed, duration_text(status.seconds));
  if (status.seconds > 0)
    text += fmt::format(", {:.3g} frame evaluations/s",
                        static_cast<double>(status.evaluations) / status.seconds);
  if (const auto left = status.seconds_left(); left && running)
    text += fmt::format(", {} left", duration_text(*left));
  return text + '\n';
}

/// What a store holds of its study.
std::string store_text(const fs::path& file, const ResultStore& store, const StudyRecord& record,
                       const TaskList& tasks) {
  const std::size_t done = held_tasks(store, tasks).all, failed = failed_tasks(store, tasks).size();
  std::string text = fmt::format(
      "{}: study {}, {} of {} trials and ceilings done, {} failed, {} not tried yet\n", shown(file),
      shown(record.study.name), done, tasks.size(), failed, tasks.size() - done - failed);
  if (failed > 0)
    text += fmt::format("`mapscore trials {} --state failed` says why\n",
                        shown(shell_word(file.parent_path().native())));
  return text;
}

/// What tolerance searches asked for, by fault and method; empty where none did.
std::string searched_text(const fs::path& file, const ResultStore& store) {
  const std::vector<SearchedTrial> trials = searched_trials(store);
  const auto held = store.keys();
  if (trials.empty())  // as of a mapscore that did not note them
    return store.text("study").empty()
               ? fmt::format("{}: {} trials, no study swept\n", shown(file), held.size())
               : "";
  std::map<std::string, std::pair<int, int>> searches;  // done, asked for
  int done = 0;
  for (const auto& [key, spec] : trials) {
    std::string search;
    for (const auto& [path, value] : spec.cell.doses)
      search += (search.empty() ? "" : " against ") + path;
    auto& [of_search, asked] = searches[search + ", " + spec.method];
    ++asked;
    if (!held.contains(key)) continue;
    ++of_search;
    ++done;
  }
  std::string text = fmt::format("{}: {} of {} trials of `mapscore tolerance` done\n", shown(file),
                                 done, trials.size());
  for (const auto& [search, count] : searches)
    text += fmt::format("  {}: {} of {}\n", shown(search), count.first, count.second);
  return text;
}

/// What a shard says of itself: finished, stopped, running, or silent where it was killed or its
/// host is out of touch.
std::string state_of(const ShardFolder& shard, const std::optional<SweepStatus>& status) {
  constexpr std::int64_t kSilentSeconds = 60;
  if (!status) return "silent";
  if (status->state != "running") return status->state;
  const bool here =
      shard_folder("", shard.shard, shard.shards).filename() == shard.folder.filename();
  const bool running = here ? FolderLock(shard.folder, WhenTaken::go_on).taken()
                            : std::time(nullptr) - status->updated_s < kSilentSeconds;
  return running ? "running" : "silent";
}

/// How the shards of one set stand, all of so many: how many in each state, and a line for some
/// that have not finished.
std::string shards_text(std::span<const ShardFolder> shards) {
  constexpr int kNamed = 10;
  const int of = shards.front().shards;
  std::map<std::string, int> states;
  std::set<int> begun;
  std::string lines;
  for (int unfinished = 0; const ShardFolder& shard : shards) {
    begun.insert(shard.shard);
    const auto status = read_status(shard.folder);
    const std::string state = state_of(shard, status);
    ++states[state];
    if (state == "finished" || ++unfinished > kNamed) continue;
    lines += fmt::format("  shard {}/{} on {} {}", shard.shard, shard.shards, shown(shard.host),
                         shown(state));
    if (status)
      lines += fmt::format(": {} of {} trials, {} failed, last heard of {}", status->computed,
                           status->missing, status->failed, utc(status->updated_s));
    lines += '\n';
  }
  std::string text = fmt::format("{} shards:", of);
  for (const auto& [state, count] : states) text += fmt::format(" {} {}", count, shown(state));
  if (const auto others = of - static_cast<int>(begun.size()); others > 0)
    text += fmt::format(", {} not begun", others);
  return text + '\n' + lines;
}

/// Of each set of shards by itself; they stand in the order of their sets.
std::string sets_text(const std::vector<ShardFolder>& shards) {
  std::string text;
  for (auto set = shards.begin(); set != shards.end();) {
    const auto end = std::find_if(
        set, shards.end(), [&](const ShardFolder& other) { return other.shards != set->shards; });
    text += shards_text({set, end});
    set = end;
  }
  return text;
}

/// How many tasks of its study the stores of a folder hold together, its own and those of shards.
std::string together_text(const fs::path& folder, const OtherStores& shards) {
  const fs::path file = folder / "results.sqlite";
  std::unordered_set<std::string> keys;
  for (const auto& [name, shard] : shards) keys.merge(shard.keys());
  if (fs::exists(file)) keys.merge(ResultStore::open_existing(file).keys());
  const auto bound = std::ranges::find_if(
      shards, [](const auto& shard) { return !shard.second.text("study").empty(); });
  if (bound == shards.end()) return {};
  const StudyRecord record = read_study(bound->second, folder / "shards" / "any");
  const TaskList tasks = plan_of(record).tasks;
  std::size_t done = 0;
  for (std::size_t n = 0; n < tasks.size(); ++n) done += keys.contains(tasks.key(n)) ? 1 : 0;
  return fmt::format("{} with its shards: study {}, {} of {} trials and ceilings done\n",
                     shown(folder), shown(record.study.name), done, tasks.size());
}

std::string jobs_text(const SlurmJobs& jobs) {
  const std::string queue = queue_text(jobs);
  return fmt::format("slurm: array job {} of {} shards, merge job {}: {}\n", jobs.array,
                     jobs.shards, jobs.merge, queue.empty() ? "not in the queue" : queue);
}

void print_status(const StatusFlags& flags) {
  const fs::path file = store_file(flags.results);
  const fs::path folder = file.has_parent_path() ? file.parent_path() : fs::path(".");
  const std::vector<ShardFolder> shards = shard_folders(folder);
  if (!fs::exists(file) && shards.empty())
    throw Error(file.string() + ": no result store there; " +
                path_suggestion(file, "run `mapscore sweep` first"));
  const bool running = FolderLock(folder, WhenTaken::go_on).taken();
  if (fs::exists(file)) {
    const ResultStore store = ResultStore::open_existing(file);
    if (!store.text("study").empty()) {
      const StudyRecord record = read_study(store, folder);
      std::cout << store_text(file, store, record, plan_of(record).tasks);
    }
    std::cout << searched_text(file, store);
  }
  if (const OtherStores stores = shard_stores(folder); !stores.empty())
    std::cout << together_text(folder, stores);
  if (!shards.empty()) std::cout << sets_text(shards);
  const auto jobs = read_slurm_jobs(folder);
  if (jobs) std::cout << jobs_text(*jobs);
  const auto status = read_status(folder);
  if (running && (!status || status->state != "running"))
    std::cout << "in use by a tolerance search, or a sweep that begins\n";
  if (status)
    std::cout << text_of(*status, running);
  else if (shards.empty() && !jobs && !running)
    std::cout << "no sweep has left its status here\n";
}

}  // namespace

void add_status(CLI::App& program) {
  const auto [verb, flags] = add_verb<StatusFlags>(
      program, "status", "How far a sweep is: done, failed, rate, time left, who", print_status);
  verb->add_option("RESULTS", flags->results, "Results folder, or its results.sqlite")->required();
  verb->footer(
      "Works beside a running sweep, and after one that has ended, was stopped or killed. Counts\n"
      "the shards of a sweep that was shared out, its jobs in Slurm's queue, and the trials of\n"
      "tolerance searches.\n"
      "Examples:\n"
      "  mapscore status results/demo\n"
      "  watch mapscore status results/demo");
}

}  // namespace mapscore::eval
