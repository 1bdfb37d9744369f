// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#pragma once

#include "core/geometry/voxel.hpp"
#include "core/space/space_grid.hpp"

#include <Eigen/Core>
#include <cstddef>
#include <optional>
#include <span>

namespace mapscore {

/// What a frame saw of space.
struct SeenSpace {
  SpaceBlocks blocks;
  std::size_t points_left_out = 0;  ///< not finite, or beyond the octree's span
};

/// The voxels that a depth camera or scanner at `origin` saw through and hit, all in frame map
/// (metres): one ray to the centre of each distinct voxel with a point, free before that voxel,
/// which is hit. Beyond `max_range_m` (of the centre) a ray frees as far as the range and hits
/// nothing. `also_hit` are hit whatever the rays say; hit wins over free. Free and hit voxels are
/// those of octomap::OccupancyOcTreeBase::insertPointCloud(points, origin, max_range, lazy,
/// discretize = true), its single precision included (docs/octree.md). Throws Error for an edge or
/// range that is not positive and an origin that is not finite or beyond the octree's span.
/// Thread-safe.
[[nodiscard]] SeenSpace seen_space(const Eigen::Vector3d& origin,
                                   std::span<const Eigen::Vector3d> points, double edge_m,
                                   std::optional<double> max_range_m = {},
                                   std::span<const VoxelKey> also_hit = {});

}  // namespace mapscore
