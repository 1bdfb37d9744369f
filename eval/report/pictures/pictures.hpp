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
#include <filesystem>
#include <functional>
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

/// What was drawn, or the one-line reason why nothing was.
struct Pictures {
  std::vector<std::filesystem::path> files;
  std::string skipped;
};

/// Draws the maps of the chosen trials, one set for each method, in the pale scene (or in the
/// surfaces of the recording, if the scene is missing or has changed). `judged_maps` makes the
/// maps; it is called only when they can be drawn:
///
/// - map_METHOD.png: its predicted voxels in the colours of their classes;
/// - map_and_truth_METHOD.png: truth, map and errors side by side, seen from straight above;
/// - errors_METHOD.png: true, near, leak, floating and missed voxels, over all that was seen;
/// - errors_METHOD_close.png: the same where most errors are;
///
/// and errors.png, the methods side by side. From the choice's view, or else the study's
/// `picture_view`, when there is one, all of them; then there are no close pictures. `table` has
/// the study's detected set. Skips when there is no simulator or no truth. Throws Error when there
/// is no such trial or the folder cannot be written.
[[nodiscard]] Pictures draw_pictures(const Study& study, const ClassTable& table,
                                     const Recording& recording, const PictureChoice& choice,
                                     const std::filesystem::path& folder,
                                     const std::function<std::vector<JudgedMap>()>& judged_maps);

}  // namespace mapscore::eval
