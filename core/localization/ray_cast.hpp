// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#pragma once

#include "core/localization/occupancy_grid.hpp"

#include <Eigen/Core>
#include <optional>

namespace mapscore {

/// Distance in metres along a ray to where it enters the first occupied cell, 0 from inside one;
/// nothing when there is none within `range_m`. Visits every cell that the ray passes through, in
/// order (J. Amanatides and A. Woo, A Fast Voxel Traversal Algorithm for Ray Tracing, Eurographics
/// 1987); a ray through a corner enters the diagonal cell by way of its neighbour along y. Unknown
/// cells and the space beyond the grid are passed through.
[[nodiscard]] std::optional<double> cast_ray(const OccupancyGrid& grid,
                                             const Eigen::Vector2d& from_map, double angle_rad,
                                             double range_m);

}  // namespace mapscore
