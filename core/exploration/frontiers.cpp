// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#include "core/exploration/frontiers.hpp"

#include <cmath>
#include <cstdint>

namespace mapscore {
namespace {

bool beside_unknown(const OccupancyGrid& grid, const GridCell& cell) {
  const auto unknown = [&](std::int32_t column, std::int32_t row) {
    return grid.at_or_unknown({cell.column + column, cell.row + row}) == kUnknownCell;
  };
  return unknown(1, 0) || unknown(-1, 0) || unknown(0, 1) || unknown(0, -1);
}

/// Takes a cell and all that are connected with it out of `border`.
Frontier connected(const OccupancyGrid& grid, const GridCell& first,
                   std::vector<std::uint8_t>& border) {
  Frontier frontier;
  frontier.cells.push_back(first);
  border[grid.index(first)] = 0;
  for (std::size_t n = 0; n < frontier.cells.size(); ++n) {
    const GridCell cell = frontier.cells[n];
    frontier.centre_m += grid.centre_of(cell);
    for (int beside = 0; beside < 9; ++beside) {
      const GridCell next{cell.column + beside % 3 - 1, cell.row + beside / 3 - 1};
      if (!grid.contains(next) || border[grid.index(next)] == 0) continue;
      border[grid.index(next)] = 0;
      frontier.cells.push_back(next);
    }
  }
  frontier.centre_m /= static_cast<double>(frontier.cells.size());
  return frontier;
}

}  // namespace

std::vector<Frontier> find_frontiers(const OccupancyGrid& grid, double least_m,
                                     const std::function<bool(const GridCell&)>& left_out) {
  std::vector<std::uint8_t> border(grid.cells().size(), 0);
  const auto for_each_cell = [&](auto&& use) {
    for (GridCell cell; cell.row < grid.frame().height; ++cell.row)
      for (cell.column = 0; cell.column < grid.frame().width; ++cell.column) use(cell);
  };
  for_each_cell([&](const GridCell& cell) {
    if (grid.at(cell) != kFreeCell || !beside_unknown(grid, cell)) return;
    border[grid.index(cell)] = left_out && left_out(cell) ? 0 : 1;
  });
  std::vector<Frontier> frontiers;
  for_each_cell([&](const GridCell& cell) {
    if (border[grid.index(cell)] == 0) return;
    Frontier frontier = connected(grid, cell, border);
    const double length = static_cast<double>(frontier.cells.size()) * grid.frame().resolution_m;
    if (length >= least_m - 1e-9) frontiers.push_back(std::move(frontier));
  });
  return frontiers;
}

std::optional<Approach> approach(const Frontier& frontier, const OccupancyGrid& grid,
                                 const FloorPaths& paths, double near_m) {
  const double near = near_m / grid.frame().resolution_m;
  const auto reach = static_cast<std::int32_t>(std::floor(near));
  std::optional<Approach> best;
  for (const GridCell& cell : frontier.cells)
    for (std::int32_t row = -reach; row <= reach; ++row)
      for (std::int32_t column = -reach; column <= reach; ++column) {
        const GridCell place{cell.column + column, cell.row + row};
        if (std::hypot(column, row) > near || !paths.reaches(place)) continue;
        const double way_m = paths.cost_m(place);
        if (!best || way_m < best->way_m) best = Approach{place, cell, way_m};
      }
  return best;
}

}  // namespace mapscore
