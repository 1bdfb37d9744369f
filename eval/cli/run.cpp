// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#include "core/error.hpp"
#include "core/whole_file.hpp"
#include "eval/cli/shared/options.hpp"
#include "eval/cli/shared/progress.hpp"
#include "eval/cli/shared/trial_maps.hpp"
#include "eval/cli/shared/truth_source.hpp"
#include "eval/cli/verbs.hpp"
#include "eval/lab/bench.hpp"
#include "eval/lab/map_frame.hpp"
#include "eval/render/replay_check.hpp"
#include "eval/render/study_recording.hpp"
#include "eval/report/pictures/pictures.hpp"
#include "eval/report/summary.hpp"
#include "eval/report/table.hpp"
#include "eval/report/tidy_csv.hpp"
#include "eval/results/plan.hpp"
#include "eval/results/study_store.hpp"
#include "files/folder_lock.hpp"
#include "files/text.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <iostream>
#include <memory>
#include <sstream>

namespace mapscore::eval {
namespace {

struct RunFlags {
  StudyFlags study;
  WorkFlags work;
  std::string method;
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
  std::string names;
  for (const MethodSettings& method : study.methods) names += " " + method.name;
  throw Error(fmt::format("no trial of method '{}'; methods:{}", flags.method, names));
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

/// The command that scores the map again, as a comment.
std::string score_command(const std::filesystem::path& map, const Study& study,
                          const Recording& recording, const ClassTable& table, const Task& task,
                          double threshold) {
  const MapFrame frame = map_frame(task.config, task.seed_index);
  std::string command = fmt::format(
      "# mapscore score {} --truth {} --voxel_m {} --origin_m {} {} {} --yaw_deg {} --threshold {}",
      shell_word(map.native()), shell_word(recording.folder().native()), frame.edge_m,
      frame.origin_m.x(), frame.origin_m.y(), frame.origin_m.z(), task.config.map_yaw_deg,
      threshold);
  if (task.config.score.unit == ScoreUnit::frame)
    command += fmt::format(" --frames {}", recording.frame_count() - 1);
  if (study.detect) {
    std::vector<std::string> names;
    for (const SemanticClass& c : table.classes)
      if (c.detect) names.push_back(c.name);
    command += " --detect " + shell_word(fmt::format("{}", fmt::join(names, ",")));
  }
  return shown(command) + '\n';
}

void run(const RunFlags& flags) {
  const std::optional<sim::View> view = flags.view.view();
  const Study study = flags.study.load();
  const std::filesystem::path results = flags.study.results_folder(study);
  const TrialSpec spec = spec_of(study, flags);
  ShownRecording display(flags.work.quiet);
  const Recording recording = recording_of(study, results, flags.work.jobs, display.progress());
  if (const std::string note = note_on_baked(recording.info()); !note.empty())
    std::cerr << "run: " << note << '\n';
  const ClassTable table = detected_table(study, recording.info().table);
  const Task task = task_of(study, spec, Labels::detected, recording.content_hash());
  check_truth_size(task.config, recording, 1, flags.yes);
  const bool by_frame = task.config.score.unit == ScoreUnit::frame;

  Bench bench(recording, table, reads_colour(study), flags.work.memory_bytes);
  const std::unique_ptr<TrialRun> trial = bench.start(task);
  trial->keep_frames();
  Progress progress("run", "frames", flags.work.quiet);
  bench.run(*trial, [&](int done, int all) { progress.show(done, all); });
  const std::filesystem::path folder =
      results / "runs" /
      fmt::format("{}-seed{}-{}", spec.method, spec.seed_index, task.key.substr(0, 8));
  const FolderLock lock(folder);
  std::filesystem::create_directories(folder);
  const TrialResult result = trial->finish();  // which refines the map
  trial->map().save(folder / "map.ot");
  trial->map().export_color(folder / "map_colour.ot", table, trial->threshold());
  std::cout << fmt::format("# {} seed {}{}{}, voxels of {} m, each {} scored, threshold {}\n",
                           spec.method, spec.seed_index, spec.cell.doses.empty() ? "" : " ",
                           text_of(spec.cell), task.config.voxel_m, by_frame ? "frame" : "map",
                           trial->threshold())
            << score_text(result, table) << shown(folder / "map.ot")
            << (by_frame ? " (of the last frame)\n" : "\n") << shown(folder / "map_colour.ot")
            << '\n'
            << score_command(folder / "map.ot", study, recording, table, task, trial->threshold());
  write_frames(*trial, table, folder / "frames.csv");
  const PictureChoice choice{spec.cell.doses, spec.method, spec.seed_index, flags.work.memory_bytes,
                             view};
  print_pictures(draw_pictures(study, table, recording, choice, folder, [&] {
    return by_frame ? map_trials(study, bench, choice)  // of the fullest frame, not the last
                    : std::vector{judged_trial(study, *trial, task, table, spec, {})};
  }));
}

}  // namespace

void add_run(CLI::App& program) {
  const auto [verb, flags] =
      add_verb<RunFlags>(program, "run", "One trial, with its map and pictures of its errors", run);
  flags->study.add_to(*verb);
  flags->work.add_to(*verb);
  add_yes_flag(*verb, flags->yes);
  verb->add_option("--method", flags->method, "Name of a method of the study [the first]");
  verb->add_option("--seed", flags->seed, "Index of the seed [0]");
  flags->view.add_to(*verb);
  verb->footer(
      "The trial is the first cell of the sweep; --set changes doses.\n"
      "Examples:\n"
      "  mapscore run configs/demo.yaml --method region_growing\n"
      "  mapscore run configs/demo.yaml --view 4 1 2.2 5.5 3 0.8\n"
      "  mapscore run configs/demo.yaml --set 'sweep={}' --set faults.depth.preset=astra");
}

}  // namespace mapscore::eval
