// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#pragma once

#include "core/localization/occupancy_grid.hpp"

#include <cmath>
#include <cstdint>
#include <utility>

namespace mapscore {

/// Column and row of a cell on the map's own lattice, which stay the same while the grid grows.
using LatticeCell = std::pair<std::int64_t, std::int64_t>;
[[nodiscard]] inline LatticeCell lattice_cell(const OccupancyGrid& grid, const GridCell& cell) {
  const Eigen::Vector2d p = grid.centre_of(cell) / grid.frame().resolution_m;
  return {std::llround(p.x() - 0.5), std::llround(p.y() - 0.5)};
}

}  // namespace mapscore
