// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#pragma once

#include "core/classes.hpp"
#include "core/geometry/pose.hpp"
#include "core/geometry/voxel.hpp"
#include "core/mapping/observation.hpp"

#include <span>
#include <vector>

namespace mapscore {

/// How often, over the draws of one frame, one class won one voxel.
struct VoxelHit {
  VoxelKey key;
  ClassId class_id = kBackground;
  int draws = 0;           ///< draws in which the class won the voxel
  double score_sum = 0.0;  ///< over those draws, the best score of the class's objects in the voxel
};

/// Places an observation on the map's lattice once per sensor pose `T_map_sensor` and counts, per
/// voxel, the draws that each class won. Within a draw the class with most positions in a voxel
/// wins, ties to the lower id (docs/methods.md). Ascending by voxel, then class. Edge in metres.
[[nodiscard]] std::vector<VoxelHit> place(const Observation& observation,
                                          std::span<const Pose> T_map_sensor, double edge_m);

}  // namespace mapscore
