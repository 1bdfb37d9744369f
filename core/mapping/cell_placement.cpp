// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#include "core/mapping/cell_placement.hpp"

#include <algorithm>
#include <bit>

namespace mapscore {
namespace {

/// Calls act(part, x, y, z) for the filled parts of a cell, in their order.
void for_parts(const PositionCell& cell, auto&& act) {
  for (std::size_t z = 0; z < kCellParts; ++z) {
    std::uint32_t part = cell.first_part[z];
    for (std::uint64_t left = cell.layers[z]; left != 0; left &= left - 1, ++part) {
      const auto bit = static_cast<std::size_t>(std::countr_zero(left));
      act(part, bit % 8, bit / 8, z);
    }
  }
}

/// Calls act(part, x, y, z) for the filled parts of a cell that may lie in one of the octants in a
/// draw wanted there.
void for_parts_in(const std::array<DrawSet, 8>& wanted, const PositionCell& cell,
                  const CellSides& sides, auto&& act) {
  const auto& [on_x, on_y, on_z] = sides.slices;
  for (std::size_t z = 0; z < kCellParts; ++z) {
    if (cell.layers[z] == 0) continue;
    std::uint32_t part = cell.first_part[z];
    std::array<DrawSet, 4> layer;
    for (std::size_t side = 0; side < 4; ++side)
      layer[side] = (wanted[side] & ~on_z[z].above) | (wanted[side + 4] & ~on_z[z].below);
    for (std::size_t y = 0; y < kCellParts; ++y) {
      auto row = static_cast<unsigned>(cell.layers[z] >> 8 * y & 0xff);
      if (row == 0) continue;
      const DrawSet below = (layer[0] & ~on_y[y].above) | (layer[2] & ~on_y[y].below);
      const DrawSet above = (layer[1] & ~on_y[y].above) | (layer[3] & ~on_y[y].below);
      if (!(below | above).any()) {
        part += count_bits(row);
        continue;
      }
      for (; row != 0; row &= row - 1, ++part) {
        const auto x = static_cast<std::size_t>(std::countr_zero(row));
        if (((below & ~on_x[x].above) | (above & ~on_x[x].below)).any()) act(part, x, y, z);
      }
    }
  }
}

/// Voxels that any draw may hit.
VoxelBox reach_of(const CutBases& cut) {
  VoxelBox box{cut.bases.front().voxel, cut.bases.front().voxel};
  for (const auto& [voxel, draws] : cut.bases) {
    box.low = {std::min(box.low.i, voxel.i), std::min(box.low.j, voxel.j),
               std::min(box.low.k, voxel.k)};
    box.high = {std::max(box.high.i, voxel.i), std::max(box.high.j, voxel.j),
                std::max(box.high.k, voxel.k)};
  }
  return {{box.low.i - 1, box.low.j - 1, box.low.k - 1},
          {box.high.i + 2, box.high.j + 2, box.high.k + 2}};
}

DrawSet any_of(const std::array<DrawSet, 8>& sets) {
  DrawSet any;
  for (const DrawSet& set : sets) any |= set;
  return any;
}

}  // namespace

void CellPlacer::mark_sure(const PositionCell& cell, CutCell& at) {
  std::array<AxisCut, 3> axes;
  batch_->cut(cell, axes, at.bases);
  find_sides(cell, axes, batch_->all(), at.sides);
  at.octants = octants_of(cell, at.sides);
  mark(at.octants.sure, at.bases, cell.group);
}

void CellPlacer::mark(const ByOctant& sets, const CutBases& bases, std::uint16_t group) {
  for (unsigned octant = 0; octant < 8; ++octant) {
    if (!sets[octant].any()) continue;
    for (const CutBase& base : bases.bases)
      if (const DrawSet draws = sets[octant] & base.draws; draws.any())
        grid_.mark(base.octant(octant), group, draws);
  }
}

/// Draws in which an octant is marked already need no proof.
void CellPlacer::mark_open(const PositionCell& cell, const CutCell& at) {
  ByOctant wanted;
  for (unsigned octant = 0; octant < 8; ++octant) {
    const DrawSet open = at.octants.may[octant] & ~at.octants.sure[octant];
    if (!open.any()) continue;
    for (const CutBase& base : at.bases.bases)
      if (const DrawSet draws = open & base.draws; draws.any())
        wanted[octant] |= draws & ~grid_.marked(base.octant(octant), cell.group);
  }
  if (!any_of(wanted).any()) return;
  const ByOctant before = wanted;
  for_parts_in(before, cell, at.sides, [&](auto part, auto x, auto y, auto z) {
    const auto& [on_x, on_y, on_z] = at.sides.slices;
    ByOctant may = may_reach(on_x[x], on_y[y], on_z[z]);
    for (std::size_t octant = 0; octant < 8; ++octant) may[octant] &= wanted[octant];
    if (!any_of(may).any()) return;
    if (at.sides.any_across.any())
      for (DrawSet& set : may) set &= ~at.sides.across_part(x, y, z);
    prove(part, at.bases, may, wanted);
  });
  ByOctant found;
  for (std::size_t octant = 0; octant < 8; ++octant)
    found[octant] = before[octant] & ~wanted[octant];
  mark(found, at.bases, cell.group);
}

void CellPlacer::prove(std::uint32_t part, const CutBases& bases, const ByOctant& may,
                       ByOctant& wanted) const {
  for_each_draw(any_of(may), [&](std::size_t draw) {
    const VoxelKey& base = bases.base(draw).voxel;
    unsigned open = 0;
    for (unsigned octant = 0; octant < 8; ++octant)
      open |= static_cast<unsigned>(may[octant].has(draw)) << octant;
    for (const Eigen::Vector3d& p : cells_.part(part)) {
      const unsigned octant = batch_->octant(p, draw, base);
      if ((open >> octant & 1) == 0) continue;
      wanted[octant] &= ~DrawSet::of(draw);
      open &= ~(1u << octant);
      if (open == 0) break;
    }
  });
}

/// Where a turn carries positions across a second boundary of one axis, position by position.
void CellPlacer::mark_across(const PositionCell& cell, const CutCell& at) {
  for_parts(cell, [&](auto part, auto x, auto y, auto z) {
    for_each_draw(at.sides.across_part(x, y, z), [&](std::size_t draw) {
      for (const Eigen::Vector3d& p : cells_.part(part))
        grid_.mark(batch_->voxel(p, draw), cell.group, DrawSet::of(draw));
    });
  });
}

void CellPlacer::count(const PositionCell& cell, const CutCell& at) {
  if (!grid_.contested_within(reach_of(at.bases))) return;
  ByOctant wanted;
  for (unsigned octant = 0; octant < 8; ++octant)
    for (const CutBase& base : at.bases.bases)
      if (const DrawSet draws = at.octants.may[octant] & base.draws; draws.any())
        wanted[octant] |= draws & grid_.contested(base.octant(octant));
  if (at.sides.any_across.any()) count_across(cell, at);
  for_parts_in(wanted, cell, at.sides, [&](auto part, auto x, auto y, auto z) {
    const auto& [on_x, on_y, on_z] = at.sides.slices;
    const std::span<const Eigen::Vector3d> positions = cells_.part(part);
    const DrawSet sure = (on_x[x].below | on_x[x].above) & (on_y[y].below | on_y[y].above) &
                         (on_z[z].below | on_z[z].above);
    const ByOctant may = may_reach(on_x[x], on_y[y], on_z[z]);
    DrawSet open;
    for (unsigned octant = 0; octant < 8; ++octant) {
      const DrawSet here = may[octant] & wanted[octant];
      open |= here & ~sure;
      for_each_draw(here & sure, [&](std::size_t draw) {
        grid_.count(at.bases.base(draw).octant(octant), cell.group, draw,
                    static_cast<int>(positions.size()));
      });
    }
    if (at.sides.any_across.any()) open &= ~at.sides.across_part(x, y, z);
    count_positions(part, cell.group, open);
  });
}

void CellPlacer::count_across(const PositionCell& cell, const CutCell& at) {
  for_parts(cell, [&](auto part, auto x, auto y, auto z) {
    count_positions(part, cell.group, at.sides.across_part(x, y, z));
  });
}

void CellPlacer::count_positions(std::uint32_t part, std::uint16_t group, const DrawSet& draws) {
  for_each_draw(draws, [&](std::size_t draw) {
    for (const Eigen::Vector3d& p : cells_.part(part))
      if (const VoxelKey voxel = batch_->voxel(p, draw); grid_.contested(voxel).has(draw))
        grid_.count(voxel, group, draw, 1);
  });
}

void CellPlacer::place(std::span<const Pose> T_map_sensor) {
  batch_.emplace(cells_, T_map_sensor, edge_m_);
  const std::vector<PositionCell>& cells = cells_.cells();
  cut_cells_.resize(cells.size());
  for (std::size_t n = 0; n < cells.size(); ++n) mark_sure(cells[n], cut_cells_[n]);
  for (std::size_t n = 0; n < cells.size(); ++n)
    if (cut_cells_[n].sides.any_across.any()) mark_across(cells[n], cut_cells_[n]);
  for (std::size_t n = 0; n < cells.size(); ++n) mark_open(cells[n], cut_cells_[n]);
  grid_.find_contested();
  for (std::size_t n = 0; n < cells.size(); ++n) count(cells[n], cut_cells_[n]);
  grid_.end_batch();
}

std::optional<VoxelBox> reach_of(const PositionCells& cells, std::span<const Pose> T_map_sensor,
                                 double edge_m) {
  constexpr double kMostTurn = 0.9;
  Eigen::AlignedBox3d q;
  for (const PositionCell& cell : cells.cells()) {
    q.extend(cell.low);
    q.extend(cell.low + Eigen::Vector3d::Ones());
  }
  if (q.isEmpty()) return {};
  Eigen::AlignedBox3d reach;
  for (const Pose& pose : T_map_sensor) {
    const Eigen::Matrix3d turn = pose.linear() * cells.R().transpose();
    const Eigen::Vector3d centre =
        turn * (q.center() - cells.offset()) + pose.translation() / edge_m;
    const Eigen::Vector3d half =
        turn.cwiseAbs() * (0.5 * q.sizes()) + Eigen::Vector3d::Constant(2.0);
    const double most = (turn - Eigen::Matrix3d::Identity()).cwiseAbs().rowwise().sum().maxCoeff();
    if (!(most < kMostTurn) || !(centre.cwiseAbs() + half).allFinite()) return {};
    reach.extend(centre - half);
    reach.extend(centre + half);
  }
  constexpr double kReach = 1 << 20;
  if (!(reach.min().minCoeff() >= -kReach && reach.max().maxCoeff() < kReach)) return {};
  const VoxelBox box{voxel_of(reach.min(), 1.0), voxel_of(reach.max(), 1.0)};
  return HitGrid::holds(box) ? std::optional(box) : std::nullopt;
}

}  // namespace mapscore
