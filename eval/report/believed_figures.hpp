// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#pragma once

#include "eval/experiment/study.hpp"
#include "eval/recording/recording.hpp"
#include "eval/report/pictures.hpp"

#include <filesystem>
#include <vector>

namespace mapscore::eval {

/// Draws where the robot was and where the pose sources of a study believe it to be, on the grid
/// that it is localised in: `trajectory_on_grid`, as draw_trajectories. Of a sweep over
/// `localization.source` each of its values, else the study's own source; other swept leaves and
/// the seed as `choice` has them. The caption says each source's errors. Draws nothing, and returns
/// nothing, where no source but the true pose is told or the recording has no scans. Throws Error
/// as PoseSources and draw_trajectories.
[[nodiscard]] std::vector<std::filesystem::path> draw_believed(const Study& study,
                                                               const Recording& recording,
                                                               const PictureChoice& choice,
                                                               const std::filesystem::path& folder);

}  // namespace mapscore::eval
