// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#pragma once

#include <Eigen/Core>
#include <vector>

namespace mapscore {

/// Keeps the largest connected piece of some points (metres, any frame, finite, within 2^31 cells
/// of its origin), in their order. Points are connected when their cells of a lattice (edge
/// `cell_m`, anchored at the frame's origin) touch, corners included. Ties go to the piece whose
/// first point comes first. So the wall seen past an object's edge, more than two cells behind it,
/// is left out. Throws Error on an edge that is not positive.
[[nodiscard]] std::vector<Eigen::Vector3d> largest_solid_piece(
    const std::vector<Eigen::Vector3d>& points, double cell_m);

}  // namespace mapscore
