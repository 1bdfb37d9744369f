// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#include "eval/truth/floor_grid.hpp"

#include "core/error.hpp"
#include "eval/truth/surface_truth.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace mapscore::eval {
namespace {

/// Lattice positions of the layer's touched cubes, by (x, y).
std::vector<GridCell> touched_cells(const std::vector<Shape>& shapes, const Pose& T_map_world,
                                    const FloorGridOptions& options) {
  const double r = options.resolution_m;
  Pose T_layer_map = Pose::Identity();
  T_layer_map.translation().z() = 0.5 * r - options.height_m;  // the layer of k = 0
  std::vector<Shape> unnamed = shapes;
  for (Shape& shape : unnamed) shape.instance = 0;
  const SurfaceTruth surface =
      surface_truth(unnamed, ClassTable{}, T_layer_map * T_map_world, {r, 0.0, options.jobs});
  std::vector<GridCell> cells;
  for (const SurfaceVoxel& voxel : surface.voxels())
    if (voxel.key.k == 0) cells.push_back({voxel.key.i, voxel.key.j});
  return cells;
}

GridCell cell_at(const Eigen::Vector2d& point_m, double resolution_m) {
  return {static_cast<int>(std::floor(point_m.x() / resolution_m)),
          static_cast<int>(std::floor(point_m.y() / resolution_m))};
}

}  // namespace

OccupancyGrid floor_grid(const std::vector<Shape>& shapes, const Pose& T_map_world,
                         const FloorGridOptions& options) {
  const std::vector<GridCell> touched = touched_cells(shapes, T_map_world, options);
  if (touched.empty())
    throw Error(
        fmt::format("grid: no surface at height {} m; give another height", options.height_m));
  const double r = options.resolution_m;
  std::vector<GridCell> held = touched;
  held.push_back(cell_at(options.start_m, r));
  for (const Eigen::Vector2d& point_m : options.way_m) held.push_back(cell_at(point_m, r));
  const auto [west, east] = std::ranges::minmax(held, {}, &GridCell::column);
  const auto [south, north] = std::ranges::minmax(held, {}, &GridCell::row);
  const GridCell low{west.column - 1, south.row - 1};
  OccupancyGrid grid({.resolution_m = r,
                      .T_map_grid = {low.column * r, low.row * r, 0.0},
                      .width = east.column - west.column + 3,
                      .height = north.row - south.row + 3});
  for (const GridCell& cell : touched)
    grid.set({cell.column - low.column, cell.row - low.row}, kOccupiedCell);
  const GridCell start = grid.cell_of(options.start_m);
  if (grid.at_or_unknown(start) != kUnknownCell)
    throw Error(fmt::format("grid: the start ({}, {}) m lies in something; give one on free floor",
                            options.start_m.x(), options.start_m.y()));
  flood_free(grid, start);
  return grid;
}

}  // namespace mapscore::eval
