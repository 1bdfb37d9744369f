// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#pragma once

#include "core/geometry/voxel.hpp"

#include <array>
#include <bit>
#include <cstdint>
#include <utility>
#include <vector>

namespace mapscore {

/// One bit for each position of a box of lattice indices, with an empty margin of one position on
/// every side, so that the 26 neighbours of a position need no bounds check. Addresses ascend with
/// i, then j, then k; each row along k starts with a word of its own.
class LatticeBits {
 public:
  using Address = std::uint32_t;

  /// Lays the box anew: positions low .. low + extent - 1 on each axis; all bits clear. (extent +
  /// 2) multiplied over the axes, the last rounded up to a multiple of 64, must fit an Address.
  void lay(const std::array<std::int32_t, 3>& low, const std::array<std::int32_t, 3>& extent) {
    low_ = low;
    extent_ = extent;
    row_ = (static_cast<Address>(extent[2]) + 2 + 63) / 64 * 64;
    slab_ = row_ * (static_cast<Address>(extent[1]) + 2);
    words_.assign(std::size_t{slab_} * (static_cast<Address>(extent[0]) + 2) / 64 + 1, 0);
  }

  /// Address of a position given relative to `low`; -1 and extent lie in the margin.
  [[nodiscard]] Address address(std::int32_t i, std::int32_t j, std::int32_t k) const {
    return static_cast<Address>(i + 1) * slab_ + static_cast<Address>(j + 1) * row_ +
           static_cast<Address>(k + 1);
  }
  /// One above the greatest address.
  [[nodiscard]] std::size_t addresses() const { return 64 * words_.size(); }

  [[nodiscard]] bool test(Address a) const { return (words_[a >> 6] >> (a & 63) & 1) != 0; }
  void set(Address a) { words_[a >> 6] |= std::uint64_t{1} << (a & 63); }
  void clear(Address a) { words_[a >> 6] &= ~(std::uint64_t{1} << (a & 63)); }

  /// Sets corners of the cube of 2 x 2 x 2 positions above `cube`: bit 4 di + 2 dj + dk of
  /// `corners` stands for (di, dj, dk).
  void set_corners(Address cube, unsigned corners) {
    set_pair(cube, corners & 3);
    set_pair(cube + row_, corners >> 2 & 3);
    set_pair(cube + slab_, corners >> 4 & 3);
    set_pair(cube + slab_ + row_, corners >> 6 & 3);
  }
  /// Address of the lowest of the `corners` (one at least) above `cube`.
  [[nodiscard]] Address lowest_corner(Address cube, unsigned corners) const {
    const auto bit = static_cast<Address>(std::countr_zero(corners));
    return cube + (bit >> 2) * slab_ + (bit >> 1 & 1) * row_ + (bit & 1);
  }

  /// Moves the 26-connected component of `seed`, whose bit must be set, to `piece`, which has the
  /// same box. Returns its number of positions. Works on whole words at a time.
  std::size_t move_piece(Address seed, LatticeBits& piece) {
    // Words and their moved bits, whose neighbours are still to be looked at.
    std::vector<std::pair<std::size_t, std::uint64_t>> moved;
    std::size_t count = 0;
    const auto take = [&](std::size_t word, std::uint64_t bits) {
      std::uint64_t& left = words_[word];
      bits &= left;
      if (bits == 0) return;
      for (std::uint64_t before = 0; before != bits;) {  // the runs that the bits lie in
        before = bits;
        bits |= (bits << 1 | bits >> 1) & left;
      }
      left &= ~bits;
      piece.words_[word] |= bits;
      count += static_cast<std::size_t>(std::popcount(bits));
      moved.emplace_back(word, bits);
    };
    const std::size_t row = row_ / 64, slab = slab_ / 64;
    take(seed >> 6, std::uint64_t{1} << (seed & 63));
    while (!moved.empty()) {
      const auto [centre, bits] = moved.back();
      moved.pop_back();
      const std::uint64_t near = bits | bits << 1 | bits >> 1;
      for (std::size_t middle = centre - slab; middle <= centre + slab; middle += slab) {
        for (std::size_t word = middle - row; word <= middle + row; word += row) {
          take(word, near);
          if ((bits & 1) != 0) take(word - 1, std::uint64_t{1} << 63);
          if (bits >> 63 != 0) take(word + 1, 1);
        }
      }
    }
    return count;
  }

  /// Calls `visit(key)` for the positions whose bits are set, ascending.
  template <class Visit>
  void for_each(const Visit& visit) const {
    for (std::int32_t i = 0; i < extent_[0]; ++i) {
      for (std::int32_t j = 0; j < extent_[1]; ++j) {
        const Address row = address(i, j, -1);
        for (Address first = 0; first < row_; first += 64) {
          for (std::uint64_t bits = words_[(row + first) >> 6]; bits != 0; bits &= bits - 1) {
            const auto k = static_cast<std::int32_t>(first) + std::countr_zero(bits) - 1;
            visit(VoxelKey{low_[0] + i, low_[1] + j, low_[2] + k});
          }
        }
      }
    }
  }

 private:
  void set_pair(Address a, std::uint64_t pair) {
    const unsigned shift = a & 63;
    words_[a >> 6] |= pair << shift;
    words_[(a >> 6) + 1] |= pair >> 1 >> (63 - shift);
  }

  std::array<std::int32_t, 3> low_{}, extent_{};
  Address row_ = 0, slab_ = 0;
  std::vector<std::uint64_t> words_;
};

}  // namespace mapscore
