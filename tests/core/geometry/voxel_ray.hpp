// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#pragma once

#include "core/geometry/voxel.hpp"

#include <Eigen/Core>
#include <vector>

namespace mapscore {

/// Every voxel that holds a point of the closed segment from `from` to `to` (metres), in the order
/// in which a point that moves along it enters them; J. Amanatides and A. Woo, A Fast Voxel
/// Traversal Algorithm for Ray Tracing, Eurographics 1987. Exact: ends are taken at 2^-32 of a
/// voxel, rounded down, and from there on all is done in whole numbers, so that a segment through
/// edges and corners meets just the half-open cubes that it does. The first voxel is that of
/// `from`, the last that of `to`. Throws Error for an edge that is not positive, and for ends that
/// are not finite or lie beyond +-2^20 voxels. Thread-safe.
[[nodiscard]] std::vector<VoxelKey> voxels_on_segment(const Eigen::Vector3d& from,
                                                      const Eigen::Vector3d& to, double edge_m);

}  // namespace mapscore
