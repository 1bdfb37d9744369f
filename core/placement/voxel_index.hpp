// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#pragma once

#include "core/geometry/voxel.hpp"

#include <cstddef>
#include <cstdint>
#include <vector>

namespace mapscore {

/// Numbers voxels 0, 1, 2, ... in the order in which they first ask for a number. A hash table of
/// blocks of 4 x 4 x 4 voxels: a voxel in the block of the one before is found without hashing.
/// Voxels are named by their packed keys. Not thread-safe, lookups included.
class VoxelIndex {
 public:
  static constexpr std::uint32_t kNone = 0xffffffff;

  /// The number of a voxel, the next free one if it had none.
  std::uint32_t number(std::uint64_t packed) {
    std::uint32_t& number = cell(packed);
    if (number == kNone) {
      number = static_cast<std::uint32_t>(keys_.size());
      keys_.push_back(packed);
    }
    return number;
  }
  /// The number of a voxel, or kNone.
  [[nodiscard]] std::uint32_t find(std::uint64_t packed) { return cell(packed); }
  /// The numbered voxels, packed, by number.
  [[nodiscard]] const std::vector<std::uint64_t>& keys() const { return keys_; }

 private:
  struct Block {
    std::uint64_t key = 0;  ///< packed key of its low voxel
    std::uint32_t number = kNone;
  };
  static constexpr std::size_t kCells = 64;  ///< of a block

  [[nodiscard]] std::uint32_t& cell(std::uint64_t packed) {
    constexpr std::uint64_t kAxis = 3, kWithin = kAxis << 42 | kAxis << 21 | kAxis;
    const std::uint64_t block = packed & ~kWithin;
    if (block != last_block_) {
      last_block_ = block;
      first_cell_ = kCells * number_of_block(block);
    }
    return cells_[first_cell_ +
                  ((packed >> 42 & kAxis) << 4 | (packed >> 21 & kAxis) << 2 | (packed & kAxis))];
  }
  [[nodiscard]] std::size_t number_of_block(std::uint64_t key) {
    Block& found = place_of(key);
    if (found.number != kNone) return found.number;
    const auto number = static_cast<std::uint32_t>(cells_.size() / kCells);
    found = {key, number};
    cells_.resize(cells_.size() + kCells, kNone);
    if (2 * std::size_t{number} > blocks_.size()) grow();
    return number;
  }
  /// Where a block is in the table, or belongs: open addressing, linear probing.
  [[nodiscard]] Block& place_of(std::uint64_t key) {
    std::size_t place = (key * 0x9e3779b97f4a7c15ULL) >> shift_;
    while (blocks_[place].number != kNone && blocks_[place].key != key)
      place = (place + 1) & (blocks_.size() - 1);
    return blocks_[place];
  }
  void grow() {
    --shift_;
    std::vector<Block> old(2 * blocks_.size());
    old.swap(blocks_);
    for (const Block& block : old)
      if (block.number != kNone) place_of(block.key) = block;
  }

  std::vector<Block> blocks_ = std::vector<Block>(256);  ///< a power of two, at most half full
  std::vector<std::uint32_t> cells_;                     ///< numbers, block by block
  std::vector<std::uint64_t> keys_;
  int shift_ = 64 - 8;
  std::uint64_t last_block_ = ~std::uint64_t{0};
  std::size_t first_cell_ = 0;  ///< of that block
};

}  // namespace mapscore
