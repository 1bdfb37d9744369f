// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#include "core/error.hpp"
#include "eval/cli/shared/live_status.hpp"
#include "eval/cli/shared/progress.hpp"
#include "eval/cli/shared/shard_stores.hpp"
#include "eval/cli/shared/stop_signal.hpp"
#include "eval/cli/shared/truth_source.hpp"
#include "eval/cli/sweep/slurm_sweep.hpp"
#include "eval/cli/sweep/sweep_flags.hpp"
#include "eval/cli/sweep/sweep_size.hpp"
#include "eval/cli/verbs.hpp"
#include "eval/lab/runner.hpp"
#include "eval/render/study_recording.hpp"
#include "eval/report/summary.hpp"
#include "eval/results/plan.hpp"
#include "eval/results/shards.hpp"
#include "eval/results/store.hpp"
#include "eval/results/study_store.hpp"
#include "eval/score/lattice_check.hpp"
#include "files/folder_lock.hpp"
#include "files/text.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <iostream>
#include <memory>
#include <numeric>
#include <optional>
#include <utility>
#include <vector>

namespace mapscore::eval {
namespace {

/// A store keeps the trials of every study, and shows those of the last one.
void note_other_study(const ResultStore& store, const std::filesystem::path& results,
                      const Study& study, bool merge_only, bool quiet) {
  if (store.text("study").empty()) return;
  const std::string before = read_study(store, results).study.name;
  if (before != study.name && merge_only)
    throw Error(fmt::format(
        "{} holds study {}; --merge_only does not bind it to {}: take that study, or another -o",
        shown(results), shown(before), shown(study.name)));
  if (before != study.name && !quiet)
    std::cerr << fmt::format(
        "sweep: note: {} held study {}; its trials stay, tables will show {}\n", shown(results),
        shown(before), shown(study.name));
}

void note_other_builds(const HeldTasks& held, bool keep) {
  if (held.of_other_builds > 0)
    std::cerr << fmt::format("sweep: {} trials were made by another build; {}\n",
                             held.of_other_builds,
                             keep ? "kept" : "computed anew (--keep_builds keeps them)");
}

/// A scene of the study, or all of one without scenes.
struct SweptScene {
  std::string name;
  Recording recording;
  ClassTable table;
};

/// Where a sweep works.
struct Workplace {
  const SweepFlags& flags;
  const Study& study;
  std::filesystem::path whole;    ///< the results folder, with the recordings
  std::filesystem::path results;  ///< where this sweep's store is: the same, or that of its shard
  const std::vector<SweptScene>& scenes;
  const StudyRecord& record;
  const Plan& plan;
};

/// What the lattice ceilings that are there say of a recording.
std::string lattice_note(const TaskList& tasks, const ResultStore& store, const SweptScene& scene) {
  LatticeCheck check(scene.table);
  for (std::size_t task = 0; task < tasks.size(); ++task) {
    if (tasks.labels(task) != Labels::truth ||
        tasks.recording_hash(task) != scene.recording.content_hash())
      continue;
    if (const auto ceiling = store.find(tasks.key(task))) check.add(ceiling->counts);
  }
  const std::string note = check.note();
  return note.empty() || scene.name.empty() ? note : fmt::format("{}: {}", scene.name, note);
}

/// The store, bound to the study, with the trials of `merged` and, unless it is itself of a shard,
/// of the shards in its folder.
ResultStore bound_store(const Workplace& at, const OtherStores& merged) {
  const bool quiet = at.flags.work.quiet;
  ResultStore store = ResultStore::open(at.results / "results.sqlite");
  note_other_study(store, at.results, at.study, at.flags.merge_only, quiet);
  write_study(store, at.record, at.results);
  for (const auto& [name, other] : merged) {
    const int taken = take_over(store, other);
    if (!quiet) std::cerr << fmt::format("sweep: {} trials taken over from {}\n", taken, name);
  }
  if (at.results != at.whole) return store;
  if (const int taken = take_over_shards(store, at.whole); taken > 0 && !quiet)
    std::cerr << fmt::format("sweep: {} trials taken over from shards\n", taken);
  return store;
}

/// Keys that a sweep does not compute: of trials that are there, and of commands that failed.
struct SettledKeys {
  std::unordered_set<std::string> held, failed;
};

/// Those of the store and, of a shard, of the whole folder.
SettledKeys settled_keys(const Workplace& at, const ResultStore& store) {
  SettledKeys keys;
  const auto add = [&](const ResultStore& of) {
    keys.held.merge(kept_keys(of, at.flags.keep_builds));
    if (!at.flags.retry_failed) keys.failed.merge(failed_commands(of, at.plan.tasks));
  };
  add(store);
  const std::filesystem::path file = store_file(at.whole);
  if (at.results != at.whole && std::filesystem::exists(file))
    add(ResultStore::open_existing(file));
  std::erase_if(keys.failed, [&](const std::string& key) { return keys.held.contains(key); });
  return keys;
}

/// Frame evaluations that each scene misses.
std::vector<std::int64_t> evaluations(const Workplace& at,
                                      const std::vector<std::size_t>& missing) {
  std::vector<std::int64_t> of_scenes;
  for (const SweptScene& scene : at.scenes) {
    const auto is_of = [&](std::size_t task) {
      return at.plan.tasks.recording_hash(task) == scene.recording.content_hash();
    };
    of_scenes.push_back(std::ranges::count_if(missing, is_of) * scene.recording.frame_count());
  }
  return of_scenes;
}

/// One scene after the other.
RunnerOutcome computed(const Workplace& at, ResultStore& store, const StopSignal& stop) {
  const WorkFlags& work = at.flags.work;
  const auto [shard, shards] = at.flags.shard_of();
  SweepStatus first;
  first.study = at.study.name;
  first.shard = at.flags.shard;
  first.jobs = work.jobs;
  const bool keep_builds = at.flags.keep_builds;
  SettledKeys settled = settled_keys(at, store);
  const std::size_t failed_before = settled.failed.size();
  settled.held.merge(settled.failed);
  RunnerOptions options{work.jobs, work.memory_bytes, shard,
                        shards,    keep_builds,       std::move(settled.held)};
  const std::vector<std::size_t> missing =
      missing_tasks(at.plan.tasks, options.held_elsewhere, shard, shards);
  const std::vector<std::int64_t> planned = evaluations(at, missing);
  first.missing = static_cast<std::int64_t>(missing.size());
  if (!work.quiet) note_other_builds(held_tasks(store, at.plan.tasks), keep_builds);
  std::int64_t before = 0, after = std::reduce(planned.begin(), planned.end());
  const int frames = missing.empty() ? at.scenes.front().recording.frame_count()
                                     : static_cast<int>(after / first.missing);
  LiveStatus status(std::move(first), at.results, frames);
  Progress progress("sweep", "frame evaluations", work.quiet);
  RunnerOutcome all;
  options.progress = [&](std::int64_t done, std::int64_t total) {
    progress.show(before + done, before + total + after);
    status.progress(before + done, before + total + after);
  };
  options.ended = [&](std::size_t done, std::size_t failed) {
    status.ended(all.computed + done, all.failures.size() + failed);
  };
  options.stop = [&] { return stop.taken() != 0; };
  all.reused = at.plan.tasks.size() - missing.size() - failed_before;
  for (std::size_t n = 0; n < at.scenes.size() && !all.stopped; ++n) {
    after -= planned[n];
    const RunnerOutcome one =
        run_plan(at.plan, at.scenes[n].recording, at.scenes[n].table, store, options);
    all.computed += one.computed;
    all.sights += one.sights;
    all.failures.insert(all.failures.end(), one.failures.begin(), one.failures.end());
    all.stopped = one.stopped;
    before += planned[n];
  }
  status.end(all.stopped ? "stopped" : "finished");
  return all;
}

/// The failures, and what to do about them; `commands`: how many are of commands, of earlier sweeps
/// too. Throws Error where all there is failed.
void tell_failures(const RunnerOutcome& outcome, std::size_t commands,
                   const std::filesystem::path& results) {
  if (outcome.failures.empty()) return tell_failed_commands(commands, results);
  const TrialFailure& first = outcome.failures.front();
  const std::string how = outcome.failures.size() > 1 ? fmt::format("{} trials failed, the first: ",
                                                                    outcome.failures.size())
                                                      : "1 trial failed: ";
  if (outcome.computed + outcome.reused == 0 && !outcome.stopped) throw Error(how + first.reason);
  std::cerr << fmt::format(
      "sweep: {}{}; `mapscore trials {} --state failed` lists them, the same sweep tries them "
      "again{}\n",
      how, shown(first.reason), shell_word(results.native()),
      commands > 0 ? ", where a command failed with --retry_failed alone" : "");
}

/// Computes what is missing.
int compute(const Workplace& at, ResultStore& store) {
  const TaskList& tasks = at.plan.tasks;
  const StopSignal stop;
  const RunnerOutcome outcome = computed(at, store, stop);
  const std::size_t failed = failed_commands(store, tasks).size();
  tell_failures(outcome, failed, at.results);
  if (outcome.stopped) {
    std::cerr << fmt::format(
        "sweep: stopped; {} of {} trials are in {}; the same command goes on where it stopped\n",
        held_tasks(store, tasks).all, tasks.size(), shown(at.results / "results.sqlite"));
    return 128 + stop.taken();
  }
  if (!at.flags.work.quiet)
    std::cerr << fmt::format(
        "sweep {}: {} trials computed, {} already there or of other shards; {}\n", at.study.name,
        outcome.computed, outcome.reused, shown(at.results / "results.sqlite"));
  for (const SweptScene& scene : at.scenes)
    if (const std::string note = lattice_note(tasks, store, scene); !note.empty())
      std::cerr << "sweep: note: " << note << '\n';
  return outcome.failures.empty() && failed == 0 ? 0 : 1;
}

/// Records what is not there, scene by scene.
std::vector<SweptScene> scenes_of(const Study& study, const std::filesystem::path& whole,
                                  const WorkFlags& work) {
  std::vector<SweptScene> scenes;
  for (const auto& [name, one] : studies_of_scenes(study)) {
    Recording recording = shown_recording("sweep", one, whole, work.jobs, work.quiet);
    ClassTable table = detected_table(one, recording.info().table);
    scenes.push_back({name, std::move(recording), std::move(table)});
  }
  return scenes;
}

StudyRecord recorded(const Study& study, const std::vector<SweptScene>& scenes,
                     const std::filesystem::path& results) {
  // Absolute, since of a relative folder that is not there yet nothing is relative to it.
  const std::filesystem::path store = std::filesystem::absolute(results);
  std::vector<std::pair<SceneRecord, ClassTable>> records;
  for (const SweptScene& scene : scenes)
    records.push_back({{scene.name,
                        scene.recording.content_hash(),
                        std::filesystem::relative(scene.recording.folder(), store).string(),
                        {}},
                       scene.table});
  return record_of(study, records);
}

int sweep(const SweepFlags& flags) {
  const Study study = flags.study.load();
  const std::filesystem::path whole = flags.study.results_folder(study);
  const auto [shard, shards] = flags.shard_of();
  flags.check(whole);
  const OtherStores merged = stores_of(flags.merged);
  if (flags.dry_run) {
    print_dry_run(study, whole, flags);
    return 0;
  }
  SweepSize(study, whole).refuse_many(flags.yes);

  const std::filesystem::path results = shards > 1 ? shard_folder(whole, shard, shards) : whole;
  const std::vector<SweptScene> scenes = scenes_of(study, whole, flags.work);
  StudyRecord record = recorded(study, scenes, results);
  const Plan plan = plan_of(study, record.hashes());
  record.inputs = plan.inputs;
  for (const SweptScene& scene : scenes)
    check_truth_size(study, scene.recording, plan.tasks.size(), flags.yes);

  std::optional<FolderLock> lock;
  enter_results("sweep", results, flags.work.quiet, lock);
  const Workplace at{flags, study, whole, results, scenes, record, plan};
  ResultStore store = bound_store(at, merged);
  const SharedOutSweep shared_out{flags, whole, study.name, plan.tasks, store};
  if (flags.slurm) {
    lock.reset();  // for the merge
    return submit_missing(shared_out);
  }
  return flags.merge_only ? tell_missing(shared_out) : compute(at, store);
}

}  // namespace

void add_sweep(CLI::App& program, int& exit_code) {
  auto* verb = program.add_subcommand("sweep", "Compute all trials of a study; resumes");
  const auto flags = std::make_shared<SweepFlags>();
  verb->callback([flags, verb, &exit_code] {
    flags->jobs_given = verb->count("--jobs") > 0;
    exit_code = sweep(*flags);
  });
  flags->add_to(*verb);
  verb->footer(
      "Records the scene first if its recording is not there. A trial that this build made is\n"
      "never computed again, so a killed sweep goes on where it stopped. A trial that fails is\n"
      "left out, and tried again by the next sweep; one whose command failed by --retry_failed. "
      "`mapscore status` tells from another shell "
      "how\n"
      "far it is.\n"
      "Ends with 1 when some trials failed, with 130 by Ctrl-C; then what is done is kept.\n"
      "Examples:\n"
      "  mapscore sweep configs/demo.yaml\n"
      "  mapscore sweep configs/demo.yaml --dry_run\n"
      "  mapscore sweep configs/demo.yaml -o /data/demo --jobs 8 --memory 4GiB\n"
      "  mapscore sweep configs/demo.yaml --set seeds=20 --set voxel_m=0.02\n"
      "  mapscore sweep configs/demo.yaml -o results/demo --shard 2/8      one of eight processes\n"
      "  mapscore sweep configs/demo.yaml -o results/demo      takes over what shards have done\n"
      "  mapscore sweep configs/demo.yaml -o here --merge there\n"
      "  mapscore sweep configs/demo.yaml --slurm -- --partition=main --time=30");
}

}  // namespace mapscore::eval
