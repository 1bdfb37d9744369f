// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#pragma once

#include "core/geometry/pose.hpp"

namespace mapscore {

/// Inverse of exp_pose for rotations below pi.
inline Vector6 log_pose(const Pose& pose) {
  const Eigen::AngleAxisd rotation(pose.linear());
  const Eigen::Vector3d omega = rotation.angle() * rotation.axis();
  Eigen::Matrix3d moved;  // by exp_pose with this rotation: the unit vectors
  for (int axis = 0; axis < 3; ++axis)
    moved.col(axis) =
        exp_pose((Vector6() << Eigen::Vector3d::Unit(axis), omega).finished()).translation();
  return (Vector6() << moved.inverse() * pose.translation(), omega).finished();
}

}  // namespace mapscore
