// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#pragma once

#include "core/geometry/pose.hpp"

#include <mujoco/mujoco.h>

namespace mapscore::sim {

/// Pose from MuJoCo's position (3) and row-major rotation matrix (9).
[[nodiscard]] inline Pose pose_of(const mjtNum* position, const mjtNum* rotation) {
  using RowMajor3 = Eigen::Matrix<mjtNum, 3, 3, Eigen::RowMajor>;
  Pose pose = Pose::Identity();
  pose.linear() = Eigen::Map<const RowMajor3>(rotation).cast<double>();
  pose.translation() = Eigen::Map<const Eigen::Matrix<mjtNum, 3, 1>>(position).cast<double>();
  return pose;
}

/// World pose of a geom, its kinematics done.
[[nodiscard]] inline Pose geom_pose(const mjData& data, int geom) {
  return pose_of(data.geom_xpos + 3 * geom, data.geom_xmat + 9 * geom);
}

}  // namespace mapscore::sim
