// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#include "core/localization/planar_pose.hpp"

#include <array>
#include <cmath>
#include <numbers>

namespace mapscore {

double wrapped_angle(double angle_rad) {
  return std::remainder(angle_rad, 2.0 * std::numbers::pi);
}

PlanarPose operator*(const PlanarPose& T_a_b, const PlanarPose& T_b_c) {
  const Eigen::Vector2d p = T_a_b * Eigen::Vector2d(T_b_c.x_m, T_b_c.y_m);
  return {p.x(), p.y(), wrapped_angle(T_a_b.yaw_rad + T_b_c.yaw_rad)};
}

Eigen::Vector2d operator*(const PlanarPose& T_a_b, const Eigen::Vector2d& p_b) {
  const double c = std::cos(T_a_b.yaw_rad), s = std::sin(T_a_b.yaw_rad);
  return {T_a_b.x_m + c * p_b.x() - s * p_b.y(), T_a_b.y_m + s * p_b.x() + c * p_b.y()};
}

PlanarPose inverse(const PlanarPose& T_a_b) {
  const double c = std::cos(T_a_b.yaw_rad), s = std::sin(T_a_b.yaw_rad);
  return {-(c * T_a_b.x_m + s * T_a_b.y_m), s * T_a_b.x_m - c * T_a_b.y_m, -T_a_b.yaw_rad};
}

Pose spatial(const PlanarPose& pose) {
  return planar_pose(pose.x_m, pose.y_m, pose.yaw_rad);
}

PlanarPose planar(const Pose& pose) {
  const auto forward = pose.linear().col(0);
  return {pose.translation().x(), pose.translation().y(), std::atan2(forward.y(), forward.x())};
}

Eigen::Vector3d log_planar(const PlanarPose& pose) {
  const double yaw = wrapped_angle(pose.yaw_rad);
  const double half = 0.5 * yaw;
  // V^-1 = [a, h; -h, a] with h = yaw / 2 and a = h cot(h), which tends to 1 - h^2 / 3.
  const double a = std::abs(half) < 1e-5 ? 1.0 - half * half / 3.0 : half / std::tan(half);
  return {a * pose.x_m + half * pose.y_m, a * pose.y_m - half * pose.x_m, yaw};
}

Eigen::Matrix3d adjoint(const PlanarPose& T) {
  const double c = std::cos(T.yaw_rad), s = std::sin(T.yaw_rad);
  Eigen::Matrix3d ad;
  ad << c, -s, T.y_m, s, c, -T.x_m, 0, 0, 1;
  return ad;
}

PoseEstimate estimate_of(std::span<const PlanarPose> poses, std::span<const double> weights) {
  PoseEstimate estimate;
  double cosine = 0.0, sine = 0.0;
  for (std::size_t n = 0; n < poses.size(); ++n) {
    estimate.mean.x_m += weights[n] * poses[n].x_m;
    estimate.mean.y_m += weights[n] * poses[n].y_m;
    cosine += weights[n] * std::cos(poses[n].yaw_rad);
    sine += weights[n] * std::sin(poses[n].yaw_rad);
  }
  estimate.mean.yaw_rad = std::atan2(sine, cosine);
  const PlanarPose T_mean_map = inverse(estimate.mean);
  for (std::size_t n = 0; n < poses.size(); ++n) {
    const Eigen::Vector3d xi = log_planar(T_mean_map * poses[n]);
    estimate.covariance += weights[n] * xi * xi.transpose();
  }
  return estimate;
}

Covariance6 spatial_covariance(const Eigen::Matrix3d& covariance) {
  constexpr std::array<int, 3> kAxes = {0, 1, 5};
  Covariance6 spatial = Covariance6::Zero();
  spatial(kAxes, kAxes) = covariance;
  return spatial;
}

}  // namespace mapscore
