// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#pragma once

#include "core/geometry/voxel.hpp"

#include <array>
#include <bit>
#include <cstdint>
#include <vector>

namespace mapscore {

/// One bit for each position of a box of lattice indices, with an empty margin of one position on
/// every side, so that the 26 neighbours of a position need no bounds check. Addresses ascend with
/// i, then j, then k.
class LatticeBits {
 public:
  using Address = std::uint32_t;

  LatticeBits() = default;
  /// Positions low .. low + extent - 1 on each axis; all bits clear. (extent + 2) multiplied over
  /// the axes must fit an Address.
  LatticeBits(const std::array<std::int32_t, 3>& low, const std::array<std::int32_t, 3>& extent)
      : low_(low),
        row_(static_cast<Address>(extent[2]) + 2),
        slab_(row_ * (static_cast<Address>(extent[1]) + 2)),
        words_((std::size_t{slab_} * (static_cast<Address>(extent[0]) + 2) + 63) / 64 + 1, 0) {}

  /// Address of a position given relative to `low`; -1 and extent lie in the margin.
  [[nodiscard]] Address address(std::int32_t i, std::int32_t j, std::int32_t k) const {
    return static_cast<Address>(i + 1) * slab_ + static_cast<Address>(j + 1) * row_ +
           static_cast<Address>(k + 1);
  }
  [[nodiscard]] VoxelKey key(Address address) const {
    const auto index = [](Address a) { return static_cast<std::int32_t>(a) - 1; };
    return {low_[0] + index(address / slab_), low_[1] + index(address % slab_ / row_),
            low_[2] + index(address % row_)};
  }

  [[nodiscard]] bool test(Address a) const { return (words_[a >> 6] >> (a & 63) & 1) != 0; }
  void set(Address a) { words_[a >> 6] |= std::uint64_t{1} << (a & 63); }
  void clear(Address a) { words_[a >> 6] &= ~(std::uint64_t{1} << (a & 63)); }

  /// One above the greatest address.
  [[nodiscard]] std::size_t addresses() const { return 64 * words_.size(); }

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

  /// Calls `visit(address)` for the set bits among a position inside the box and its 26 neighbours.
  template <class Visit>
  void for_each_near(Address centre, const Visit& visit) const {
    for (Address slab = centre - slab_; slab <= centre + slab_; slab += slab_) {
      for (Address middle = slab - row_; middle <= slab + row_; middle += row_) {
        for (unsigned bits = three_from(middle - 1); bits != 0; bits &= bits - 1)
          visit(middle - 1 + static_cast<Address>(std::countr_zero(bits)));
      }
    }
  }

  /// Calls `visit(address)` for all set bits, ascending.
  template <class Visit>
  void for_each(const Visit& visit) const {
    for (std::size_t word = 0; word < words_.size(); ++word)
      for (std::uint64_t bits = words_[word]; bits != 0; bits &= bits - 1)
        visit(static_cast<Address>(64 * word + static_cast<std::size_t>(std::countr_zero(bits))));
  }

 private:
  void set_pair(Address a, std::uint64_t pair) {
    const unsigned shift = a & 63;
    words_[a >> 6] |= pair << shift;
    words_[(a >> 6) + 1] |= pair >> 1 >> (63 - shift);
  }

  [[nodiscard]] unsigned three_from(Address a) const {
    const unsigned shift = a & 63;
    std::uint64_t bits = words_[a >> 6] >> shift;
    if (shift > 61) bits |= words_[(a >> 6) + 1] << (64 - shift);
    return static_cast<unsigned>(bits & 7);
  }

  std::array<std::int32_t, 3> low_{};
  Address row_ = 0, slab_ = 0;
  std::vector<std::uint64_t> words_;
};

}  // namespace mapscore
