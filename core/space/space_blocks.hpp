// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#pragma once

#include "core/geometry/voxel.hpp"

#include <array>
#include <cstdint>
#include <vector>

namespace mapscore {

/// What one frame says of 8 x 8 x 8 voxels, those of one octree node three levels above the
/// finest. Word o holds octant o, its byte c the child c of that, and bit n of it the voxel n, all
/// in OctoMap's order of children: bit 0 is x, bit 1 is y, bit 2 is z.
struct SpaceBlock {
  using Bits = std::array<std::uint64_t, 8>;
  VoxelKey key;  ///< indices of its voxels divided by 8, rounded down
  Bits free{};   ///< seen through, and not hit
  Bits hit{};
};

/// The blocks that are not empty, in the octree's own order: depth first, children as above.
using SpaceBlocks = std::vector<SpaceBlock>;

/// Place of a block in that order, of blocks within +-2^20.
[[nodiscard]] std::uint64_t octree_order(const VoxelKey& block);

}  // namespace mapscore
