// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#include "core/error.hpp"
#include "eval/cli/shared/options.hpp"
#include "eval/cli/shared/progress.hpp"
#include "eval/cli/verbs.hpp"
#include "eval/lab/trial_writer.hpp"
#include "eval/render/study_recording.hpp"
#include "eval/results/plan.hpp"
#include "eval/results/study_store.hpp"
#include "files/suggestion.hpp"
#include "files/text.hpp"
#include "files/whole_folder.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <iostream>
#include <memory>
#include <string>
#include <utility>
#include <vector>

namespace mapscore::eval {
namespace {

struct TrialFlags {
  std::string file, output, results, method;
  std::vector<std::string> overrides, cell;  ///< path=value
  int seed = 0;
  WorkFlags work;
};

/// The doses that `--cell` asks for, as the sweep has them. Throws Error where it has none such.
std::vector<std::pair<std::string, std::string>> doses_asked(const Study& study,
                                                             const std::vector<std::string>& cell) {
  std::vector<std::pair<std::string, std::string>> doses;
  for (const std::string& text : cell) {
    const std::size_t equals = text.find('=');
    if (equals == text.npos) throw Error(fmt::format("--cell {}: write it as path=value", text));
    std::vector<std::string> swept;
    for (const SweepAxis& of : study.sweep) swept.push_back(of.path);
    const std::string path =
        path_named(text.substr(0, equals), swept).value_or(text.substr(0, equals));
    const auto axis = std::ranges::find(study.sweep, path, &SweepAxis::path);
    if (axis == study.sweep.end())
      throw Error(
          fmt::format("--cell {}: {} is not swept; --set {} gives a trial outside of the "
                      "sweep",
                      text, path, text));
    Study at = study;
    set_leaf(at, path, text.substr(equals + 1));
    const std::string value = leaf_text(at, path);
    if (std::ranges::find(axis->values, value) == axis->values.end() &&
        points_of(study.sampling) == 0)
      throw Error(fmt::format("--cell {}: the sweep has {}", text, fmt::join(axis->values, ", ")));
    doses.emplace_back(path, value);
  }
  return doses;
}

/// The study, of one of its scenes where it has several; `cell` loses the one that names it.
Study study_of(const TrialFlags& flags, std::vector<std::string>& cell) {
  const Study study = load_study(flags.file, flags.overrides);
  const std::string prefix = std::string(kSceneAxis) + '=';
  const auto scene =
      std::ranges::find_if(cell, [&](const std::string& text) { return text.starts_with(prefix); });
  if (study.scenes.empty() || scene == cell.end()) return study_of_only_scene(study);
  const std::string name = scene->substr(prefix.size());
  cell.erase(scene);
  return with_scene(study, name);
}

/// The first trial of the sweep that the flags leave.
TrialSpec spec_of(const Study& study, const TrialFlags& flags) {
  if (flags.seed < 0 || flags.seed >= study.seeds)
    throw Error(fmt::format("no trial of seed {}; seeds: 0 to {}", flags.seed, study.seeds - 1));
  const std::vector<std::string> names = method_names(study);
  const std::string method = flags.method.empty() ? names.front() : flags.method;
  if (std::ranges::find(names, method) == names.end())
    throw Error(fmt::format("no trial of method '{}'; methods: {}", method, fmt::join(names, " ")));
  const auto asked = doses_asked(study, flags.cell);
  for (const Cell& cell : cells(study))
    if (std::ranges::all_of(asked, [&](const auto& dose) {
          return std::ranges::find(cell.doses, dose) != cell.doses.end();
        }))
      return {0, method, cell, flags.seed};
  throw Error(
      fmt::format("--cell: no cell of the sweep has {}; `mapscore trials RESULTS` lists "
                  "them, --set gives a trial outside of the sweep",
                  fmt::join(flags.cell, " and ")));
}

void write(const TrialFlags& flags) {
  TrialFlags chosen = flags;
  const Study study = study_of(flags, chosen.cell);
  const TrialSpec spec = spec_of(study, chosen);
  WholeFolder whole(flags.output);
  const std::filesystem::path results =
      flags.results.empty() ? "results/" + study.name : flags.results;
  const Recording recording =
      shown_recording("trial", study, results, flags.work.jobs, flags.work.quiet);
  const ClassTable table = detected_table(study, recording.info().table);
  const Task task = task_of(study, spec, Labels::detected, recording.content_hash());
  const Sights sights(task, recording, table);
  PoseSources poses(recording);
  const std::vector<PoseBelief> beliefs = poses.beliefs(task, sights.depth_of_frames());
  write_trial({task, recording, sights, beliefs, recording.folder(),
               [&](int index, int depth_index) {
                 return std::make_shared<const Frame>(recording.read(index, depth_index));
               }},
              whole.partial());
  whole.finish();
  if (!sights.calibration_note().empty())
    std::cerr << fmt::format("trial: {}\n", sights.calibration_note());
  std::cout << fmt::format("{} seed {}{}{}, {} frames\n{}\n", spec.method, spec.seed_index,
                           spec.cell.doses.empty() ? "" : " ", text_of(spec.cell),
                           recording.frame_count(), shown(flags.output));
}

}  // namespace

void add_trial(CLI::App& program) {
  const auto [verb, flags] = add_verb<TrialFlags>(
      program, "trial", "Write what the method of a trial sees, as a folder of files", write);
  verb->add_option("STUDY", flags->file, "Study file (YAML)")->required();
  verb->add_option("-o,--output", flags->output, "Folder to write; must not exist")->required();
  verb->add_option("--cell", flags->cell,
                   "A swept path and its value, path=value; may be repeated [the first cell]")
      ->allow_extra_args(false);
  verb->add_option("--set", flags->overrides, "Override a key of the study; may be repeated")
      ->allow_extra_args(false);
  verb->add_option("--method", flags->method, "Name of a method of the study [the first]");
  verb->add_option("--seed", flags->seed, "Index of the seed [0]");
  verb->add_option(
      "--results", flags->results,
      "Folder of the results, where the recording is or is rendered to [results/NAME]");
  flags->work.add_without_memory_to(*verb);
  verb->footer(
      "Images that no dose touches are hard links to those of the recording: map them, do not "
      "change them.\n"
      "`mapscore map FOLDER` maps the folder as the trial does. docs/formats.md has its files.\n"
      "Examples:\n"
      "  mapscore trial configs/demo.yaml --cell magnitude_m=0.02 --seed 3 -o trial\n"
      "  mapscore trial configs/demo.yaml --set 'sweep={}' --set faults.depth.preset=astra -o "
      "trial");
}

}  // namespace mapscore::eval
