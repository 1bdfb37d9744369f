// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#include "core/geometry/pose.hpp"

#include <Eigen/LU>
#include <cmath>

namespace mapscore {
namespace {

Eigen::Matrix3d skew(const Eigen::Vector3d& v) {
  Eigen::Matrix3d m;
  m << 0, -v.z(), v.y(), v.z(), 0, -v.x(), -v.y(), v.x(), 0;
  return m;
}

/// Left Jacobian of SO(3): the translation part of Exp(rho, omega) is V(omega) * rho.
Eigen::Matrix3d left_jacobian(const Eigen::Vector3d& omega) {
  const double angle = omega.norm();
  const Eigen::Matrix3d w = skew(omega);
  if (angle < 1e-5) return Eigen::Matrix3d::Identity() + 0.5 * w + w * w / 6.0;
  const double a2 = angle * angle;
  return Eigen::Matrix3d::Identity() + (1.0 - std::cos(angle)) / a2 * w +
         (angle - std::sin(angle)) / (a2 * angle) * w * w;
}

}  // namespace

Eigen::Matrix3d exp_rotation(const Eigen::Vector3d& omega) {
  const double angle = omega.norm();
  if (angle == 0.0) return Eigen::Matrix3d::Identity();
  return Eigen::AngleAxisd(angle, omega / angle).toRotationMatrix();
}

Pose exp_pose(const Vector6& xi) {
  const Eigen::Vector3d omega = xi.tail<3>();
  Pose pose = Pose::Identity();
  pose.linear() = exp_rotation(omega);
  pose.translation() = left_jacobian(omega) * xi.head<3>();
  return pose;
}

Vector6 log_pose(const Pose& pose) {
  const Eigen::AngleAxisd turn(pose.linear());
  const Eigen::Vector3d omega = turn.angle() * turn.axis();
  Vector6 xi;
  xi << left_jacobian(omega).inverse() * pose.translation(), omega;
  return xi;
}

Covariance6 adjoint(const Pose& T) {
  Covariance6 ad = Covariance6::Zero();
  ad.topLeftCorner<3, 3>() = ad.bottomRightCorner<3, 3>() = T.linear();
  ad.topRightCorner<3, 3>() = skew(T.translation()) * T.linear();
  return ad;
}

Pose planar_pose(double x_m, double y_m, double yaw_rad) {
  Pose pose = Pose::Identity();
  pose.linear() = exp_rotation(yaw_rad * Eigen::Vector3d::UnitZ());
  pose.translation() = Eigen::Vector3d(x_m, y_m, 0.0);
  return pose;
}

Pose map_from_world(const Eigen::Vector3d& origin_m, double yaw_rad) {
  Pose pose = Pose::Identity();
  pose.linear() = exp_rotation(-yaw_rad * Eigen::Vector3d::UnitZ());
  pose.translation() = -(pose.linear() * origin_m);
  return pose;
}

}  // namespace mapscore
