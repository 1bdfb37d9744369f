// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#include "eval/cli/shared/trial_maps.hpp"

#include "core/error.hpp"
#include "eval/lab/commands/command_words.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <optional>

namespace mapscore::eval {

void check_choice(const Study& study, const PictureChoice& choice) {
  static_cast<void>(chosen_cell(study, choice));
  const bool has_method =
      !choice.method || std::ranges::any_of(study.methods, [&](const MethodSettings& method) {
        return method.name == *choice.method;
      });
  if (!has_method || choice.seed_index < 0 || choice.seed_index >= study.seeds)
    throw Error(fmt::format("{}seed {}: the study has no such trial; seeds: 0 to {}",
                            choice.method ? "method " + *choice.method + ", " : "",
                            choice.seed_index, study.seeds - 1));
}

std::vector<JudgedMap> map_trials(const Study& study, Bench& bench, const PictureChoice& choice) {
  check_choice(study, choice);
  const Cell cell = chosen_cell(study, choice);
  const Recording& recording = bench.recording();
  const ClassTable& table = bench.table();
  Study undistanced = study;  // pictures need no distances, and those cost most of a truth
  undistanced.score.distances_m.clear();
  std::optional<int> alone;
  if (study.score.unit == ScoreUnit::frame)
    alone = fullest_frame(recording, table, 0, recording.frame_count());

  std::vector<JudgedMap> maps;
  for (const TrialSpec& spec : trials(study)) {
    if (spec.cell != cell || spec.seed_index != choice.seed_index) continue;
    if (choice.method && *choice.method != spec.method) continue;
    if (is_command(study, spec.method)) continue;
    const Task task = task_of(undistanced, spec, Labels::detected, recording.content_hash());
    const std::unique_ptr<TrialRun> run = bench.start(task);
    if (alone) {
      run->advance(*bench.frame(*alone, run->depth_of(*alone)));
    } else {
      bench.run(*run);
      static_cast<void>(run->finish());  // which refines the map
    }
    maps.push_back(judged_trial(study, *run, task, table, spec, alone));
  }
  return maps;
}

}  // namespace mapscore::eval
