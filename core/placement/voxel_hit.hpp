// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#pragma once

#include "core/classes.hpp"
#include "core/geometry/voxel.hpp"

namespace mapscore {

/// How often, over the draws of one frame, one class won one voxel.
struct VoxelHit {
  VoxelKey key;
  ClassId class_id = kBackground;
  int draws = 0;           ///< draws in which the class won the voxel
  double score_sum = 0.0;  ///< over those draws, the best score of the class's objects in the voxel
  bool operator==(const VoxelHit&) const = default;
};

}  // namespace mapscore
