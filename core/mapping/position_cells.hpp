// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#pragma once

#include "core/classes.hpp"
#include "core/geometry/pose.hpp"
#include "core/mapping/observation.hpp"

#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

namespace mapscore {

/// Objects of one class and one score: within a draw they count as one.
struct ScoredClass {
  ClassId class_id = kBackground;
  double score = 0.0;
};

/// Least and greatest coordinate of the positions in each of a cell's slices across one axis, in
/// parts from the cell's low side; far apart the wrong way where a slice is empty.
struct SliceExtents {
  std::array<float, 8> low, high;
};

/// A cube of one voxel's edge, cut into 8 x 8 x 8 parts, and which of them hold positions of one
/// group.
struct PositionCell {
  Eigen::Vector3d low;                  ///< low corner, in voxels, in the turned sensor frame
  std::array<std::uint64_t, 8> layers;  ///< by z: bit 8 y + x is set where a part holds positions
  std::array<SliceExtents, 3> slices;   ///< by axis
  std::array<std::uint32_t, 8> first_part;  ///< filled ones of each layer, which follow by y, x
  std::uint16_t group = 0;
  bool contested = false;  ///< positions of another class may share a voxel with it
};

/// Tight box around the positions of one filled part, in voxels from the low corner of its cell.
struct PartBox {
  Eigen::Vector3f low = Eigen::Vector3f::Constant(2.0f), high = Eigen::Vector3f::Constant(-1.0f);
};

/// The positions of an observation, sorted into cells of a lattice that turns with the sensor:
/// q = R p / edge + offset. R is the rotation of one draw, and the offset puts the map's boundaries
/// in that draw amid the cells' parts. Made once a frame, read by each draw.
class PositionCells {
 public:
  /// Most groups that are told apart.
  static constexpr std::size_t kMostGroups = 64;

  /// Empty where the observation does not suit: more groups, a position that is not finite, or one
  /// farther than 4096 cells from the others.
  [[nodiscard]] static std::optional<PositionCells> sort(const Observation& observation,
                                                         const Pose& T_map_sensor, double edge_m);

  [[nodiscard]] const std::vector<ScoredClass>& groups() const { return groups_; }
  [[nodiscard]] const std::vector<PositionCell>& cells() const { return cells_; }
  /// Positions in the sensor frame (metres) of one filled part.
  [[nodiscard]] std::span<const Eigen::Vector3d> part(std::uint32_t index) const {
    return std::span(positions_)
        .subspan(part_begin_[index], part_begin_[index + 1] - part_begin_[index]);
  }
  [[nodiscard]] const PartBox& box(std::uint32_t index) const { return boxes_[index]; }
  [[nodiscard]] const Eigen::Matrix3d& R() const { return R_; }
  [[nodiscard]] const Eigen::Vector3d& offset() const { return offset_; }

 private:
  void measure_slices();
  void mark_contested();

  Eigen::Matrix3d R_;
  Eigen::Vector3d offset_;
  std::vector<ScoredClass> groups_;  ///< ascending by class, then score
  std::vector<PositionCell> cells_;
  std::vector<std::uint32_t> part_begin_;
  std::vector<PartBox> boxes_;
  std::vector<Eigen::Vector3d> positions_;
};

}  // namespace mapscore
