// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#pragma once

#include "core/localization/occupancy_grid.hpp"

#include <cstdint>
#include <limits>
#include <vector>

namespace mapscore {

/// Squared distance of a cell when no cell is occupied.
inline constexpr std::int64_t kNoObstacle = std::numeric_limits<std::int64_t>::max();

/// Squared distance in cells from each cell's centre to that of the nearest occupied cell, exact;
/// in the order of `grid.cells()`. Lower envelopes of parabolas, columns then rows: P. Felzenszwalb
/// and D. Huttenlocher, Distance Transforms of Sampled Functions, Theory of Computing 8 (2012).
/// Time is linear in the number of cells.
[[nodiscard]] std::vector<std::int64_t> squared_distances(const OccupancyGrid& grid);

}  // namespace mapscore
