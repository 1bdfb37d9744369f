// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#pragma once

#include "core/mapping/semantic_map.hpp"

#include <Eigen/Geometry>
#include <functional>
#include <optional>
#include <vector>

namespace mapscore {

/// What a query keeps of the voxels in its place.
struct VoxelWanted {
  std::optional<ClassId> class_id;  ///< the most probable class, with at least `threshold`
  double threshold = 0.0;
  bool free_too = false;  ///< also voxels known to be free; not together with a class
};

/// Voxels whose centre lies in the closed box (frame map, metres), ascending by key. Passes over
/// nodes outside it. Throws Error for a box that is empty or not finite, and for more than
/// kMostMapVoxels voxels.
[[nodiscard]] std::vector<MapVoxel> voxels_in_box(const SemanticMap& map,
                                                  const Eigen::AlignedBox3d& box_m,
                                                  const VoxelWanted& wanted = {});

/// Voxels in any region: those of the box whose centre `inside` accepts.
[[nodiscard]] std::vector<MapVoxel> voxels_in_region(
    const SemanticMap& map, const Eigen::AlignedBox3d& bounds_m,
    const std::function<bool(const Eigen::Vector3d&)>& inside, const VoxelWanted& wanted = {});

}  // namespace mapscore
