// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#include "core/error.hpp"
#include "core/whole_file.hpp"
#include "eval/cli/shared/options.hpp"
#include "eval/cli/shared/progress.hpp"
#include "eval/cli/shared/score_command.hpp"
#include "eval/cli/shared/trial_maps.hpp"
#include "eval/cli/shared/truth_source.hpp"
#include "eval/cli/verbs.hpp"
#include "eval/lab/bench.hpp"
#include "eval/render/study_recording.hpp"
#include "eval/report/pictures/pictures.hpp"
#include "eval/report/summary.hpp"
#include "eval/report/tables/table_formats.hpp"
#include "eval/report/tables/tidy_csv.hpp"
#include "eval/report/trial_list.hpp"
#include "eval/results/plan.hpp"
#include "eval/results/searched_trials.hpp"
#include "eval/results/study_store.hpp"
#include "files/folder_lock.hpp"
#include "files/text.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <iostream>
#include <memory>
#include <optional>
#include <sstream>
#include <utility>
#include <vector>

namespace mapscore::eval {
namespace {

struct RunFlags {
  StudyFlags study;
  WorkFlags work;
  std::string method, key;
  int seed = 0;
  bool yes = false;
  ViewFlag view;
};

TrialSpec spec_of(const Study& study, const RunFlags& flags) {
  if (flags.seed < 0 || flags.seed >= study.seeds)
    throw Error(fmt::format("no trial of seed {}; seeds: 0 to {}", flags.seed, study.seeds - 1));
  for (const TrialSpec& spec : trials(study))
    if (spec.seed_index == flags.seed && (flags.method.empty() || spec.method == flags.method))
      return spec;
  throw Error(fmt::format("no trial of method '{}'; methods: {}", flags.method,
                          fmt::join(method_names(study), " ")));
}

/// Which frames were mapped, and how poses and calibration came about, where that is to be said.
std::string accounting_text(const Accounting& accounting, const Sights& sights) {
  std::string text;
  if (accounting.frames_left_out > 0)
    text += fmt::format("# {} of {} frames mapped, the others are no key frames\n",
                        accounting.frames - accounting.frames_left_out, accounting.frames);
  if (accounting.frames_unsure > 0)
    text += fmt::format("# {} of {} frames: mended with a confidence below 0.5\n",
                        accounting.frames_unsure, accounting.frames);
  if (accounting.tracking) text += fmt::format("# poses: {}\n", accounting.tracking->text());
  if (!sights.calibration_note().empty()) text += "# " + sights.calibration_note() + "\n";
  return text;
}

std::string score_text(const TrialResult& result, const ClassTable& table) {
  Table scores;
  scores.columns = {"class", "precision", "recall",   "F1",      "IoU",   "predicted",
                    "near",  "leak",      "floating", "visible", "missed"};
  const auto add = [&](const std::string& name, const ClassCounts& c) {
    std::vector<std::string> row{name};
    for (const auto& value : {precision(c), recall(c), f1(c), iou(c)})
      row.push_back(value ? fmt::format("{:.3f}", *value) : "-");
    for (const std::int64_t count : {c.predicted, c.false_near, c.false_leak, c.false_floating,
                                     c.visible, c.visible - c.found})
      row.push_back(std::to_string(count));
    scores.rows.push_back(std::move(row));
  };
  for (const SemanticClass& c : table.classes)
    if (c.detect) add(c.name, result.counts[c.id]);
  add(std::string(kPooled), pool_detected(result.counts, table));
  return to_text(scores);
}

void print_pictures(const Pictures& pictures) {
  for (const std::filesystem::path& file : pictures.files) std::cout << shown(file) << '\n';
  if (!pictures.skipped.empty())
    std::cerr << "mapscore: no pictures: " << shown(pictures.skipped) << '\n';
}

/// Writes the figures of each frame where each was scored by itself, and prints the path.
void write_frames(const TrialRun& trial, const ClassTable& table,
                  const std::filesystem::path& file) {
  if (trial.frames().empty()) return;
  std::ostringstream csv;
  write_frames_csv(trial.frames(), table, csv);
  write_whole_file(file, csv.str());
  std::cout << shown(file) << '\n';
}

/// A trial to run, and all that it stands on.
struct ChosenTrial {
  Study study;
  std::filesystem::path results;
  Recording recording;
  ClassTable table;
  TrialSpec spec;
  Role role = Role::trial;
  Task task;
  std::optional<TrialResult> stored = {};  ///< what the store holds of a repeated one
};

ChosenTrial trial_of_study(const RunFlags& flags) {
  if (const std::string& file = flags.study.file;
      std::filesystem::is_directory(file) && std::filesystem::exists(store_file(file)))
    throw Error(fmt::format(
        "{0}: holds results; `mapscore trials {0}` lists its trials, --trial KEY repeats one",
        file));
  Study study = study_of_only_scene(flags.study.load());
  std::filesystem::path results = flags.study.results_folder(study);
  TrialSpec spec = spec_of(study, flags);
  Recording recording = shown_recording("run", study, results, flags.work.jobs, flags.work.quiet);
  ClassTable table = detected_table(study, recording.info().table);
  Task task = task_of(study, spec, Labels::detected, recording.content_hash());
  return {std::move(study), std::move(results), std::move(recording), std::move(table),
          std::move(spec),  Role::trial,        std::move(task)};
}

/// Of a searched trial a store keeps no study; says how to repeat it.
void refuse_searched(const ResultStore& store, const std::string& begin) {
  const auto all = searched_trials(store);
  const auto begins = [&](const auto& trial) { return trial.key.starts_with(begin); };
  if (std::ranges::count_if(all, begins) > 1)
    throw Error(fmt::format(
        "--trial {}: several keys of `mapscore tolerance` begin so; write more of it", begin));
  for (const auto& [key, spec] : all) {
    if (!key.starts_with(begin)) continue;
    std::string command = fmt::format("mapscore run STUDY --method {} --seed {} --set seeds={}",
                                      spec.method, spec.seed_index, spec.seed_index + 1);
    command += " --set 'sweep={}'";
    for (const auto& [path, value] : spec.cell.doses)
      command += fmt::format(" --set {}={}", path, value);
    throw Error(
        fmt::format("--trial {}: is of `mapscore tolerance`; `{}` repeats it, with the "
                    "study that was searched",
                    begin, command));
  }
}

/// The one task whose key begins with `begin`.
ListedTask task_of_key(const Plan& plan, const ResultStore& store, const std::string& begin,
                       const std::string& results) {
  std::vector<ListedTask> found;
  visit_tasks(plan, [&](const ListedTask& listed) {
    if (plan.tasks.key(listed.task).starts_with(begin)) found.push_back(listed);
    return found.size() < 2;
  });
  if (found.size() == 1) return found.front();
  if (found.empty()) refuse_searched(store, begin);
  throw Error(fmt::format("--trial {}: {}; `mapscore trials {}` lists the keys", begin,
                          found.empty() ? "no trial of the study has this key"
                                        : "several keys begin so; write more of it",
                          results));
}

ChosenTrial trial_of_store(const RunFlags& flags) {
  const std::string& results = flags.study.file;
  if (!flags.study.overrides.empty())
    throw Error("--set: stands beside --trial, which repeats a trial as it is; leave one out");
  const std::filesystem::path file = store_file(results);
  const ResultStore store = ResultStore::open_existing(file);
  if (store.text("study").empty() && !searched_trials(store).empty()) {
    refuse_searched(store, flags.key);
    throw Error(
        fmt::format("--trial {}: no trial has this key; `mapscore trials {}` lists the keys",
                    flags.key, results));
  }
  StudyRecord record = read_study(store, file.parent_path());
  const Plan plan = plan_of(record);
  ListedTask listed = task_of_key(plan, store, flags.key, results);
  Task task = plan.tasks[listed.task];
  auto stored = store.find(task.key);
  auto [of_scene, recording] =
      scene_of(record, file.parent_path(), scene_of(record.study, listed.spec.cell));
  check_inputs(record, of_scene.study);
  listed.spec.cell.doses = doses_of_scene(record.study, listed.spec.cell.doses);
  record = std::move(of_scene);
  return {
      std::move(record.study),
      flags.study.results.empty() ? file.parent_path() : std::filesystem::path(flags.study.results),
      std::move(recording),
      std::move(record.table),
      std::move(listed.spec),
      listed.role,
      std::move(task),
      std::move(stored)};
}

std::string name_of(const ChosenTrial& chosen) {
  return chosen.role == Role::trial ? chosen.spec.method : name_of(chosen.role);
}

void print_scores(const ChosenTrial& chosen, const TrialRun& trial, const TrialResult& result,
                  const std::filesystem::path& folder) {
  const auto& [study, results, recording, table, spec, role, task, stored] = chosen;
  const bool by_frame = task.config.score.unit == ScoreUnit::frame;
  std::cout << fmt::format("# {} seed {}{}{}, voxels of {} m, each {} scored, threshold {}\n",
                           name_of(chosen), spec.seed_index, spec.cell.doses.empty() ? "" : " ",
                           text_of(spec.cell), task.config.voxel_m, by_frame ? "frame" : "map",
                           trial.threshold())
            << accounting_text(result.accounting, *trial.sights()) << score_text(result, table)
            << shown(folder / "map.ot") << (by_frame ? " (of the last frame)\n" : "\n")
            << shown(folder / "map_colour.ot") << '\n'
            << score_command(folder / "map.ot", study, recording, table, task, trial.threshold());
}

void print_pictures_of(const ChosenTrial& chosen, const RunFlags& flags, Bench& bench,
                       const TrialRun& trial, const std::filesystem::path& folder) {
  const auto& [study, results, recording, table, spec, role, task, stored] = chosen;
  if (role != Role::trial) return print_pictures({{}, "it is a ceiling; its map is there"});
  const PictureChoice choice{spec.cell.doses, spec.method, spec.seed_index, flags.work.memory_bytes,
                             flags.view.view()};
  print_pictures(draw_pictures(study, table, recording, choice, folder, [&] {
    return task.config.score.unit == ScoreUnit::frame
               ? map_trials(study, bench, choice)  // of the fullest frame, not the last
               : std::vector{judged_trial(study, trial, task, table, spec, {})};
  }));
}

/// Whether a repeated trial has the counts that are stored; prints it.
bool same_as_stored(const ChosenTrial& chosen, const TrialResult& result) {
  if (!chosen.stored) {
    std::cout << "# not in the store\n";
    return true;
  }
  const bool same = to_json(*chosen.stored) == to_json(result);
  std::cout << (same ? "# counts equal to those stored\n" : "# counts DIFFER from those stored\n");
  return same;
}

int run(const RunFlags& flags) {
  static_cast<void>(flags.view.view());  // refused before the work
  const ChosenTrial chosen = flags.key.empty() ? trial_of_study(flags) : trial_of_store(flags);
  const Task& task = chosen.task;
  check_truth_size(task.config, chosen.recording, 1, flags.yes);

  Bench bench(chosen.recording, chosen.table, reads_colour(task.config), flags.work.memory_bytes);
  const std::unique_ptr<TrialRun> trial = bench.start(task);
  trial->keep_frames();
  Progress progress("run", "frames", flags.work.quiet);
  bench.run(*trial, [&](int done, int all) { progress.show(done, all); });
  const std::filesystem::path folder =
      chosen.results / "runs" /
      fmt::format("{}-seed{}-{}", name_of(chosen), chosen.spec.seed_index, task.key.substr(0, 8));
  const FolderLock lock(folder);
  std::filesystem::create_directories(folder);
  const TrialResult result = trial->finish();  // which refines the map
  trial->map().save(folder / "map.ot");
  trial->map().export_color(folder / "map_colour.ot", chosen.table, trial->threshold());
  print_scores(chosen, *trial, result, folder);
  const bool same = flags.key.empty() || same_as_stored(chosen, result);
  write_frames(*trial, chosen.table, folder / "frames.csv");
  print_pictures_of(chosen, flags, bench, *trial, folder);
  return same ? 0 : 1;
}

}  // namespace

void add_run(CLI::App& program, int& exit_code) {
  auto* verb = program.add_subcommand("run", "One trial, with its map and pictures of its errors");
  const auto flags = std::make_shared<RunFlags>();
  verb->callback([flags, &exit_code] { exit_code = run(*flags); });
  flags->study.add_to(*verb, "STUDY or RESULTS",
                      "Study file (YAML), or with --trial a results folder");
  flags->work.add_to(*verb);
  add_yes_flag(*verb, flags->yes);
  auto* method =
      verb->add_option("--method", flags->method, "Name of a method of the study [the first]");
  auto* seed = verb->add_option("--seed", flags->seed, "Index of the seed [0]");
  verb->add_option("--trial", flags->key,
                   "With RESULTS: repeat the trial whose key begins so, and "
                   "compare its counts with those stored")
      ->excludes(method)
      ->excludes(seed);
  flags->view.add_to(*verb);
  verb->footer(
      "The trial is the first cell of the sweep; --set changes doses. --trial ends with 1 when "
      "the\n"
      "counts differ from those stored. Map and pictures go to RESULTS/runs; with --set\n"
      "score.unit=frame also frames.csv, the figures of each frame by itself.\n"
      "Examples:\n"
      "  mapscore run configs/demo.yaml --method region_growing\n"
      "  mapscore run configs/demo.yaml --view 4 1 2.2 5.5 3 0.8\n"
      "  mapscore run configs/demo.yaml --set 'sweep={}' --set faults.depth.preset=astra\n"
      "  mapscore run results/demo --trial 5c1f09ab     as `mapscore trials results/demo` lists "
      "it");
}

}  // namespace mapscore::eval
