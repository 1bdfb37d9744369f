// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#pragma once

#include "core/geometry/pose.hpp"
#include "core/geometry/shape.hpp"
#include "core/localization/occupancy_grid.hpp"

#include <Eigen/Core>
#include <vector>

namespace mapscore::eval {

struct FloorGridOptions {
  double height_m = 0.2;                              ///< of the cut, in the map frame: the lidar's
  double resolution_m = 0.02;                         ///< edge of a cell
  Eigen::Vector2d start_m = Eigen::Vector2d::Zero();  ///< in the map frame: where the robot may be
  std::vector<Eigen::Vector2d> way_m = {};            ///< in the map frame: what the grid must hold
  int jobs = 1;  ///< threads; the result does not depend on them
};

/// The occupancy grid that a lidar at a height would fill if it saw everything: cut from drawn
/// surfaces, `shapes` in the world frame. The layer of cubes of the cells' edge whose middle lies
/// at the height is voxelised by the surface truth, nothing widened: a cell whose closed cube a
/// surface touches is occupied. What is connected with the start through edges of cells is free,
/// all else unknown. The grid lies along the map's axes on its lattice and reaches a cell beyond
/// the surfaces, the start and the way: in a scene without walls the robot may be beside all
/// surfaces. Throws Error when the height meets no surface, or the start lies in an occupied cell.
[[nodiscard]] OccupancyGrid floor_grid(const std::vector<Shape>& shapes, const Pose& T_map_world,
                                       const FloorGridOptions& options);

}  // namespace mapscore::eval
