// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#pragma once

#include "eval/explore/exploration_study.hpp"
#include "eval/report/figures/script.hpp"

#include <vector>

namespace mapscore::eval {

/// The floor as the lidar had it at the kept moments of one exploration, frame map: free white,
/// occupied dark, unknown grey; frontiers, and the true way so far. A block of the data file is the
/// grid (a matrix), the way (`x y`), the frontier's cells (`x y`) or start and end of the way so
/// far. Throws Error where a file of the exploration cannot be read.
[[nodiscard]] FigureSheet exploration_moments(const FinishedExploration& run,
                                              const FigureStyle& style = {});

/// What the files of an exploration hold of its kept moments.
struct ShownMoment {
  double stamp_s = 0.0, driven_m = 0.0, coverage = 0.0;
  OccupancyGrid floor;                                 ///< frame map
  std::vector<Eigen::Vector2d> frontier_map, way_map;  ///< the way up to it; metres
};
[[nodiscard]] std::vector<ShownMoment> read_moments(const FinishedExploration& run);

}  // namespace mapscore::eval
