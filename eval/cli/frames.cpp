// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#include "core/error.hpp"
#include "core/whole_file.hpp"
#include "eval/cli/shared/figure_flags.hpp"
#include "eval/cli/shared/options.hpp"
#include "eval/cli/shared/progress.hpp"
#include "eval/cli/shared/truth_source.hpp"
#include "eval/cli/verbs.hpp"
#include "eval/lab/bench.hpp"
#include "eval/render/study_recording.hpp"
#include "eval/report/figures/frames_figure.hpp"
#include "eval/report/tables/table_formats.hpp"
#include "eval/results/plan.hpp"
#include "eval/results/study_store.hpp"
#include "files/folder_lock.hpp"
#include "files/text.hpp"

#include <fmt/format.h>

#include <filesystem>
#include <iostream>
#include <memory>
#include <string>
#include <vector>

namespace mapscore::eval {
namespace {

namespace fs = std::filesystem;

struct FramesFlags {
  StudyFlags study;
  WorkFlags work;
  int seed = 0;
  bool yes = false;
  std::string format = "text";
  FigureFlags style;
};

/// The trials of one seed at the first cell of the sweep, a method each.
std::vector<Task> tasks_of(const Study& study, int seed, const std::string& recording_hash) {
  std::vector<Task> tasks;
  for (const TrialSpec& spec : trials(study))
    if (spec.seed_index == seed && spec.cell.index == 0)
      tasks.push_back(task_of(study, spec, Labels::detected, recording_hash));
  return tasks;
}

/// All methods walk the frames together, on one thread, so that their times compare.
std::vector<MethodFrames> walk(const Study& study, const std::vector<Task>& tasks,
                               const Recording& recording, const ClassTable& table,
                               const FramesFlags& flags) {
  Bench bench(recording, table, reads_colour(study), flags.work.memory_bytes);
  std::vector<std::unique_ptr<TrialRun>> runs;
  std::vector<MethodFrames> methods;
  for (const Task& task : tasks) {
    runs.push_back(bench.start(task));
    runs.back()->keep_frames();
    methods.push_back({task.config.methods.front().name, {}});
  }
  Progress progress("frames", "frames", flags.work.quiet);
  for (int frame = 0; frame < recording.frame_count(); ++frame) {
    for (std::size_t m = 0; m < runs.size(); ++m) {
      runs[m]->advance(*bench.frame(frame, runs[m]->depth_of(frame)));
      for (const FrameResult& result : runs[m]->take_frames())
        methods[m].frames.push_back(figures_of(result, table));
    }
    progress.show(frame + 1, recording.frame_count());
  }
  return methods;
}

void compare_frames(const FramesFlags& flags) {
  const FigureStyle style = flags.style.style();
  const Study study = study_of_only_scene(flags.study.load());
  if (study.score.unit != ScoreUnit::frame)
    throw Error("score.unit: each frame is scored by itself here; --set score.unit=frame");
  if (flags.seed < 0 || flags.seed >= study.seeds)
    throw Error(fmt::format("no trial of seed {}; seeds: 0 to {}", flags.seed, study.seeds - 1));
  const fs::path results = flags.study.results_folder(study);
  const Recording recording =
      shown_recording("frames", study, results, flags.work.jobs, flags.work.quiet);
  const ClassTable table = detected_table(study, recording.info().table);
  const std::vector<Task> tasks = tasks_of(study, flags.seed, recording.content_hash());
  check_truth_size(tasks.front().config, recording, 1, flags.yes);
  const std::vector<MethodFrames> methods = walk(study, tasks, recording, table, flags);
  const fs::path folder = results / "frames";
  const FolderLock lock(folder);
  fs::create_directories(folder);
  const Table times = frames_table(methods);
  write_whole_file(folder / "by_method.csv", to_csv(times));
  std::cout << formatted(times, flags.format);
  for (const fs::path& file : draw(frames_figure(study, table, methods, style), folder))
    if (flags.format == "text") std::cout << shown(file) << '\n';
}

}  // namespace

void add_frames(CLI::App& program) {
  const auto [verb, flags] = add_verb<FramesFlags>(
      program, "frames", "All methods, frame by frame: voxels, scores, times", compare_frames);
  flags->study.add_to(*verb);
  flags->work.add_to(*verb);
  add_yes_flag(*verb, flags->yes);
  verb->add_option("--seed", flags->seed, "Index of the seed [0]");
  add_format_flag(*verb, flags->format);
  flags->style.add_to(*verb);
  verb->footer(
      "Walks the recording once, all methods side by side on one thread, at the first cell of the "
      "sweep; --set changes doses.\n"
      "Prints a table of times (processor time of a frame, in milliseconds), voxels and scores, "
      "and writes to RESULTS/frames: by_method.csv and the figure by_frame (PNG, PDF, script, "
      "numbers).\n"
      "Examples:\n"
      "  mapscore frames configs/person_sequence.yaml\n"
      "  mapscore frames configs/person_sequence.yaml --set 'sweep={}' --set "
      "faults.depth.preset=astra --format csv");
}

}  // namespace mapscore::eval
