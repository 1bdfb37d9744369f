// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#pragma once

#include "core/geometry/pose.hpp"

#include <Eigen/Core>
#include <optional>
#include <span>

namespace mapscore {

/// Box that need not lie along its frame's axes. Its own frame has its origin in the box's centre
/// and its axes along the edges.
struct OrientedBox {
  Pose T_frame_box = Pose::Identity();               ///< box -> the frame of the points
  Eigen::Vector3d size_m = Eigen::Vector3d::Zero();  ///< lengths of its edges along its own axes
};

/// The upright box around some points: its z axis is `up` (in the points' frame, of any length), so
/// that objects stand in it as they stand on a floor or table; seen along `up` it is the rectangle
/// of least area around the points, x along the longer side, turned by less than half a turn.
/// Points that are not finite are left out; without any there is no box. Flat, straight and single
/// points give sides of length 0. O(n log n). Throws Error when `up` is zero or not finite.
[[nodiscard]] std::optional<OrientedBox> upright_box(std::span<const Eigen::Vector3d> points,
                                                     const Eigen::Vector3d& up);

/// What is up in depth_optical, for a robot on a level floor: the z axis of base_footprint.
[[nodiscard]] inline Eigen::Vector3d up_in_depth(const Pose& T_base_depth) {
  return T_base_depth.linear().transpose() * Eigen::Vector3d::UnitZ();
}

}  // namespace mapscore
