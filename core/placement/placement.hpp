// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#pragma once

#include "core/classes.hpp"
#include "core/geometry/pose.hpp"
#include "core/geometry/voxel.hpp"

#include <span>
#include <vector>

namespace mapscore {

/// What one detection adds to an observation: positions in the sensor frame (depth_optical,
/// metres), either its kept points or the centres of its voxels.
struct ObservedObject {
  ClassId class_id = kBackground;
  double score = 1.0;  ///< confidence of the detection, in (0, 1]
  std::vector<Eigen::Vector3d> positions;
};

/// What one frame says of the detected objects.
using Observation = std::vector<ObservedObject>;

/// How often, over the draws of one frame, one class won one voxel.
struct VoxelHit {
  VoxelKey key;
  ClassId class_id = kBackground;
  int draws = 0;           ///< draws in which the class won the voxel
  double score_sum = 0.0;  ///< over those draws, the best score of the class's objects in the voxel
  bool operator==(const VoxelHit&) const = default;
};

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
