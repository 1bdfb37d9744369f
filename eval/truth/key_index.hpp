// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#pragma once

#include "core/geometry/voxel.hpp"

#include <bit>
#include <cstdint>
#include <limits>
#include <vector>

namespace mapscore::eval {

/// Where the rows of a voxel begin in a list that is sorted by voxel: open addressing with linear
/// probing, at most half full. Built once; then safe to share between threads.
class KeyIndex {
 public:
  static constexpr std::uint32_t kNone = std::numeric_limits<std::uint32_t>::max();

  KeyIndex() = default;
  explicit KeyIndex(std::size_t keys) : slots_(std::bit_ceil(2 * keys + 2)) {}

  /// Notes the first row of `key`; later rows of the same key are ignored.
  void insert(std::uint64_t key, std::uint32_t row) {
    Slot& slot = slots_[position(key)];
    if (slot.row == kNone) slot = {key, row};
  }

  /// First row of `key`, or kNone.
  [[nodiscard]] std::uint32_t find(std::uint64_t key) const {
    return slots_.empty() ? kNone : slots_[position(key)].row;
  }

 private:
  struct Slot {
    std::uint64_t key = 0;
    std::uint32_t row = kNone;
  };

  [[nodiscard]] std::size_t position(std::uint64_t key) const {
    const std::size_t mask = slots_.size() - 1;
    std::size_t at = mix_bits(key) & mask;
    while (slots_[at].row != kNone && slots_[at].key != key) at = (at + 1) & mask;
    return at;
  }

  std::vector<Slot> slots_;
};

}  // namespace mapscore::eval
