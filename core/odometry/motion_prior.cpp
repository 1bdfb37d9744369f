// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#include "core/odometry/motion_prior.hpp"

#include <Eigen/LU>
#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

namespace mapscore {
namespace {

constexpr double kRadPerDeg = std::numbers::pi / 180.0;

/// Of the last motion that goes on at the same speed.
double going_on(const LastStep& last, double dt_s) {
  return last.duration_s > 0.0 ? dt_s / last.duration_s : 0.0;
}

}  // namespace

Covariance6 sigmas6(double xy_m, double z_m, double tilt_rad, double yaw_rad) {
  Vector6 sigmas;
  sigmas << xy_m, xy_m, z_m, tilt_rad, tilt_rad, yaw_rad;
  return sigmas.cwiseAbs2().asDiagonal();
}

MotionPrior wheel_motion(const Pose& T_before_after, const OdometryNoise& noise) {
  const OdometryMotion motion = motion_parts(planar(T_before_after), noise.least_way_m);
  const Covariance6 of_wheels =
      spatial_covariance(motion_covariance(motion, motion_sigmas(motion, noise)));
  return {T_before_after, of_wheels + sigmas6(0.001, 0.005, 0.5 * kRadPerDeg, 0.1 * kRadPerDeg)};
}

MotionPrior robot_motion(const LastStep& last, double dt_s) {
  const double half = 0.5 * dt_s * dt_s;
  return {
      exp_pose(log_pose(last.T_before_after) * going_on(last, std::min(dt_s, 2.0))),
      sigmas6(0.5 * half + 0.001, 0.002 + 0.05 * half, 0.2 * kRadPerDeg + 5.0 * kRadPerDeg * half,
              85.0 * kRadPerDeg * half + 0.1 * kRadPerDeg)};
}

MotionPrior hand_motion(const LastStep& last, double dt_s) {
  constexpr double kMemory_s = 0.1;
  const Vector6 step = log_pose(last.T_before_after);
  const double same_speed = going_on(last, dt_s);
  const double kept =
      same_speed > 0.0 ? kMemory_s * (1.0 - std::exp(-dt_s / kMemory_s)) / last.duration_s : 0.0;
  const Vector6 forgotten = step * std::max(std::min(same_speed, 1.0) - kept, 0.0);
  const double half = 0.5 * std::min(dt_s, 1.0) * std::min(dt_s, 1.0);
  const double m = 3.0 * half + 0.002, rad = 300.0 * kRadPerDeg * half + 0.2 * kRadPerDeg;
  Covariance6 noise = sigmas6(m, m, rad, rad);
  noise.diagonal() += forgotten.cwiseAbs2();
  return {exp_pose(step * kept), noise};
}

PosePrior on_floor(const PosePrior& prior) {
  constexpr std::array kAxes{2, 3, 4};
  const Covariance6 noise = sigmas6(1.0, 0.01, 1.0 * kRadPerDeg, 1.0);
  const Eigen::Vector3d up = prior.mean.linear().row(2);
  const Eigen::Vector3d off(-prior.mean.translation().z(), -up.y(), up.x());
  const Eigen::Matrix<double, 6, 3> cross = prior.covariance(Eigen::all, kAxes);
  const Eigen::Matrix3d sum = prior.covariance(kAxes, kAxes) + noise(kAxes, kAxes);
  const Eigen::Matrix<double, 6, 3> gain = cross * sum.inverse();
  const Covariance6 left = prior.covariance - gain * cross.transpose();
  return {prior.mean * exp_pose(gain * off), 0.5 * (left + left.transpose()), true};
}

Covariance6 moved(const Covariance6& covariance, const Pose& T_before_after) {
  const Covariance6 ad = adjoint(T_before_after.inverse());
  return ad * covariance * ad.transpose();
}

}  // namespace mapscore
