// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#pragma once

#include "core/classes.hpp"
#include "eval/lab/trial_run.hpp"
#include "eval/recording/recording.hpp"
#include "eval/report/pictures/judgement.hpp"
#include "eval/study/grid.hpp"
#include "eval/study/study.hpp"
#include "sim/render/renderer.hpp"

#include <cstddef>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace mapscore::eval {

/// Which trials are drawn: all methods at one cell with one seed.
struct PictureChoice {
  /// Swept path and value; of the other swept paths the middle value.
  std::vector<std::pair<std::string, std::string>> doses;
  std::optional<std::string> method;  ///< only this one
  int seed_index = 0;
  std::size_t memory_bytes = std::size_t{1} << 30;  ///< decoded frames held at once
  std::optional<sim::View> view;  ///< in place of the study's and of automatic ones
};

/// The cell of the sweep with the chosen doses. Throws Error naming a path or value that is not
/// swept.
[[nodiscard]] Cell chosen_cell(const Study& study, const PictureChoice& choice);

/// The map that a trial ended with, judged; it is named by its method, and its title says its doses
/// too. `frame`: the one that is shown, where each is scored by itself.
[[nodiscard]] JudgedMap judged_trial(const Study& study, const TrialRun& run, const Task& task,
                                     const ClassTable& table, const TrialSpec& spec,
                                     std::optional<int> frame);

/// The frame of first..end-1 with most colour pixels of detected classes; the earliest of equals.
[[nodiscard]] int fullest_frame(const Recording& recording, const ClassTable& table, int first,
                                int end);

}  // namespace mapscore::eval
