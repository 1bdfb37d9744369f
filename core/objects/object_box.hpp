// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#pragma once

#include "core/geometry/pose.hpp"

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <array>

namespace mapscore {

/// A box with axes of its own in some frame, closed. Metres.
struct ObjectBox {
  Pose T_frame_box = Pose::Identity();               ///< of the centre and axes
  Eigen::Vector3d size_m = Eigen::Vector3d::Zero();  ///< whole lengths along the axes, >= 0

  [[nodiscard]] Eigen::Vector3d centre() const { return T_frame_box.translation(); }
  [[nodiscard]] double volume_m3() const { return size_m.prod(); }
  /// Bit n of a corner's position says on which side of axis n it lies.
  [[nodiscard]] std::array<Eigen::Vector3d, 8> corners() const;
  [[nodiscard]] bool contains(const Eigen::Vector3d& p) const;
  /// Its bounds in the frame, along the frame's axes.
  [[nodiscard]] Eigen::AlignedBox3d bounds() const;
  /// Moved outwards by `margin_m` on each side.
  [[nodiscard]] ObjectBox widened(double margin_m) const {
    return {T_frame_box, (size_m.array() + 2.0 * margin_m).matrix()};
  }
};

/// The box of an axis-aligned one, which must not be empty.
[[nodiscard]] ObjectBox oriented(const Eigen::AlignedBox3d& box);

/// The box in the frame that T_to_frame leads to.
[[nodiscard]] inline ObjectBox moved(const Pose& T_to_frame, const ObjectBox& box) {
  return {T_to_frame * box.T_frame_box, box.size_m};
}

/// The least box with the axes of `axes` (a pose in the frame) about all of `box`, as an
/// axis-aligned box in the coordinates of `axes`.
[[nodiscard]] Eigen::AlignedBox3d cover_in(const Pose& axes, const ObjectBox& box);

/// True when two boxes have a point in common (separating axis theorem).
[[nodiscard]] bool meet(const ObjectBox& a, const ObjectBox& b);

/// Exact up to rounding: over the faces of either box that lie within the other, a third of the sum
/// of area times distance along the normal (divergence theorem).
[[nodiscard]] double intersection_m3(const ObjectBox& a, const ObjectBox& b);

/// Volume of the intersection over that of the union; 0 where the union has none.
[[nodiscard]] double iou(const ObjectBox& a, const ObjectBox& b);

/// Volume of the intersection over that of the smaller box: 1 when one lies in the other; 0 where
/// the smaller has none. Views of a part of an object have it near 1 with the whole.
[[nodiscard]] double overlap_share(const ObjectBox& a, const ObjectBox& b);

}  // namespace mapscore
