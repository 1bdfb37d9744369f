// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#pragma once

#include "core/geometry/voxel.hpp"
#include "eval/truth/shapes/shape_tests.hpp"

#include <cstdint>
#include <vector>

namespace mapscore::eval {

/// A box of voxels, both corners included.
struct VoxelBlock {
  VoxelKey low, high;
};

/// What two blocks have in common; empty when they have nothing.
[[nodiscard]] VoxelBlock common(const VoxelBlock& a, const VoxelBlock& b);
[[nodiscard]] bool empty(const VoxelBlock& block);
[[nodiscard]] bool holds(const VoxelBlock& block, const VoxelKey& key);

/// All voxels whose closed cube, widened by `epsilon_m`, could meet the piece. Throws Error when it
/// reaches beyond 2^20 voxels from the origin.
[[nodiscard]] VoxelBlock block_around(const PreparedShape& piece, double edge_m, double epsilon_m);

/// The voxels with first_i <= i < first_i + kSlabVoxels, as a unit of work, and the pieces that
/// could meet one of them. A truth's rows are sorted by i first, so slabs can be voxelised, sorted
/// and packed one by one; appended in order, their rows are sorted as a whole.
struct Slab {
  std::int32_t first_i = 0;
  std::vector<const PreparedShape*> pieces;  ///< in their order
  std::vector<const PreparedShape*> solids;  ///< those of them that have an inside
};

/// Thin enough to keep threads even and the slab in the processor's cache.
inline constexpr std::int32_t kSlabVoxels = 8;

/// The slabs that hold something, by rising i. Keeps pointers to `pieces`. Throws as block_around.
[[nodiscard]] std::vector<Slab> slabs_of(const std::vector<PreparedShape>& pieces, double edge_m,
                                         double epsilon_m);

}  // namespace mapscore::eval
