// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#pragma once

#include "core/geometry/pose.hpp"
#include "core/mapping/cell_cut.hpp"
#include "core/mapping/hit_grid.hpp"
#include "core/mapping/position_cells.hpp"

#include <optional>
#include <span>
#include <utility>
#include <vector>

namespace mapscore {

/// Voxels that some draw may hit, with room to spare. Empty where that box is too large for a
/// HitGrid, or where a draw is turned too far against the cells.
[[nodiscard]] std::optional<VoxelBox> reach_of(const PositionCells& cells,
                                               std::span<const Pose> T_map_sensor, double edge_m);

/// Places whole cells of positions at once (docs/fusion.md, Many draws): parts of a cell that lie
/// wholly in one voxel need no look at their positions, nor do open ones whose voxels are known to
/// be hit. `cells` and `grid` must outlive it.
class CellPlacer {
 public:
  CellPlacer(const PositionCells& cells, double edge_m, HitGrid& grid)
      : cells_(cells), edge_m_(edge_m), grid_(grid) {}

  /// Adds one draw to the grid: exactly the voxels that hold R p + t for some position p, and the
  /// counts where classes meet.
  void place(const Pose& T_map_sensor);

 private:
  /// A cell that must be looked at again once all sure voxels are marked, and the octants of it
  /// that may hold positions.
  struct Pending {
    const PositionCell* cell;
    CellCut cut;
    std::uint32_t octants;
  };

  [[nodiscard]] CellCut cut_of(const PositionCell& cell) const;
  void mark_sure(const PositionCell& cell);
  void mark_open(const Pending& pending);
  void count(const Pending& pending);
  /// Octants of those possible that a part may really reach by its box, and those that it surely
  /// does; for cells that are cut but once.
  [[nodiscard]] std::pair<std::uint32_t, std::uint32_t> narrowed(std::uint32_t part,
                                                                 std::uint32_t possible,
                                                                 const CellCut& cut) const;
  void mark_across(const Pending& pending);
  [[nodiscard]] Eigen::Vector3d placed(const Eigen::Vector3d& p_sensor) const;
  /// Octant of a position in a part that may reach `octants`; for cells that are cut but once.
  [[nodiscard]] std::uint32_t octant_of(const Eigen::Vector3d& p_sensor, std::uint32_t octants,
                                        const CellCut& cut) const;

  const PositionCells& cells_;
  double edge_m_;
  HitGrid& grid_;
  Eigen::Matrix3d R_, turn_;  ///< T_map_sensor's, and from the cells' lattice to the map
  Eigen::Vector3d t_, margin_;
  Eigen::Vector3d origin_;  ///< of the cells' lattice, in voxels of the map
  std::vector<Pending> open_, contested_;
};

}  // namespace mapscore
