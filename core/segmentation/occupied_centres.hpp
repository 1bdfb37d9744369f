// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#pragma once

#include <Eigen/Core>
#include <vector>

namespace mapscore {

/// Centres of the voxels that hold points, on the lattice anchored at the sensor frame's origin;
/// ascending.
[[nodiscard]] std::vector<Eigen::Vector3d> occupied_centres(
    const std::vector<Eigen::Vector3d>& points, double voxel_m);

}  // namespace mapscore
