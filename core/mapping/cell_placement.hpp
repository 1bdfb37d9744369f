// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#pragma once

#include "core/geometry/pose.hpp"
#include "core/mapping/cell_sides.hpp"
#include "core/mapping/draw_batch.hpp"
#include "core/mapping/hit_grid.hpp"
#include "core/mapping/position_cells.hpp"

#include <array>
#include <optional>
#include <span>
#include <vector>

namespace mapscore {

/// Voxels that some draw may hit, with room to spare. Empty where that box is too large for a
/// HitGrid, or where a draw is turned too far against the cells.
[[nodiscard]] std::optional<VoxelBox> reach_of(const PositionCells& cells,
                                               std::span<const Pose> T_map_sensor, double edge_m);

/// Places whole cells of positions in all draws of a batch at once (docs/fusion.md, Many draws):
/// parts of a cell that lie wholly in one voxel need no look at their positions, nor do open ones
/// whose voxels are known to be hit. `cells` and `grid` must outlive it.
class CellPlacer {
 public:
  CellPlacer(const PositionCells& cells, double edge_m, HitGrid& grid)
      : cells_(cells), edge_m_(edge_m), grid_(grid) {}

  /// Adds one batch of draws to the grid: exactly the voxels that hold R p + t for some position p,
  /// and the counts where classes meet.
  void place(std::span<const Pose> T_map_sensor);

 private:
  /// A cell and what the batch does to it.
  struct CutCell {
    CutBases bases;
    CellSides sides;
    OctantSets octants;
  };
  using ByOctant = std::array<DrawSet, 8>;

  void mark(const ByOctant& sets, const CutBases& bases, std::uint16_t group);
  void mark_sure(const PositionCell& cell, CutCell& at);
  void mark_open(const PositionCell& cell, const CutCell& at);
  void mark_across(const PositionCell& cell, const CutCell& at);
  /// Takes the draws out of `wanted` in which positions of a part lie, given those in which they
  /// may.
  void prove(std::uint32_t part, const CutBases& bases, const ByOctant& may,
             ByOctant& wanted) const;
  void count(const PositionCell& cell, const CutCell& at);
  void count_across(const PositionCell& cell, const CutCell& at);
  /// Counts one by one those positions of a part that lie in contested voxels.
  void count_positions(std::uint32_t part, std::uint16_t group, const DrawSet& draws);

  const PositionCells& cells_;
  double edge_m_;
  HitGrid& grid_;
  std::optional<DrawBatch> batch_;
  std::vector<CutCell> cut_cells_;
};

}  // namespace mapscore
