// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#pragma once

#include "core/classes.hpp"
#include "eval/recording/recording.hpp"
#include "eval/report/pictures/trial.hpp"
#include "eval/study/study.hpp"

#include <filesystem>
#include <string>
#include <vector>

namespace mapscore::eval {

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
