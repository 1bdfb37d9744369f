// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#pragma once

#include "eval/localization/localization_score.hpp"
#include "eval/report/figures/script.hpp"

#include <span>
#include <string>
#include <vector>

namespace mapscore::eval {

/// Errors of one pose source along one drive.
struct PoseErrors {
  std::string source;  ///< for people: "particle filter"
  std::vector<FrameError> frames;
};

/// errors_over_time: how far the true pose lies ahead and to the left of the believed one, and how
/// far it is turned from it, in the robot's axes, over the time of the recording, from convergence
/// on; about 0 the two standard deviations that the source itself states. A column a source, a row
/// an axis. A block of the data file is one source: `stamp_s`, then `error low high` of each row.
/// `caption`: said first.
[[nodiscard]] FigureSheet pose_errors_figure(std::span<const PoseErrors> sources,
                                             const std::string& caption,
                                             const FigureStyle& style = {});

}  // namespace mapscore::eval
