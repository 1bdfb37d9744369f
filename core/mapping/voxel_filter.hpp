// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <span>
#include <vector>

namespace mapscore {

/// One point a voxel [R, section 3.4]: the indices, ascending, of the points nearest to the centres
/// of their voxels, ties to the lower index. Metres. Points that are not finite or beyond +-2^20
/// voxels are left out. Throws Error unless the edge is positive. Thread-safe.
[[nodiscard]] std::vector<std::size_t> voxel_filter(std::span<const Eigen::Vector3d> points,
                                                    double edge_m);

}  // namespace mapscore
