// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

// Placement that is wrong by half a voxel: it rounds where it should take the floor. It stands in
// for core/placement/placement.cpp, whose own place() CMake writes, as exactly_placed(), into this:
#include "exactly_placed.cpp"

namespace mapscore {

std::vector<VoxelHit> place(const Observation& observation, std::span<const Pose> T_map_sensor,
                            double edge_m) {
  std::vector<Pose> shifted(T_map_sensor.begin(), T_map_sensor.end());
  for (Pose& pose : shifted) pose.translation().array() += 0.5 * edge_m;
  return exactly_placed(observation, shifted, edge_m);
}

}  // namespace mapscore
