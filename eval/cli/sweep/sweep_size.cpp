// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#include "eval/cli/sweep/sweep_size.hpp"

#include "core/error.hpp"
#include "eval/cli/shared/progress.hpp"
#include "eval/lab/runner.hpp"
#include "eval/render/study_recording.hpp"
#include "eval/report/failed_tasks.hpp"
#include "eval/results/plan.hpp"
#include "eval/results/store.hpp"
#include "eval/results/study_store.hpp"
#include "files/text.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <iostream>
#include <map>
#include <string>

namespace mapscore::eval {
namespace {

constexpr std::size_t kManyTrials = 100'000;

std::string counted(std::size_t count, const std::string& noun) {
  return fmt::format("{} {}{}", count, noun, count == 1 ? "" : "s");
}

}  // namespace

SweepSize::SweepSize(const Study& study, const std::filesystem::path& results)
    : cells_(cells(study).size()),
      methods_(study.methods.size()),
      seeds_(static_cast<std::size_t>(study.seeds)),
      last_(read_status(results)) {}

std::size_t SweepSize::trials() const {
  return cells_ * methods_ * seeds_;
}

std::string SweepSize::grid() const {
  return fmt::format("{} x {} x {} = {}", counted(cells_, "cell"), counted(methods_, "method"),
                     counted(seeds_, "seed"), counted(trials(), "trial"));
}

std::string SweepSize::time_of(std::size_t trials) const {
  if (trials == 0) return "none";
  if (!last_ || last_->seconds_per_trial <= 0.0)
    return "unknown, no sweep into this folder has measured it yet";
  return fmt::format("about {}, at {:.3g} s a trial, as the last sweep there with --jobs {}",
                     duration_text(last_->seconds_per_trial * static_cast<double>(trials)),
                     last_->seconds_per_trial, last_->rate_jobs);
}

void SweepSize::refuse_many(bool yes) const {
  if (trials() > kManyTrials && !yes)
    throw Error(
        fmt::format("{}; time: {}; sweep fewer values, or add --yes", grid(), time_of(trials())));
}

void print_dry_run(const Study& study, const std::filesystem::path& results,
                   const SweepFlags& flags) {
  const auto [shard, shards] = flags.shard_of();
  const SweepSize size(study, results);
  std::map<std::string, std::string> hashes;
  std::string recordings;
  bool recording = true;  // all are there
  for (const auto& [name, one] : studies_of_scenes(study)) {
    const std::optional<Recording> there = recording_there(one, results);
    if (there) static_cast<void>(detected_table(one, there->info().table));
    recording = recording && there;
    hashes[name] = there ? there->content_hash() : "";
    recordings += fmt::format(
        "recording{}: {}\n", name.empty() ? "" : " of " + name,
        there ? fmt::format("{}, {} frames", shown(there->folder()), there->frame_count())
              : "not there, is rendered first");
  }
  const TaskList tasks = plan_of(study, RecordingHashes(hashes)).tasks;
  std::unordered_set<std::string> settled;
  std::size_t failed = 0, left = 0;  // of the missing, and of commands that are not tried again
  const std::filesystem::path file = store_file(results);
  if (recording && std::filesystem::exists(file)) {
    const ResultStore store = ResultStore::open_existing(file);
    settled = kept_keys(store, flags.keep_builds);
    failed = failed_tasks(store, tasks).size();
    if (!flags.retry_failed) {
      auto commands = failed_commands(store, tasks);
      left = commands.size();
      failed -= left;
      settled.merge(commands);
    }
  }
  const std::size_t missing = missing_tasks(tasks, settled, 1, 1).size();
  const std::size_t ours =
      shards > 1 ? missing_tasks(tasks, settled, shard, shards).size() : missing;
  std::cout << fmt::format("study {}: {}, {} with ceilings{}\n", shown(study.name), size.grid(),
                           tasks.size(),
                           tasks.size() < size.trials()
                               ? ", as trials that differ in nothing their method reads are one"
                               : "")
            << fmt::format(
                   "{}: {} there, {} missing{}{}{}\n", shown(results),
                   tasks.size() - missing - left, missing,
                   failed ? fmt::format(", {} of them failed before", failed) : "",
                   left ? fmt::format(", {} failed (--retry_failed tries them again)", left) : "",
                   shards > 1 ? fmt::format(", {} in shard {}/{}", ours, shard, shards) : "")
            << recordings << fmt::format("time: {}\n", size.time_of(ours));
}

}  // namespace mapscore::eval
