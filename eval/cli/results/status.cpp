// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#include "core/error.hpp"
#include "eval/cli/shared/progress.hpp"
#include "eval/cli/verbs.hpp"
#include "eval/report/summary.hpp"
#include "eval/results/plan.hpp"
#include "eval/results/study_store.hpp"
#include "eval/results/sweep_status.hpp"
#include "files/folder_lock.hpp"
#include "files/text.hpp"

#include <fmt/chrono.h>
#include <fmt/format.h>

#include <ctime>
#include <iostream>

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

/// What the store holds of its study.
std::string store_text(const fs::path& file) {
  const ResultStore store = ResultStore::open_existing(file);
  const StudyRecord record = read_study(store, file.parent_path());
  const TaskList tasks = plan_of(record.study, record.recording_hash).tasks;
  const auto held = store.keys();
  const auto failures = store.failures();
  std::size_t done = 0, failed = 0;
  for (std::size_t n = 0; n < tasks.size(); ++n) {
    const std::string key = tasks.key(n);
    const bool there = held.contains(key);
    done += there ? 1 : 0;
    failed += !there && failures.contains(key) ? 1 : 0;
  }
  std::string text = fmt::format(
      "{}: study {}, {} of {} trials and ceilings done, {} failed, {} not tried yet\n", shown(file),
      shown(record.study.name), done, tasks.size(), failed, tasks.size() - done - failed);
  if (failed > 0)
    text += fmt::format("`mapscore trials {} --state failed` says why\n",
                        shown(shell_word(file.parent_path().native())));
  return text;
}

void print_status(const StatusFlags& flags) {
  const fs::path file = store_file(flags.results);
  const fs::path folder = file.has_parent_path() ? file.parent_path() : fs::path(".");
  if (!fs::exists(file))
    throw Error(file.string() + ": no result store there; run `mapscore sweep` first");
  const bool running = FolderLock(folder, WhenTaken::go_on).taken();
  std::cout << store_text(file);
  if (const auto status = read_status(folder))
    std::cout << text_of(*status, running);
  else
    std::cout << "no sweep has left its status here\n";
}

}  // namespace

void add_status(CLI::App& program) {
  const auto [verb, flags] = add_verb<StatusFlags>(
      program, "status", "How far a sweep is: done, failed, rate, time left, who", print_status);
  verb->add_option("RESULTS", flags->results, "Results folder, or its results.sqlite")->required();
  verb->footer(
      "Works beside a running sweep, and after one that has ended, was stopped or killed.\n"
      "Examples:\n"
      "  mapscore status results/demo\n"
      "  watch mapscore status results/demo");
}

}  // namespace mapscore::eval
