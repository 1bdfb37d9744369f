// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#pragma once

#include "core/geometry/pose.hpp"
#include "core/placement/observation.hpp"
#include "core/placement/voxel_hit.hpp"

#include <span>
#include <vector>

namespace mapscore {

/// Places an observation on the map's lattice once per sensor pose `T_map_sensor` and counts, per
/// voxel, the draws that each class won. Within a draw the class with most positions in a voxel
/// wins, ties to the lower id (docs/methods.md). Ascending by voxel, then class. Edge in metres.
/// Positions that are not finite in the map are left out. Those beyond +-2^20 voxels on an axis
/// fall into the last voxel there, which lies beyond the octree's span, so that SemanticMap::fuse
/// leaves them out and counts them. Throws Error unless the edge is positive and finite.
/// Thread-safe.
[[nodiscard]] std::vector<VoxelHit> place(const Observation& observation,
                                          std::span<const Pose> T_map_sensor, double edge_m);

}  // namespace mapscore
