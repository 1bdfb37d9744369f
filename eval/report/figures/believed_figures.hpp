// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#pragma once

#include "eval/recording/recording.hpp"
#include "eval/report/figures/style.hpp"
#include "eval/report/pictures/pictures.hpp"
#include "eval/study/study.hpp"

#include <filesystem>

namespace mapscore::eval {

/// Draws `errors_over_time` (pose_errors_figure) and, where the recording has scans,
/// `trajectory_on_grid`: where the robot was, and where the study's pose sources believe it
/// to be, on the grid used for localisation, with each source's errors in the caption. Sources: all
/// values of a sweep over `localization.source`, else the study's own; `gaussian` and `truth` are
/// not drawn. Other swept leaves and the seed: as in `choice`. Draws and returns nothing when no
/// source is left; skips `trajectory_on_grid` alone where no grid can be cut and no filter needs
/// one. Throws Error as PoseSources, trajectory_figure, draw.
[[nodiscard]] Pictures draw_believed(const Study& study, const Recording& recording,
                                     const PictureChoice& choice,
                                     const std::filesystem::path& folder,
                                     const FigureStyle& style = {});

}  // namespace mapscore::eval
