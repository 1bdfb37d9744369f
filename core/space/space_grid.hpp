// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#pragma once

#include "core/geometry/voxel.hpp"

#include <array>
#include <cstddef>
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

/// Half-open box of voxels.
struct VoxelBounds {
  VoxelKey low, high;
  void include(const VoxelKey& key);
};

/// Two bits, free and hit, for every voxel of a box, in rows along z. Not thread-safe.
class SpaceGrid {
 public:
  /// Most voxels of a grid; two bits each.
  static constexpr double kMostVoxels = 4e9;

  /// Covers `bounds`, a voxel more on each side, and whole blocks. Throws Error beyond kMostVoxels.
  explicit SpaceGrid(const VoxelBounds& bounds);

  [[nodiscard]] std::ptrdiff_t place_of(const VoxelKey& key) const {
    return (key.i - low_.i) * strides_[0] + (key.j - low_.j) * strides_[1] + (key.k - low_.k);
  }
  /// To the next voxel along x, y, z.
  [[nodiscard]] const std::array<std::ptrdiff_t, 3>& strides() const { return strides_; }

  void set_free(std::ptrdiff_t place) { set(free_, place); }
  void set_hit(std::ptrdiff_t place) { set(hit_, place); }
  void clear_hit(std::ptrdiff_t place) { hit_[byte_of(place)] &= ~bit_of(place); }
  [[nodiscard]] bool is_hit(std::ptrdiff_t place) const {
    return (hit_[byte_of(place)] & bit_of(place)) != 0;
  }

  /// What it holds; hit wins over free.
  [[nodiscard]] SpaceBlocks blocks() const;

 private:
  using Bytes = std::vector<std::uint8_t>;
  static std::size_t byte_of(std::ptrdiff_t place) { return static_cast<std::size_t>(place) >> 3; }
  static std::uint8_t bit_of(std::ptrdiff_t place) {
    return static_cast<std::uint8_t>(1u << (place & 7));
  }
  static void set(Bytes& bytes, std::ptrdiff_t place) { bytes[byte_of(place)] |= bit_of(place); }
  [[nodiscard]] bool gather(const Bytes& bytes, std::ptrdiff_t place, SpaceBlock::Bits& bits) const;

  VoxelKey low_;  ///< multiple of 8 on each axis, as is the size
  VoxelKey size_;
  std::array<std::ptrdiff_t, 3> strides_{};
  Bytes free_, hit_;
};

}  // namespace mapscore
