// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#include "core/segmentation/occupied_centres.hpp"

#include "core/geometry/voxel.hpp"

#include <algorithm>

namespace mapscore {

std::vector<Eigen::Vector3d> occupied_centres(const std::vector<Eigen::Vector3d>& points,
                                              double voxel_m) {
  std::vector<VoxelKey> keys;
  for (const Eigen::Vector3d& point : points) {
    const VoxelKey key = voxel_of(point, voxel_m);
    if (keys.empty() || keys.back() != key) keys.push_back(key);  // neighbours mostly share a voxel
  }
  std::sort(keys.begin(), keys.end());
  keys.erase(std::unique(keys.begin(), keys.end()), keys.end());
  std::vector<Eigen::Vector3d> centres;
  centres.reserve(keys.size());
  for (const VoxelKey& key : keys) centres.push_back(centre_of(key, voxel_m));
  return centres;
}

}  // namespace mapscore
