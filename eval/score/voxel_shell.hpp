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

}  // namespace mapscore::eval
