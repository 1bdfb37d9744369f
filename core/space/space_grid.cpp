// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#include "core/space/space_grid.hpp"

#include "core/error.hpp"

#include <algorithm>

namespace mapscore {
namespace {

constexpr int kBlockBits = 3;

/// Every third bit of the result is a bit of the number: 0, 3, 6, ...
std::uint64_t spread(std::uint64_t number) {
  number &= 0x1fffff;
  number = (number | number << 32) & 0x1f00000000ffffULL;
  number = (number | number << 16) & 0x1f0000ff0000ffULL;
  number = (number | number << 8) & 0x100f00f00f00f00fULL;
  number = (number | number << 4) & 0x10c30c30c30c30c3ULL;
  return (number | number << 2) & 0x1249249249249249ULL;
}

/// Where four voxels along z lie in the word of their octant, of which they are the first column.
constexpr std::array<std::uint64_t, 16> kColumns = [] {
  std::array<std::uint64_t, 16> columns{};
  for (unsigned bits = 0; bits < 16; ++bits)
    for (unsigned k = 0; k < 4; ++k)
      if (bits >> k & 1) columns[bits] |= std::uint64_t{1} << ((k >> 1) * 32 + (k & 1) * 4);
  return columns;
}();

/// Place of a block in the octree's own order, of blocks within +-2^20.
std::uint64_t octree_order(const VoxelKey& block) {
  constexpr std::int32_t kOffset = 1 << 20;
  return spread(static_cast<std::uint64_t>(block.i + kOffset)) |
         spread(static_cast<std::uint64_t>(block.j + kOffset)) << 1 |
         spread(static_cast<std::uint64_t>(block.k + kOffset)) << 2;
}

}  // namespace

void VoxelBounds::include(const VoxelKey& key) {
  low = {std::min(low.i, key.i), std::min(low.j, key.j), std::min(low.k, key.k)};
  high = {std::max(high.i, key.i + 1), std::max(high.j, key.j + 1), std::max(high.k, key.k + 1)};
}

SpaceGrid::SpaceGrid(const VoxelBounds& bounds) {
  const auto down = [](std::int32_t index) { return (index - 1) >> kBlockBits << kBlockBits; };
  const auto up = [](std::int32_t index) { return (index + 8) >> kBlockBits << kBlockBits; };
  low_ = {down(bounds.low.i), down(bounds.low.j), down(bounds.low.k)};
  size_ = {up(bounds.high.i) - low_.i, up(bounds.high.j) - low_.j, up(bounds.high.k) - low_.k};
  const double voxels = static_cast<double>(size_.i) * size_.j * size_.k;
  if (voxels > kMostVoxels)
    throw Error("points: a frame spans too many voxels; set max_range_m or use larger voxels");
  strides_ = {static_cast<std::ptrdiff_t>(size_.j) * size_.k, size_.k, 1};
  free_.resize(static_cast<std::size_t>(voxels) / 8);
  hit_.resize(free_.size());
}

bool SpaceGrid::gather(const Bytes& bytes, std::ptrdiff_t place, SpaceBlock::Bits& bits) const {
  std::uint8_t any = 0;
  for (int i = 0; i < 8; ++i) {
    for (int j = 0; j < 8; ++j) {
      const std::uint8_t row = bytes[byte_of(place + i * strides_[0] + j * strides_[1])];
      any |= row;
      const int octant = i >> 2 | j >> 2 << 1;
      const int shift = (i >> 1 & 1) * 8 + (i & 1) + (j >> 1 & 1) * 16 + (j & 1) * 2;
      bits[static_cast<std::size_t>(octant)] |= kColumns[row & 15] << shift;
      bits[static_cast<std::size_t>(octant | 4)] |= kColumns[row >> 4] << shift;
    }
  }
  return any != 0;
}

SpaceBlocks SpaceGrid::blocks() const {
  SpaceBlocks blocks;
  for (VoxelKey at{0, 0, 0}; at.i < size_.i; at.i += 8) {
    for (at.j = 0; at.j < size_.j; at.j += 8) {
      for (at.k = 0; at.k < size_.k; at.k += 8) {
        const VoxelKey key{low_.i + at.i, low_.j + at.j, low_.k + at.k};
        SpaceBlock block{{key.i >> kBlockBits, key.j >> kBlockBits, key.k >> kBlockBits}, {}, {}};
        const bool free = gather(free_, place_of(key), block.free);
        const bool hit = gather(hit_, place_of(key), block.hit);
        if (!free && !hit) continue;
        for (std::size_t octant = 0; octant < 8; ++octant) block.free[octant] &= ~block.hit[octant];
        blocks.push_back(block);
      }
    }
  }
  std::ranges::sort(blocks, {}, [](const SpaceBlock& block) { return octree_order(block.key); });
  return blocks;
}

}  // namespace mapscore
