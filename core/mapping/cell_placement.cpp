// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#include "core/mapping/cell_placement.hpp"

#include <array>

namespace mapscore {
namespace {

/// In parts of a cell; far above the rounding of coordinates within a million voxels, far below
/// what costs time.
constexpr double kRounding = 4e-6;

/// Voxels from a cut's on, of a coordinate in parts of the cell.
int voxels_on(const AxisCut& cut, double parts) {
  return (parts >= cut.boundary ? 1 : 0) + (parts >= cut.boundary + kCellParts ? 1 : 0) -
         (parts < cut.boundary - kCellParts ? 1 : 0);
}

}  // namespace

CellCut CellPlacer::cut_of(const PositionCell& cell) const {
  const Eigen::Vector3d half = Eigen::Vector3d::Constant(0.5);
  const Eigen::Vector3d low = turn_ * (cell.low + half) + origin_ - half;
  return {cut_at(low.x(), margin_.x(), cell.slices[0]),
          cut_at(low.y(), margin_.y(), cell.slices[1]),
          cut_at(low.z(), margin_.z(), cell.slices[2])};
}

/// As the plain form has it, so that the bits agree.
Eigen::Vector3d CellPlacer::placed(const Eigen::Vector3d& p_sensor) const {
  return R_ * p_sensor + t_;
}

std::uint32_t CellPlacer::octant_of(const Eigen::Vector3d& p_sensor, std::uint32_t octants,
                                    const CellCut& cut) const {
  const Eigen::Vector3d p_map = placed(p_sensor);
  // floor(p / edge) > voxel where p / edge >= voxel + 1; asked on open axes alone.
  const auto on = [&](const AxisCut& axis, double p, std::uint32_t lower) {
    if ((octants & lower) == 0 || (octants & ~lower) == 0) return 0xffu;
    return p / edge_m_ >= axis.voxel + 1 ? ~lower : lower;
  };
  return octants & on(cut.x, p_map.x(), 0x55u) & on(cut.y, p_map.y(), 0x33u) &
         on(cut.z, p_map.z(), 0x0fu);
}

void CellPlacer::mark_sure(const PositionCell& cell) {
  const CellCut cut = cut_of(cell);
  std::uint64_t side[2] = {0, 0}, open = 0;
  for (unsigned z = 0; z < 8; ++z) {
    const std::uint64_t below = 0 - std::uint64_t{cut.z.below >> z & 1};
    const std::uint64_t above = 0 - std::uint64_t{cut.z.above >> z & 1};
    side[0] |= cell.layers[z] & below;
    side[1] |= cell.layers[z] & above;
    open |= cell.layers[z] & ~(below | above);
  }
  const std::uint64_t columns[2] = {columns_of(cut.x.below), columns_of(cut.x.above)};
  const std::uint64_t rows[2] = {rows_of(cut.y.below), rows_of(cut.y.above)};
  const std::uint64_t open_columns = ~(columns[0] | columns[1]);
  const std::uint64_t open_rows = ~(rows[0] | rows[1]);
  std::uint32_t sure = 0, maybe = 0;
  for (unsigned octant = 0; octant < 8; ++octant) {
    const std::uint64_t column = columns[octant & 1], row = rows[octant >> 1 & 1];
    const std::uint64_t layer = side[octant >> 2];
    const std::uint64_t reached = (layer | open) & (column | open_columns) & (row | open_rows);
    sure |= std::uint32_t{(layer & column & row) != 0} << octant;
    maybe |= std::uint32_t{reached != 0} << octant;
  }
  for (std::uint32_t left = sure; left != 0; left &= left - 1)
    grid_.mark(cut.voxel(std::countr_zero(left)), cell.group);
  const std::uint64_t sure_parts = ~open_columns & ~open_rows;
  const bool across =
      cut.twice() && (open | ((side[0] | side[1]) & ~sure_parts)) != 0;  // some part is open
  if (across || (maybe & ~sure) != 0) open_.push_back({&cell, cut, across ? 0xffu : maybe & ~sure});
  if (cell.contested) contested_.push_back({&cell, cut, maybe});
}

std::pair<std::uint32_t, std::uint32_t> CellPlacer::narrowed(std::uint32_t part,
                                                             std::uint32_t possible,
                                                             const CellCut& cut) const {
  const PartBox& box = cells_.box(part);
  int spans = 0;
  std::uint32_t surely = 0;
  const auto narrow = [&](const AxisCut& axis, int a, std::uint32_t lower) {
    if ((possible & lower) == 0 || (possible & ~lower) == 0) return;
    const double low = kCellParts * double{box.low[a]}, high = kCellParts * double{box.high[a]};
    if (high + margin_[a] < axis.boundary) {
      possible &= lower;
    } else if (low - margin_[a] >= axis.boundary) {
      possible &= ~lower;
    } else {  // the box is tight: it has positions at both ends
      ++spans;
      if (low + margin_[a] < axis.boundary) surely |= lower;
      if (high - margin_[a] >= axis.boundary) surely |= ~lower;
    }
  };
  narrow(cut.x, 0, 0x55u);
  narrow(cut.y, 1, 0x33u);
  narrow(cut.z, 2, 0x0fu);
  if (spans == 0) return {possible, possible};
  return {possible, spans == 1 ? possible & surely : 0};
}

/// Octants that are marked already need no proof.
void CellPlacer::mark_open(const Pending& pending) {
  const auto& [cell, cut, octants] = pending;
  if (cut.twice()) return mark_across(pending);
  std::uint32_t wanted = octants;
  for (std::uint32_t left = octants; left != 0; left &= left - 1)
    if (grid_.marked(cut.voxel(std::countr_zero(left)), cell->group)) wanted &= ~(left & -left);
  if (wanted == 0) return;
  const auto found = [&, group = cell->group, &at = cut](std::uint32_t found_octants) {
    for (std::uint32_t left = found_octants & wanted; left != 0; left &= left - 1)
      grid_.mark(at.voxel(std::countr_zero(left)), group);
    wanted &= ~found_octants;
  };
  for_parts(*cell, cut, wanted, true, [&, &cut = cut](std::uint32_t part, std::uint32_t possible) {
    if ((possible & wanted) == 0) return true;
    const auto [reached, surely] = narrowed(part, possible, cut);
    found(surely);
    if ((reached & ~surely & wanted) == 0) return wanted != 0;
    for (const Eigen::Vector3d& p : cells_.part(part)) {
      found(octant_of(p, reached, cut));
      if ((reached & wanted) == 0) break;
    }
    return wanted != 0;
  });
}

/// Cells that two boundaries of one axis may cut: open parts by their boxes, then by position.
void CellPlacer::mark_across(const Pending& pending) {
  const CellCut& cut = pending.cut;
  const std::uint16_t group = pending.cell->group;
  for_parts(*pending.cell, cut, 0xffu, true, [&](std::uint32_t part, std::uint32_t) {
    const PartBox& box = cells_.box(part);
    const Eigen::Vector3d low = kCellParts * box.low.cast<double>() - margin_;
    const Eigen::Vector3d high = kCellParts * box.high.cast<double>() + margin_;
    const int x = voxels_on(cut.x, low.x()), y = voxels_on(cut.y, low.y()),
              z = voxels_on(cut.z, low.z());
    if (x == voxels_on(cut.x, high.x()) && y == voxels_on(cut.y, high.y()) &&
        z == voxels_on(cut.z, high.z())) {
      grid_.mark({cut.x.voxel + x, cut.y.voxel + y, cut.z.voxel + z}, group);
      return true;
    }
    for (const Eigen::Vector3d& p : cells_.part(part))
      grid_.mark(voxel_of(placed(p), edge_m_), group);
    return true;
  });
}

/// Counts a cell's positions in voxels where classes meet.
void CellPlacer::count(const Pending& pending) {
  const PositionCell& cell = *pending.cell;
  const CellCut& cut = pending.cut;
  const bool twice = cut.twice();
  std::uint32_t wanted = twice ? 0xffu : 0u;
  for (std::uint32_t left = twice ? 0 : pending.octants; left != 0; left &= left - 1)
    if (grid_.contested(cut.voxel(std::countr_zero(left)))) wanted |= left & -left;
  if (wanted == 0) return;
  std::array<int, 8> counts{};
  const auto add = [&](std::uint32_t octant, std::size_t positions) {
    counts[static_cast<std::size_t>(std::countr_zero(octant))] += static_cast<int>(positions);
  };
  for_parts(cell, cut, wanted, false, [&](std::uint32_t part, std::uint32_t possible) {
    const std::span<const Eigen::Vector3d> positions = cells_.part(part);
    if (!std::has_single_bit(possible) && !twice) possible = narrowed(part, possible, cut).first;
    if (std::has_single_bit(possible)) {
      add(possible, positions.size());
      return true;
    }
    for (const Eigen::Vector3d& p : positions) {
      if (twice)
        grid_.count(voxel_of(placed(p), edge_m_), cell.group, 1);
      else
        add(octant_of(p, possible, cut), 1);
    }
    return true;
  });
  for (int octant = 0; octant < 8; ++octant)
    if (const int positions = counts[static_cast<std::size_t>(octant)];
        positions > 0 && (wanted >> octant & 1) != 0)
      grid_.count(cut.voxel(octant), cell.group, positions);
}

void CellPlacer::place(const Pose& T_map_sensor) {
  R_ = T_map_sensor.linear();
  t_ = T_map_sensor.translation();
  turn_ = R_ * cells_.R().transpose();
  origin_ = t_ / edge_m_ - turn_ * cells_.offset();
  const Eigen::Matrix3d off = (turn_ - Eigen::Matrix3d::Identity()).cwiseAbs();
  margin_ = (0.5 * kCellParts * off.rowwise().sum()).array() + kRounding;
  open_.clear();
  contested_.clear();
  for (const PositionCell& cell : cells_.cells()) mark_sure(cell);
  for (const Pending& pending : open_) mark_open(pending);
  for (const Pending& pending : contested_) count(pending);
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
