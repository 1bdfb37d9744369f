// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#pragma once

#include "core/geometry/pose.hpp"

#include <Eigen/Core>
#include <span>

namespace mapscore {

/// Pose of a robot in the plane. `T_a_b` takes coordinates in frame b to frame a, as Pose does.
struct PlanarPose {
  double x_m = 0.0, y_m = 0.0, yaw_rad = 0.0;
  bool operator==(const PlanarPose&) const = default;
};

/// The same angle in [-pi, pi].
[[nodiscard]] double wrapped_angle(double angle_rad);

/// T_a_c = T_a_b T_b_c; the yaw is wrapped.
[[nodiscard]] PlanarPose operator*(const PlanarPose& T_a_b, const PlanarPose& T_b_c);

/// p_a = T_a_b p_b.
[[nodiscard]] Eigen::Vector2d operator*(const PlanarPose& T_a_b, const Eigen::Vector2d& p_b);

/// T_b_a.
[[nodiscard]] PlanarPose inverse(const PlanarPose& T_a_b);

/// The pose in space, on z = 0.
[[nodiscard]] Pose spatial(const PlanarPose& pose);

/// x, y and heading (of the x axis, seen from above) of a pose in space; the rest is dropped.
[[nodiscard]] PlanarPose planar(const Pose& pose);

/// Logarithm of SE(2), order x y yaw: its exp_pose, of x, y and yaw alone, is spatial(pose).
[[nodiscard]] Eigen::Vector3d log_planar(const PlanarPose& pose);

/// Adjoint of SE(2), order x y yaw: T Exp(xi) T^-1 = Exp(Ad_T xi).
[[nodiscard]] Eigen::Matrix3d adjoint(const PlanarPose& T);

/// A pose T_map_base and the covariance of its error xi, T_true = T_mean Exp(xi): x y yaw in the
/// axes of base_footprint (metres, radians).
struct PoseEstimate {
  PlanarPose mean;
  Eigen::Matrix3d covariance = Eigen::Matrix3d::Zero();
};

/// Of weighted poses (weights sum to 1): mean position, circular mean of yaw, atan2(sum w sin yaw,
/// sum w cos yaw), and the mean of xi xi^T about it.
[[nodiscard]] PoseEstimate estimate_of(std::span<const PlanarPose> poses,
                                       std::span<const double> weights);

/// The covariance in the order x y z roll pitch yaw; zero for z, roll and pitch.
[[nodiscard]] Covariance6 spatial_covariance(const Eigen::Matrix3d& covariance);

}  // namespace mapscore
