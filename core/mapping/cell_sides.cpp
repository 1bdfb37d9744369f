// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#include "core/mapping/cell_sides.hpp"

#include <bit>

namespace mapscore {

namespace {

bool filled(const LevelRange& range) {
  return range.low <= range.high;
}

void find_across(const PositionCell& cell, const std::array<AxisCut, 3>& axes, const DrawSet& all,
                 CellSides& sides) {
  for (std::size_t axis = 0; axis < 3; ++axis)
    for (std::size_t slice = 0; slice < kCellParts; ++slice) {
      const LevelRange& range = cell.slices[axis][slice];
      sides.across[axis][slice] = {};
      if (!filled(range)) continue;
      const DrawSet open = across(range, axes[axis]) & all;
      sides.across[axis][slice] = open;
      sides.slices[axis][slice].below &= ~open;
      sides.slices[axis][slice].above &= ~open;
    }
}

}  // namespace

void find_sides(const PositionCell& cell, const std::array<AxisCut, 3>& axes, const DrawSet& all,
                CellSides& sides) {
  sides.any_across = {};
  for (std::size_t axis = 0; axis < 3; ++axis) {
    LevelRange whole;
    for (std::size_t slice = 0; slice < kCellParts; ++slice) {
      const LevelRange& range = cell.slices[axis][slice];
      if (!filled(range)) continue;
      whole.extend(range.low);
      whole.extend(range.high);
      sides.slices[axis][slice] = sides_of(range, axes[axis]);
    }
    sides.any_across |= across(whole, axes[axis]) & all;
  }
  if (sides.any_across.any()) find_across(cell, axes, all, sides);
}

/// Slices ascend, so what reaches below a boundary does so in the first of a row, and what reaches
/// above it in the last.
OctantSets octants_of(const PositionCell& cell, const CellSides& sides) {
  OctantSets sets;
  const auto& [x, y, z] = sides.slices;
  for (std::size_t layer = 0; layer < kCellParts; ++layer) {
    if (cell.layers[layer] == 0) continue;
    std::array<DrawSet, 4> sure, may;
    for (std::size_t row = 0; row < kCellParts; ++row) {
      const auto filled = static_cast<std::uint8_t>(cell.layers[layer] >> 8 * row);
      if (filled == 0) continue;
      const Sides& first = x[static_cast<std::size_t>(std::countr_zero(filled))];
      const Sides& last = x[static_cast<std::size_t>(7 - std::countl_zero(filled))];
      sure[0] |= first.below & y[row].below;
      sure[1] |= last.above & y[row].below;
      sure[2] |= first.below & y[row].above;
      sure[3] |= last.above & y[row].above;
      may[0] |= ~first.above & ~y[row].above;
      may[1] |= ~last.below & ~y[row].above;
      may[2] |= ~first.above & ~y[row].below;
      may[3] |= ~last.below & ~y[row].below;
    }
    for (std::size_t octant = 0; octant < 8; ++octant) {
      const Sides& on = z[layer];
      sets.sure[octant] |= sure[octant & 3] & (octant < 4 ? on.below : on.above);
      sets.may[octant] |= may[octant & 3] & ~(octant < 4 ? on.above : on.below);
    }
  }
  return sets;
}

}  // namespace mapscore
