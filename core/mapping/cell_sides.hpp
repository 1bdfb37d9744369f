// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#pragma once

#include "core/mapping/draw_batch.hpp"
#include "core/mapping/draw_set.hpp"
#include "core/mapping/position_cells.hpp"

#include <algorithm>
#include <array>

namespace mapscore {

/// Draws in which positions lie surely below the boundary of one axis, or surely above it. What is
/// in neither is open.
struct Sides {
  DrawSet below, above;
};

/// Draws whose boundary, whatever the turn, is above all positions of a level.
[[nodiscard]] inline DrawSet over_level(unsigned level, const DrawLevels& under) {
  return at_least(under, kLevelOffset + level + 1);
}

/// Draws whose boundary, whatever the turn, is below all positions of a level.
[[nodiscard]] inline DrawSet under_level(unsigned level, const DrawLevels& over) {
  return ~at_least(over, kLevelOffset + level + 1);
}

/// Sides of all positions within a range of levels.
[[nodiscard]] inline Sides sides_of(const LevelRange& range, const AxisCut& cut) {
  return {over_level(range.high, cut.under), under_level(range.low, cut.over)};
}

/// Draws in which positions within a range may lie across yet another boundary, a voxel away.
[[nodiscard]] inline DrawSet across(const LevelRange& range, const AxisCut& cut) {
  const DrawSet up =
      at_least(cut.under, std::max(kLevelOffset + range.high + 1, kCellLevels) - kCellLevels);
  return ~(under_level(range.low + kCellLevels, cut.over) & up);
}

/// The filled slices of a cell across each axis.
struct CellSides {
  std::array<std::array<Sides, kCellParts>, 3> slices;
  std::array<std::array<DrawSet, kCellParts>, 3> across;  ///< on neither side
  DrawSet any_across;                                     ///< none: `across` is not filled in

  [[nodiscard]] DrawSet across_part(std::size_t x, std::size_t y, std::size_t z) const {
    return across[0][x] | across[1][y] | across[2][z];
  }
};

/// Sides of a cell's slices in the draws of `all`; those that may reach across yet another boundary
/// are on neither.
void find_sides(const PositionCell& cell, const std::array<AxisCut, 3>& axes, const DrawSet& all,
                CellSides& sides);

/// By octant, draws in which positions surely lie in it and draws in which some may.
struct OctantSets {
  std::array<DrawSet, 8> sure, may;
};

[[nodiscard]] OctantSets octants_of(const PositionCell& cell, const CellSides& sides);

/// By octant, draws in which positions may lie that are on these sides.
[[nodiscard]] inline std::array<DrawSet, 8> may_reach(const Sides& x, const Sides& y,
                                                      const Sides& z) {
  const std::array<DrawSet, 4> layer{~x.above & ~y.above, ~x.below & ~y.above, ~x.above & ~y.below,
                                     ~x.below & ~y.below};
  std::array<DrawSet, 8> may;
  for (std::size_t octant = 0; octant < 8; ++octant)
    may[octant] = layer[octant & 3] & ~(octant < 4 ? z.above : z.below);
  return may;
}

}  // namespace mapscore
