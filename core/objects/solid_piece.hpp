// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#pragma once

#include <Eigen/Core>
#include <vector>

namespace mapscore {

/// Of points (metres, any frame, finite), those of the piece with the most, in their order: points
/// whose cells of a lattice (edge `cell_m`, anchored at the frame's origin) touch, corners
/// included, are of one piece. Ties to the piece of the earlier first point. What lies more than
/// two cells off along one axis, as the wall seen past an object's edge, is another piece. Throws
/// Error on an edge that is not positive.
[[nodiscard]] std::vector<Eigen::Vector3d> largest_solid_piece(
    const std::vector<Eigen::Vector3d>& points, double cell_m);

}  // namespace mapscore
