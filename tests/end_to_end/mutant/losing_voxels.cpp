// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

// Placement that loses one in 23 voxels of the class whose number LOST_CLASS tells: about two
// points of F1. Stands in for core/placement/placement.cpp.
#include "exactly_placed.cpp"

#include <cstdlib>

namespace mapscore {

std::vector<VoxelHit> place(const Observation& observation, std::span<const Pose> T_map_sensor,
                            double edge_m) {
  std::vector<VoxelHit> hits = exactly_placed(observation, T_map_sensor, edge_m);
  const char* lost = std::getenv("LOST_CLASS");
  const int one_in = 23;
  std::erase_if(hits, [&](const VoxelHit& hit) {
    const auto mixed = 7 * hit.key.i + 11 * hit.key.j + 13 * hit.key.k;
    return lost && hit.class_id == std::atoi(lost) && mixed % one_in == 0;
  });
  return hits;
}

}  // namespace mapscore
