// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#pragma once

#include "core/geometry/voxel.hpp"
#include "core/mapping/position_cells.hpp"

#include <algorithm>
#include <bit>
#include <cstdint>

namespace mapscore {

/// Parts of a cell on each axis.
inline constexpr double kCellParts = 8.0;

/// Where a boundary between voxels cuts a cell on one axis: its parts, a bit each, below the
/// boundary and above it, whatever a turn does to them; the others are open.
struct AxisCut {
  int voxel = 0;          ///< that below the boundary
  double boundary = 0.0;  ///< in parts from the cell's low side
  std::uint32_t below = 0, above = 0;
  bool twice = false;  ///< open parts may reach across another boundary, too

  [[nodiscard]] std::uint32_t open() const { return 0xffu & ~(below | above); }
};

/// The first n of the eight parts.
[[nodiscard]] inline std::uint32_t first_parts(double n) {
  return (1u << std::clamp(static_cast<int>(n), 0, 8)) - 1u;
}

/// `low`: where the cell begins, in voxels. `margin`: how far its positions may lie off, in parts.
[[nodiscard]] inline AxisCut cut_at(double low, double margin, const SliceExtents& slices) {
  constexpr int kPositive = 1 << 21;  // truncates as floor does; what it rounds, the margin covers
  AxisCut cut;
  cut.voxel = static_cast<int>(low + kPositive) - kPositive;
  const double boundary = kCellParts * (cut.voxel + 1.0 - low);  // about 0 to 8
  cut.boundary = boundary;
  cut.below = first_parts(boundary - margin);
  cut.above = 0xffu & ~first_parts(boundary + margin + 1.0);
  for (std::uint32_t left = cut.open(); left != 0; left &= left - 1) {
    const auto slice = static_cast<std::size_t>(std::countr_zero(left));
    if (slices.high[slice] + margin < boundary)
      cut.below |= left & -left;
    else if (slices.low[slice] - margin >= boundary)
      cut.above |= left & -left;
  }
  const auto reopen = [&cut](std::uint32_t part) {
    cut.below &= ~part;
    cut.above &= ~part;
    cut.twice = true;
  };
  for (std::size_t slice = 0;
       boundary + margin - kCellParts >= static_cast<double>(slice) && slice < 8; ++slice)
    if (slices.low[slice] - margin < boundary - kCellParts) reopen(1u << slice);
  for (std::size_t slice = 7; boundary - margin + kCellParts <= static_cast<double>(slice + 1);
       --slice) {
    if (slices.high[slice] + margin >= boundary + kCellParts) reopen(1u << slice);
    if (slice == 0) break;
  }
  return cut;
}

/// Bits 8 y + x of a layer whose x is among the parts.
[[nodiscard]] inline std::uint64_t columns_of(std::uint32_t parts) {
  return parts * 0x0101010101010101ULL;
}
/// Bits 8 y + x of a layer whose y is among the parts.
[[nodiscard]] inline std::uint64_t rows_of(std::uint32_t parts) {
  // Spreads the eight bits to eight bytes, then fills the bytes.
  std::uint64_t spread = (parts & 0x0fu) | static_cast<std::uint64_t>(parts & 0xf0u) << 28;
  spread = (spread | spread << 14) & 0x0003000300030003ULL;
  spread = (spread | spread << 7) & 0x0101010101010101ULL;
  return spread * 0xffu;
}

/// One cell in one draw. Octants are the eight voxels around the point where the three boundaries
/// meet: bit 0 is above in x, bit 1 in y, bit 2 in z.
struct CellCut {
  AxisCut x, y, z;

  [[nodiscard]] bool twice() const { return x.twice || y.twice || z.twice; }
  [[nodiscard]] VoxelKey voxel(int octant) const {
    return {x.voxel + (octant & 1), y.voxel + (octant >> 1 & 1), z.voxel + (octant >> 2)};
  }
  /// Set of the octants that a part may lie in; one where it is sure.
  [[nodiscard]] std::uint32_t octants_of(unsigned part_x, unsigned part_y, unsigned part_z) const {
    const auto on = [](const AxisCut& cut, unsigned part, std::uint32_t lower,
                       std::uint32_t upper) {
      if ((cut.below >> part & 1) != 0) return lower;
      return (cut.above >> part & 1) != 0 ? upper : 0xffu;
    };
    return on(x, part_x, 0x55u, 0xaau) & on(y, part_y, 0x33u, 0xccu) & on(z, part_z, 0x0fu, 0xf0u);
  }
};

/// Number of set bits; spelt out, since the default build has no instruction for it.
[[nodiscard]] inline std::uint32_t count_bits(std::uint64_t bits) {
  bits -= bits >> 1 & 0x5555555555555555ULL;
  bits = (bits & 0x3333333333333333ULL) + (bits >> 2 & 0x3333333333333333ULL);
  bits = (bits + (bits >> 4)) & 0x0f0f0f0f0f0f0f0fULL;
  return static_cast<std::uint32_t>(bits * 0x0101010101010101ULL >> 56);
}

/// Calls act(part, its octants) for the filled parts of a cell that may lie in one of `wanted`, all
/// or only open ones; stops when it returns false.
void for_parts(const PositionCell& cell, const CellCut& cut, std::uint32_t wanted, bool only_open,
               auto&& act) {
  const std::uint64_t columns[2] = {columns_of(0xffu & ~cut.x.above),
                                    columns_of(0xffu & ~cut.x.below)};
  const std::uint64_t rows[2] = {rows_of(0xffu & ~cut.y.above), rows_of(0xffu & ~cut.y.below)};
  std::uint64_t within[2] = {0, 0};  // by side in z
  for (std::uint32_t left = wanted; left != 0; left &= left - 1) {
    const int octant = std::countr_zero(left);
    within[octant >> 2] |= columns[octant & 1] & rows[octant >> 1 & 1];
  }
  const std::uint64_t sure =
      ~((columns[0] & columns[1]) | (rows[0] & rows[1]));  // not open on either axis
  for (unsigned z = 0; z < 8; ++z) {
    const std::uint64_t layer = cell.layers[z];
    const bool below = (cut.z.below >> z & 1) != 0, above = (cut.z.above >> z & 1) != 0;
    std::uint64_t left = layer & ((above ? 0 : within[0]) | (below ? 0 : within[1]));
    if (only_open && (below || above)) left &= ~sure;
    for (; left != 0; left &= left - 1) {
      const auto bit = static_cast<unsigned>(std::countr_zero(left));
      const std::uint32_t part =
          cell.first_part[z] + count_bits(layer & ((std::uint64_t{1} << bit) - 1));
      if (!act(part, cut.octants_of(bit % 8, bit / 8, z))) return;
    }
  }
}

}  // namespace mapscore
