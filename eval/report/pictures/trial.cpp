// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#include "eval/report/pictures/trial.hpp"

#include "core/error.hpp"
#include "eval/lab/map_frame.hpp"
#include "eval/lab/trial_run.hpp"
#include "eval/report/axes.hpp"
#include "eval/results/plan.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace mapscore::eval {
namespace {

std::string wanted_value(const SweepAxis& axis, const PictureChoice& choice) {
  for (const auto& [path, value] : choice.doses)
    if (path == axis.path) return value;
  return axis.values[axis.values.size() / 2];
}

void check_paths(const Study& study, const PictureChoice& choice) {
  for (const auto& [path, value] : choice.doses) {
    const auto axis = std::find_if(study.sweep.begin(), study.sweep.end(),
                                   [&path = path](const SweepAxis& a) { return a.path == path; });
    std::string swept;
    for (const SweepAxis& a : study.sweep) swept += " " + a.path;
    if (axis == study.sweep.end())
      throw Error(fmt::format("{}: the study does not sweep it; swept:{}", path, swept));
    std::string values;
    for (const std::string& v : axis->values) values += " " + v;
    if (std::find(axis->values.begin(), axis->values.end(), value) == axis->values.end())
      throw Error(fmt::format("{}: the study has no value {}; values:{}", path, value, values));
  }
}

/// ASCII, since OpenCV writes nothing else.
std::string title_of(const Study& study, const TrialSpec& spec, std::optional<int> frame) {
  std::string title = spec.method;
  for (const auto& [path, value] : spec.cell.doses) {
    std::string text = figure_axis(study, {path, {value}}).text(0);
    for (const auto& [letter, ascii] : {std::pair{"σ", "sigma"}, {"×", "x"}})
      if (const std::size_t at = text.find(letter); at != std::string::npos)
        text.replace(at, std::string(letter).size(), ascii);
    title += ", " + text;
  }
  title += fmt::format(", seed {}", spec.seed_index);
  return frame ? title + fmt::format(", frame {}", *frame) : title;
}

}  // namespace

Cell chosen_cell(const Study& study, const PictureChoice& choice) {
  check_paths(study, choice);
  for (Cell& cell : cells(study)) {
    std::size_t fitting = 0;
    for (std::size_t axis = 0; axis < cell.doses.size(); ++axis)
      fitting += cell.doses[axis].second == wanted_value(study.sweep[axis], choice) ? 1 : 0;
    if (fitting == cell.doses.size()) return std::move(cell);
  }
  throw Error("sweep: the study has no such cell; see `mapscore table RESULTS`");
}

int fullest_frame(const Recording& recording, const ClassTable& table, int first, int end) {
  int fullest = first;
  std::int64_t most = -1;
  for (int index = first; index < end; ++index) {
    const Frame frame = recording.read(index, {.color = false, .label = true, .depth = false});
    const std::int64_t pixels =
        std::count_if(frame.label.begin(), frame.label.end(),
                      [&](InstanceId id) { return table.detected(table.class_of(id)); });
    if (pixels > most) fullest = index;
    most = std::max(most, pixels);
  }
  return fullest;
}

JudgedMap judged_trial(const Study& study, const TrialRun& run, const Task& task,
                       const ClassTable& table, const TrialSpec& spec, std::optional<int> frame) {
  const LatticeTruth& truth = run.truth();
  return judged_map(spec.method, title_of(study, spec, frame), MapSnapshot(run.map().voxels()),
                    run.threshold(), truth.surface, truth.view.visible, table,
                    map_frame(task.config, task.seed_index).T_map_world());
}

}  // namespace mapscore::eval
