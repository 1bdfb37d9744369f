// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#pragma once

#include "core/geometry/pose.hpp"
#include "core/geometry/voxel.hpp"
#include "core/mapping/draw_set.hpp"
#include "core/mapping/position_cells.hpp"

#include <array>
#include <cstdint>
#include <span>
#include <vector>

namespace mapscore {

/// What levels of a DrawLevels begin with, so that boundaries a little outside a cell have one.
inline constexpr unsigned kLevelOffset = 64;

/// Draws that put the same voxel below the boundaries that cut a cell.
struct CutBase {
  VoxelKey voxel;
  DrawSet draws;

  /// Octants are the eight voxels around the point where the three boundaries meet: bit 0 is above
  /// in x, bit 1 in y, bit 2 in z.
  [[nodiscard]] VoxelKey octant(unsigned octant) const {
    return {voxel.i + static_cast<int>(octant & 1), voxel.j + static_cast<int>(octant >> 1 & 1),
            voxel.k + static_cast<int>(octant >> 2)};
  }
};

/// Where the draws of a batch cut one cell across one axis: at a boundary between voxels, less and
/// plus what the draw's turn against the lattice may do to a position, in levels from kLevelOffset
/// below the cell's low side, rounded outwards.
struct AxisCut {
  DrawLevels under, over;
};

/// The draws of a batch by the voxels that their boundaries across one cell meet at.
struct CutBases {
  std::array<std::uint8_t, DrawSet::kMost> of;  ///< by draw, into bases
  std::vector<CutBase> bases;

  [[nodiscard]] const CutBase& base(std::size_t draw) const { return bases[of[draw]]; }
};

/// At most DrawSet::kMost draws of one frame against the lattice of its cells.
class DrawBatch {
 public:
  DrawBatch(const PositionCells& cells, std::span<const Pose> T_map_sensor, double edge_m);

  [[nodiscard]] const DrawSet& all() const { return all_; }
  /// How the draws cut one cell, on each axis by one boundary.
  void cut(const PositionCell& cell, std::array<AxisCut, 3>& axes, CutBases& at) const;
  /// A position of the sensor frame in the map, as the plain form has it, so that the bits agree.
  [[nodiscard]] Eigen::Vector3d placed(const Eigen::Vector3d& p_sensor, std::size_t draw) const {
    return R_[draw] * p_sensor + t_[draw];
  }
  [[nodiscard]] VoxelKey voxel(const Eigen::Vector3d& p_sensor, std::size_t draw) const {
    return voxel_of(placed(p_sensor, draw), edge_m_);
  }
  /// Octant of a position that lies in one of the eight around its base.
  [[nodiscard]] unsigned octant(const Eigen::Vector3d& p_sensor, std::size_t draw,
                                const VoxelKey& base) const {
    // floor(p / edge) > voxel where p / edge >= voxel + 1.
    const Eigen::Vector3d p_map = placed(p_sensor, draw);
    return (p_map.x() / edge_m_ >= base.i + 1 ? 1u : 0u) |
           (p_map.y() / edge_m_ >= base.j + 1 ? 2u : 0u) |
           (p_map.z() / edge_m_ >= base.k + 1 ? 4u : 0u);
  }

 private:
  using ByDraw = std::array<double, DrawSet::kMost>;
  using Voxels = std::array<std::int32_t, DrawSet::kMost>;

  void cut_axis(std::size_t axis, const Eigen::Vector3d& centre, AxisCut& cut,
                Voxels& voxels) const;

  double edge_m_;
  std::size_t size_, padded_;  ///< the last draw stands for those that a vector lacks
  DrawSet all_;
  std::array<std::array<ByDraw, 3>, 3> turn_;  ///< from the cells' lattice to the map
  std::array<ByDraw, 3> origin_;               ///< of the cells' low corners, in voxels of the map
  std::array<ByDraw, 3> margin_;               ///< in levels
  std::vector<Eigen::Matrix3d> R_;
  std::vector<Eigen::Vector3d> t_;
};

}  // namespace mapscore
