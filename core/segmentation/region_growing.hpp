// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#pragma once

#include "core/geometry/voxel.hpp"

#include <Eigen/Core>
#include <span>
#include <vector>

namespace mapscore {

/// What region growing accepted.
struct Region {
  std::vector<VoxelKey>
      positions;            ///< accepted lattice positions, as multiples of the pitch; ascending
  std::vector<int> points;  ///< indices of the kept points, ascending
};

/// Region growing over a lattice of pitch r anchored at `seed` [M, algorithm 1]: position (i, j, k)
/// lies at seed + r (i, j, k) and is accepted when some point p has |p - position|^2 < k_r^2,
/// strictly, with k_r = radius_factor * r; from the seed's own position on, the 26 neighbours of
/// every accepted position are tried in turn. Kept are the points that pass the same test at some
/// accepted position. Points that are not finite are ignored. In doubles; with `released`, points
/// and positions are rounded to single precision first and the squares summed in it.
///
/// The fast form: points are binned by lattice cell, so that only the few positions around each are
/// ever tested. Same result as grow_region_reference on every input. Throws Error unless pitch and
/// factor are positive and finite. Thread-safe: each thread keeps a workspace of its own.
[[nodiscard]] Region grow_region(std::span<const Eigen::Vector3d> points,
                                 const Eigen::Vector3d& seed, double pitch_m, double radius_factor,
                                 bool released);

/// The plain form: a KD-tree (nanoflann) and a queue. Thread-safe.
[[nodiscard]] Region grow_region_reference(std::span<const Eigen::Vector3d> points,
                                           const Eigen::Vector3d& seed, double pitch_m,
                                           double radius_factor, bool released);

/// Coordinates of a lattice position.
[[nodiscard]] inline Eigen::Vector3d lattice_position(const Eigen::Vector3d& seed, double pitch_m,
                                                      const VoxelKey& key) {
  return {seed.x() + pitch_m * key.i, seed.y() + pitch_m * key.j, seed.z() + pitch_m * key.k};
}

}  // namespace mapscore
