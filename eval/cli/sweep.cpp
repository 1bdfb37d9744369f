// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#include "core/error.hpp"
#include "eval/cli/shared/options.hpp"
#include "eval/cli/shared/progress.hpp"
#include "eval/cli/shared/truth_source.hpp"
#include "eval/cli/verbs.hpp"
#include "eval/lab/runner.hpp"
#include "eval/render/replay_check.hpp"
#include "eval/render/study_recording.hpp"
#include "eval/report/summary.hpp"
#include "eval/results/plan.hpp"
#include "eval/results/store.hpp"
#include "eval/results/study_store.hpp"
#include "files/text.hpp"

#include <fmt/format.h>

#include <cstdio>
#include <iostream>

namespace mapscore::eval {
namespace {

struct SweepFlags {
  StudyFlags study;
  WorkFlags work;
  std::string shard = "1/1";
  std::vector<std::string> merged;
  bool yes = false;
};

/// "i/n" with 1 <= i <= n.
std::pair<int, int> parse_shard(const std::string& text) {
  int shard = 0, shards = 0, read = 0;
  if (std::sscanf(text.c_str(), "%d/%d%n", &shard, &shards, &read) != 2 ||
      read != static_cast<int>(text.size()) || shard < 1 || shard > shards)
    throw Error("--shard " + text + ": must be i/n with 1 <= i <= n, e.g. 2/4");
  return {shard, shards};
}

/// A store keeps the trials of every study, and shows those of the last one.
void note_other_study(const ResultStore& store, const std::filesystem::path& results,
                      const Study& study) {
  if (store.text("study").empty()) return;
  const std::string before = read_study(store, results).study.name;
  if (before != study.name)
    std::cerr << fmt::format(
        "sweep: note: {} held study {}; its trials stay, tables will show {}\n", shown(results),
        shown(before), shown(study.name));
}

/// What the lattice ceilings that are there say of the recording.
std::string lattice_note(const TaskList& tasks, const ResultStore& store, const ClassTable& table) {
  LatticeCheck check(table);
  for (std::size_t task = 0; task < tasks.size(); ++task) {
    if (tasks.labels(task) != Labels::truth) continue;
    if (const auto ceiling = store.find(tasks.key(task))) check.add(ceiling->counts);
  }
  return check.note();
}

void sweep(const SweepFlags& flags) {
  const Study study = flags.study.load();
  const std::filesystem::path results = flags.study.results_folder(study);
  const auto [shard, shards] = parse_shard(flags.shard);

  ShownRecording display(flags.work.quiet);
  const Recording recording = recording_of(study, results, flags.work.jobs, display.progress());
  if (const std::string note = note_on_baked(recording.info()); !note.empty())
    std::cerr << "sweep: " << note << '\n';
  const ClassTable table = detected_table(study, recording.info().table);
  const Plan plan = plan_of(study, recording.content_hash());
  check_truth_size(study, recording, plan.tasks.size(), flags.yes);

  ResultStore store = ResultStore::open(results / "results.sqlite");
  if (!flags.work.quiet) note_other_study(store, results, study);
  write_study(store,
              {study, table, recording.content_hash(),
               std::filesystem::relative(recording.folder(), results).string()},
              results);
  for (const std::string& other : flags.merged) {
    const int taken = store.merge(ResultStore::open_existing(store_file(other)));
    if (!flags.work.quiet)
      std::cerr << fmt::format("sweep: {} trials taken over from {}\n", taken, shown(other));
  }
  Progress progress("sweep", "frame evaluations", flags.work.quiet);
  const RunnerOutcome outcome =
      run_plan(plan, recording, table, store,
               {flags.work.jobs, flags.work.memory_bytes, shard, shards,
                [&](std::int64_t done, std::int64_t total) { progress.show(done, total); }});
  if (!flags.work.quiet)
    std::cerr << fmt::format(
        "sweep {}: {} trials computed, {} already there or of other shards; {}\n", study.name,
        outcome.computed, outcome.reused, shown(results / "results.sqlite"));
  if (const std::string note = lattice_note(plan.tasks, store, table); !note.empty())
    std::cerr << "sweep: note: " << note << '\n';
}

}  // namespace

void add_sweep(CLI::App& program) {
  const auto [verb, flags] =
      add_verb<SweepFlags>(program, "sweep", "Compute all trials of a study; resumes", sweep);
  flags->study.add_to(*verb);
  flags->work.add_to(*verb);
  add_yes_flag(*verb, flags->yes);
  verb->add_option("--shard", flags->shard,
                   "Only every n-th trial: i/n, for several processes or machines");
  verb->add_option("--merge", flags->merged, "Take over the trials of another results folder first")
      ->allow_extra_args(false);
  verb->footer(
      "Records the scene first if its recording is not there. A trial that the store holds is "
      "never\n"
      "computed again, so a killed sweep goes on where it stopped.\n"
      "Examples:\n"
      "  mapscore sweep configs/demo.yaml\n"
      "  mapscore sweep configs/demo.yaml -o /data/demo --jobs 8 --memory 4GiB\n"
      "  mapscore sweep configs/demo.yaml --set seeds=20 --set voxel_m=0.02\n"
      "  mapscore sweep configs/demo.yaml -o part2 --shard 2/2\n"
      "  mapscore sweep configs/demo.yaml -o part1 --merge part2");
}

}  // namespace mapscore::eval
