// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#include "core/mapping/map_query.hpp"

#include "core/error.hpp"

#include <algorithm>

namespace mapscore {

std::vector<MapVoxel> voxels_in_region(const SemanticMap& map, const Eigen::AlignedBox3d& bounds_m,
                                       const std::function<bool(const Eigen::Vector3d&)>& inside,
                                       const VoxelWanted& wanted) {
  if (bounds_m.isEmpty() || !bounds_m.min().allFinite() || !bounds_m.max().allFinite())
    throw Error("box: must be finite, its low corner nowhere above its high corner");
  const SemanticOcTree& tree = map.tree();
  std::vector<MapVoxel> voxels;
  for_each_leaf_in(tree, bounds_m, [&](const auto& leaf) {
    const ClassProbability best = leaf->best();
    const bool occupied = tree.isNodeOccupied(*leaf);
    if (!occupied && (!wanted.free_too || wanted.class_id)) return;
    if (wanted.class_id &&
        (best.class_id != *wanted.class_id || best.probability < wanted.threshold))
      return;
    for_each_finest(tree, leaf, [&](const VoxelKey& key) {
      const Eigen::Vector3d centre = centre_of(key, map.edge_m());
      if (!bounds_m.contains(centre) || (inside && !inside(centre))) return;
      if (voxels.size() == kMostMapVoxels)
        throw Error("box: it holds too many voxels; ask for a smaller one");
      voxels.push_back({key, best.class_id, best.probability, occupied});
    });
  });
  std::ranges::sort(voxels, {}, &MapVoxel::key);
  return voxels;
}

std::vector<MapVoxel> voxels_in_box(const SemanticMap& map, const Eigen::AlignedBox3d& box_m,
                                    const VoxelWanted& wanted) {
  return voxels_in_region(map, box_m, {}, wanted);
}

}  // namespace mapscore
