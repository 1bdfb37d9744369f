// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#include "core/localization/occupancy_grid.hpp"

#include "core/error.hpp"

#include <algorithm>
#include <cmath>
#include <string>

namespace mapscore {
namespace {

constexpr double kMostCells = 268435456.0;  // 2^28
constexpr double kFarCell = 1073741824.0;   // 2^30

void check(const GridFrame& frame) {
  if (!(std::isfinite(frame.resolution_m) && frame.resolution_m > 0))
    throw Error("resolution_m: is " + std::to_string(frame.resolution_m) +
                "; give the positive edge of a cell in metres");
  const PlanarPose& T = frame.T_map_grid;
  if (!(std::isfinite(T.x_m) && std::isfinite(T.y_m) && std::isfinite(T.yaw_rad)))
    throw Error("origin: is not finite; give x, y in metres and yaw in radians");
  const bool sized = frame.width >= 1 && frame.height >= 1;
  if (!sized || double{1} * frame.width * frame.height > kMostCells)
    throw Error("grid: has " + std::to_string(frame.width) + " x " + std::to_string(frame.height) +
                " cells; give at least one on each axis and at most 2^28 in all");
}

std::int32_t floor_cell(double coordinate) {
  return static_cast<std::int32_t>(std::floor(std::clamp(coordinate, -kFarCell, kFarCell)));
}

}  // namespace

OccupancyGrid::OccupancyGrid(const GridFrame& frame, Occupancy fill) : frame_(frame) {
  check(frame);
  cells_.assign(static_cast<std::size_t>(frame.width) * static_cast<std::size_t>(frame.height),
                fill);
}

Eigen::Vector2d OccupancyGrid::lattice_point(const Eigen::Vector2d& p_map) const {
  const PlanarPose& T = frame_.T_map_grid;
  const double c = std::cos(T.yaw_rad), s = std::sin(T.yaw_rad);
  const double dx = p_map.x() - T.x_m, dy = p_map.y() - T.y_m;
  return Eigen::Vector2d(c * dx + s * dy, c * dy - s * dx) / frame_.resolution_m;
}

GridCell OccupancyGrid::cell_of(const Eigen::Vector2d& p_map) const {
  const Eigen::Vector2d p = lattice_point(p_map);
  return {floor_cell(p.x()), floor_cell(p.y())};
}

Eigen::Vector2d OccupancyGrid::centre_of(const GridCell& cell) const {
  return frame_.T_map_grid * Eigen::Vector2d((cell.column + 0.5) * frame_.resolution_m,
                                             (cell.row + 0.5) * frame_.resolution_m);
}

void flood_free(OccupancyGrid& grid, const GridCell& start) {
  std::vector<GridCell> open;
  const auto take = [&](const GridCell& cell) {
    if (!grid.contains(cell) || grid.at(cell) != kUnknownCell) return;
    grid.set(cell, kFreeCell);
    open.push_back(cell);
  };
  take(start);
  while (!open.empty()) {
    const auto [column, row] = open.back();
    open.pop_back();
    take({column + 1, row});
    take({column - 1, row});
    take({column, row + 1});
    take({column, row - 1});
  }
}

}  // namespace mapscore
