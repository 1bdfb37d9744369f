// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#include "core/localization/odometry_motion.hpp"

#include "core/error.hpp"

#include <cmath>
#include <numbers>
#include <string>

namespace mapscore {
namespace {

void check(double alpha, const char* name) {
  if (!(std::isfinite(alpha) && alpha >= 0))
    throw Error(std::string(name) + ": is " + std::to_string(alpha) +
                "; give a variance factor of at least 0");
}

}  // namespace

OdometryMotion motion_parts(const PlanarPose& T_before_after, double least_way_m) {
  const double way = std::hypot(T_before_after.x_m, T_before_after.y_m);
  const double yaw = wrapped_angle(T_before_after.yaw_rad);
  if (way < least_way_m) return {0.0, T_before_after.x_m < 0 ? -way : way, yaw};
  const double direction = std::atan2(T_before_after.y_m, T_before_after.x_m);
  const bool backwards = std::abs(direction) > 0.5 * std::numbers::pi;
  const double rot1 = backwards ? wrapped_angle(direction + std::numbers::pi) : direction;
  return {rot1, backwards ? -way : way, wrapped_angle(yaw - rot1)};
}

PlanarPose motion_pose(const OdometryMotion& motion) {
  return {motion.trans_m * std::cos(motion.rot1_rad), motion.trans_m * std::sin(motion.rot1_rad),
          wrapped_angle(motion.rot1_rad + motion.rot2_rad)};
}

MotionSigmas motion_sigmas(const OdometryMotion& motion, const OdometryNoise& noise) {
  check(noise.alpha1, "alpha1");
  check(noise.alpha2, "alpha2");
  check(noise.alpha3, "alpha3");
  check(noise.alpha4, "alpha4");
  const double rot1 = motion.rot1_rad * motion.rot1_rad;
  const double rot2 = motion.rot2_rad * motion.rot2_rad;
  const double trans = motion.trans_m * motion.trans_m;
  return {std::sqrt(noise.alpha1 * rot1 + noise.alpha2 * trans),
          std::sqrt(noise.alpha3 * trans + noise.alpha4 * (rot1 + rot2)),
          std::sqrt(noise.alpha1 * rot2 + noise.alpha2 * trans)};
}

PlanarPose sample_motion(const OdometryMotion& motion, const MotionSigmas& sigmas,
                         RandomStream& stream) {
  OdometryMotion drawn = motion;
  drawn.rot1_rad += sigmas.rot1_rad * stream.normal();
  drawn.trans_m += sigmas.trans_m * stream.normal();
  drawn.rot2_rad += sigmas.rot2_rad * stream.normal();
  return motion_pose(drawn);
}

Eigen::Matrix3d motion_covariance(const OdometryMotion& motion, const MotionSigmas& sigmas) {
  const double c = std::cos(motion.rot2_rad), s = std::sin(motion.rot2_rad);
  Eigen::Matrix3d by_part;  // columns: derivatives by rot1, trans, rot2
  by_part << motion.trans_m * s, c, 0, motion.trans_m * c, -s, 0, 1, 0, 1;
  const Eigen::Vector3d sigma(sigmas.rot1_rad, sigmas.trans_m, sigmas.rot2_rad);
  const Eigen::Matrix3d root = by_part * sigma.asDiagonal();
  return root * root.transpose();
}

}  // namespace mapscore
