// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#pragma once

#include "core/localization/occupancy_grid.hpp"

#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <limits>
#include <utility>

namespace mapscore {

/// Column and row of a cell on the map's own lattice, which stay the same while the grid grows.
using LatticeCell = std::pair<std::int64_t, std::int64_t>;
[[nodiscard]] inline LatticeCell lattice_cell(const OccupancyGrid& grid, const GridCell& cell) {
  const Eigen::Vector2d p = grid.centre_of(cell) / grid.frame().resolution_m;
  return {std::llround(p.x() - 0.5), std::llround(p.y() - 0.5)};
}

/// Visits the cells that the straight line between two lattice points passes through, in order,
/// both ends included, as long as `visit(cell)` says true. Exact traversal (J. Amanatides and A.
/// Woo, Eurographics 1987); a line through a corner goes by way of the neighbour along y.
inline void walk_cells(const Eigen::Vector2d& from, const Eigen::Vector2d& to, auto&& visit) {
  constexpr double kNever = std::numeric_limits<double>::infinity();
  const auto cell_at = [](double x) { return static_cast<std::int32_t>(std::floor(x)); };
  GridCell cell{cell_at(from.x()), cell_at(from.y())};
  const GridCell last{cell_at(to.x()), cell_at(to.y())};
  const Eigen::Vector2d along = to - from;
  const std::int32_t step_x = along.x() > 0 ? 1 : -1, step_y = along.y() > 0 ? 1 : -1;
  const auto border = [](std::int32_t at, std::int32_t step) { return at + (step > 0 ? 1 : 0); };
  const double per_x = along.x() == 0 ? kNever : std::abs(1.0 / along.x());
  const double per_y = along.y() == 0 ? kNever : std::abs(1.0 / along.y());
  double x = along.x() == 0 ? kNever : (border(cell.column, step_x) - from.x()) / along.x();
  double y = along.y() == 0 ? kNever : (border(cell.row, step_y) - from.y()) / along.y();
  // The number of steps is known, so rounding can neither miss the last cell nor pass it.
  std::int32_t left_x = std::abs(last.column - cell.column);
  std::int32_t left_y = std::abs(last.row - cell.row);
  while (visit(cell) && left_x + left_y > 0) {
    if (left_y == 0 || (left_x > 0 && x < y)) {
      cell.column += step_x, x += per_x, --left_x;
    } else {
      cell.row += step_y, y += per_y, --left_y;
    }
  }
}

}  // namespace mapscore
