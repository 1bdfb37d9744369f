// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#pragma once

#include "core/geometry/pose.hpp"
#include "core/mapping/observation.hpp"
#include "core/mapping/voxel_hit.hpp"

#include <span>
#include <vector>

namespace mapscore {

/// Places an observation on the map's lattice once per sensor pose `T_map_sensor` and counts, per
/// voxel, the draws that each class won. Within a draw the class with most positions in a voxel
/// wins, ties to the lower id (docs/methods.md). Ascending by voxel, then class. Edge in metres.
[[nodiscard]] std::vector<VoxelHit> place(const Observation& observation,
                                          std::span<const Pose> T_map_sensor, double edge_m);

}  // namespace mapscore
