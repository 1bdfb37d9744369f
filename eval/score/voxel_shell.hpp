// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#pragma once

#include "core/geometry/voxel.hpp"

namespace mapscore::eval {

/// True when a voxel at Chebyshev distance exactly `t` >= 1 from `key` satisfies `holds(VoxelKey)`.
template <class Predicate>
[[nodiscard]] bool any_in_shell(const VoxelKey& key, int t, Predicate holds) {
  for (int di = -t; di <= t; ++di) {
    for (int dj = -t; dj <= t; ++dj) {
      const bool on_side = di == -t || di == t || dj == -t || dj == t;
      for (int dk = -t; dk <= t; dk += on_side ? 1 : 2 * t) {
        if (holds(VoxelKey{key.i + di, key.j + dj, key.k + dk})) return true;
      }
    }
  }
  return false;
}

/// Chebyshev distance in voxels, 1 to `reach`, from `key` to the nearest other voxel that satisfies
/// `holds`; reach + 1 when there is none that near.
template <class Predicate>
[[nodiscard]] int shell_distance(const VoxelKey& key, int reach, Predicate holds) {
  int t = 1;
  while (t <= reach && !any_in_shell(key, t, holds)) ++t;
  return t;
}

}  // namespace mapscore::eval
