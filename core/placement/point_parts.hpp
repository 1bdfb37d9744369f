// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#pragma once

#include "core/geometry/pose.hpp"
#include "core/geometry/voxel.hpp"
#include "core/placement/placement.hpp"

#include <Eigen/Geometry>
#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace mapscore {

/// Some points of one object.
struct PointPart {
  std::uint32_t object = 0;                 ///< its place in the observation
  std::span<const Eigen::Vector3d> points;  ///< sensor frame, metres
};

/// The points of an observation, which must outlive it, by parts. Can be moved, not copied.
struct PointParts {
  std::vector<PointPart> small;            ///< each within half a voxel
  std::vector<Eigen::AlignedBox3d> boxes;  ///< of the small ones: bounds of `to_voxels` p
  std::vector<PointPart> loose;            ///< all other points

  std::vector<std::vector<Eigen::Vector3d>> sorted;  ///< by object, what the small ones refer to

  PointParts() = default;
  PointParts(PointParts&&) = default;
  PointParts& operator=(PointParts&&) = default;
};

/// Sorts points into cubes of half a voxel, on a lattice with the coordinates `to_voxels` p for a
/// position p. Objects stay whole and loose where sorting would cost more than it saves in so many
/// draws; so do points, one by one, that are not finite or beyond +-2^15 voxels. Thread-safe.
[[nodiscard]] PointParts sort_into_parts(const Observation& observation,
                                         const Eigen::Matrix3d& to_voxels, std::size_t draws);

/// The boxes about parts of a frame's points, and which voxels they reach in a draw. Computed in
/// floats, with a margin that covers all rounding: no point of a part lies outside the voxels that
/// its box reaches. Not thread-safe.
class PartBoxes {
 public:
  /// Boxes are bounds of `to_voxels` p for positions p of the sensor frame (metres). Only poses
  /// among `T_map_sensor` can be moved to.
  PartBoxes(std::span<const Eigen::AlignedBox3d> boxes, const Eigen::Matrix3d& to_voxels,
            std::span<const Pose> T_map_sensor, double edge_m);

  /// Moves all boxes to where a draw has them. False, nothing moved, where a draw is so far off
  /// (2^19 voxels) or so unlike the others that the margin would not hold.
  [[nodiscard]] bool move_to(const Pose& T_map_sensor);

  /// True if the box lies in one voxel.
  [[nodiscard]] bool within_one_voxel(std::size_t box) const { return spread_[box] == 0; }
  /// The voxels that a box reaches: all from `low` to `high`.
  [[nodiscard]] VoxelKey low(std::size_t box) const {
    return {low_[0][box] + base_.i, low_[1][box] + base_.j, low_[2][box] + base_.k};
  }
  [[nodiscard]] VoxelKey high(std::size_t box) const {
    return {high_[0][box] + base_.i, high_[1][box] + base_.j, high_[2][box] + base_.k};
  }

 private:
  /// A draw in voxels: q of a box goes to turn q + shift in the map.
  struct Draw {
    Eigen::Matrix3d turn;
    Eigen::Vector3d shift;
    [[nodiscard]] bool covered() const;
  };
  [[nodiscard]] Draw draw_of(const Pose& T_map_sensor) const;
  void move_axis(std::size_t axis, const Eigen::RowVector3f& turn, float shift);

  double edge_m_;
  Eigen::Matrix3d from_voxels_;               ///< to_voxels^-1
  std::int32_t reach_ = 0;                    ///< voxels from the sensor to the farthest box
  std::array<std::vector<float>, 3> centre_;  ///< of boxes, by axis
  std::array<std::vector<float>, 3> half_;    ///< width in the map, whichever the draw
  VoxelKey base_;                             ///< added to low_ and high_, which are positive
  std::array<std::vector<std::int32_t>, 3> low_, high_;
  std::vector<std::int32_t> spread_;  ///< 0: low and high are one voxel
};

}  // namespace mapscore
