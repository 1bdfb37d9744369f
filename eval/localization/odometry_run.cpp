// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#include "eval/localization/odometry_run.hpp"

#include "core/error.hpp"

#include <cmath>

namespace mapscore::eval {
namespace {

/// Variances of the motion model go with the square of a motion, so its size is fixed: that of the
/// particle filter's updates.
constexpr double kStepWay = 0.05, kStepTurn = 0.05;

bool is_step(const PlanarPose& T_before_after) {
  return std::hypot(T_before_after.x_m, T_before_after.y_m) >= kStepWay ||
         std::abs(T_before_after.yaw_rad) >= kStepTurn;
}

/// Covariance after a motion, x y yaw in the robot's axes.
Eigen::Matrix3d grown(const Eigen::Matrix3d& covariance, const PlanarPose& T_before_after,
                      const OdometryNoise& noise) {
  const OdometryMotion motion = motion_parts(T_before_after, noise.least_way_m);
  const Eigen::Matrix3d carry = adjoint(inverse(T_before_after));
  return carry * covariance * carry.transpose() +
         motion_covariance(motion, motion_sigmas(motion, noise));
}

}  // namespace

BelievedTrajectory odometry_only(const std::vector<OdometryPose>& odometry,
                                 const PlanarPose& T_map_base_start, const OdometryNoise& noise) {
  if (odometry.empty()) throw Error("odometry: has no pose; record the drive again");
  PlanarPose T_odom_last = planar(odometry.front().T_odom_base);
  const Pose T_map_odom = spatial(T_map_base_start * inverse(T_odom_last));
  Eigen::Matrix3d last = Eigen::Matrix3d::Zero();
  BelievedTrajectory believed{{}, odometry};
  for (const OdometryPose& pose : odometry) {
    const PlanarPose T_odom_base = planar(pose.T_odom_base);
    const PlanarPose T_last_base = inverse(T_odom_last) * T_odom_base;
    const Eigen::Matrix3d covariance = grown(last, T_last_base, noise);
    believed.entries.push_back(
        {pose.stamp_s, {T_map_odom, pose.T_odom_base, spatial_covariance(covariance)}});
    if (!is_step(T_last_base)) continue;
    last = covariance;
    T_odom_last = T_odom_base;
  }
  return believed;
}

}  // namespace mapscore::eval
