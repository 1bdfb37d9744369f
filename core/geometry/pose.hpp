// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#pragma once

#include <Eigen/Geometry>

namespace mapscore {

/// Rigid transform. `T_a_b` takes coordinates in frame b to frame a: p_a = T_a_b * p_b. Metres.
using Pose = Eigen::Isometry3d;

/// Pose perturbation in the order x y z roll pitch yaw (metres, radians), and its covariance.
using Vector6 = Eigen::Matrix<double, 6, 1>;
using Covariance6 = Eigen::Matrix<double, 6, 6>;

/// Rotation by the angle |omega| about omega (radians).
[[nodiscard]] Eigen::Matrix3d exp_rotation(const Eigen::Vector3d& omega);

/// Exponential map of SE(3); xi in the order x y z roll pitch yaw. exp_pose(0) is exactly the
/// identity.
[[nodiscard]] Pose exp_pose(const Vector6& xi);

/// Logarithm of SE(3), the inverse of exp_pose for rotations below pi; order x y z roll pitch yaw.
[[nodiscard]] Vector6 log_pose(const Pose& pose);

/// Pose of a planar robot: position x, y on z = 0, heading yaw (radians).
[[nodiscard]] Pose planar_pose(double x_m, double y_m, double yaw_rad);

/// T_map_world of a map frame whose origin lies at `origin_m` in the world, turned by `yaw_rad`:
/// p_map = Rz(yaw)^T (p_world - origin).
[[nodiscard]] Pose map_from_world(const Eigen::Vector3d& origin_m, double yaw_rad);

}  // namespace mapscore
