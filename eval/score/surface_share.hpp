// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#pragma once

#include "eval/score/map_snapshot.hpp"
#include "eval/score/voxel_window.hpp"
#include "eval/truth/surface_truth.hpp"

#include <cstddef>

namespace mapscore::eval {

/// How many occupied voxels of a map lie on or beside a surface.
struct SurfaceShare {
  /// A share that no map falls below by being bad: in a home even voxels thrown at random do
  /// better.
  static constexpr double kLeast = 0.01;

  std::size_t occupied = 0, at_surfaces = 0;

  void count(bool at_surface) {
    ++occupied;
    at_surfaces += at_surface ? 1 : 0;
  }
  /// 1 for a map without occupied voxels.
  [[nodiscard]] double share() const {
    return occupied == 0 ? 1.0 : static_cast<double>(at_surfaces) / static_cast<double>(occupied);
  }
  [[nodiscard]] bool in_another_frame() const { return share() < kLeast; }
};

/// Whether a surface of any class meets the voxel or one beside it.
[[nodiscard]] inline bool at_surface(const VoxelKey& key, const SurfaceTruth& surface) {
  const auto touched = [&](const VoxelKey& at) { return surface.touches_any(at); };
  return touched(key) || any_in_shell(key, 1, touched);
}

[[nodiscard]] inline SurfaceShare surface_share(const MapSnapshot& map,
                                                const SurfaceTruth& surface) {
  SurfaceShare count;
  for (const MapVoxel& voxel : map.voxels())
    if (voxel.occupied) count.count(at_surface(voxel.key, surface));
  return count;
}

}  // namespace mapscore::eval
