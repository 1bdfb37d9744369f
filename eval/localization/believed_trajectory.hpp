// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#pragma once

#include "core/localization/planar_pose.hpp"
#include "core/placement/pose_belief.hpp"
#include "eval/recording/stamp_list.hpp"

#include <filesystem>
#include <string>
#include <vector>

namespace mapscore::eval {

/// What localisation said at one instant.
struct StampedBelief {
  double stamp_s = 0.0;
  PoseBelief belief;
};

/// Where a robot believed to be along a drive. The frame `map` is that of the grid or file that it
/// was localised in: for a simulated scene, the scene's world.
struct BelievedTrajectory {
  std::vector<StampedBelief> entries;  ///< by stamp, at least one
  std::vector<OdometryPose> odometry;  ///< by stamp, at least one
  std::string file = "odometry.txt";   ///< where the odometry is from

  /// What the robot knew at a stamp, as ROS tf answers: T_odom_base between two lines of the
  /// odometry, T_map_odom and covariance of the latest entry not after the stamp (of the first one
  /// before that). Throws Error where the odometry does not reach; see odometry_at.
  [[nodiscard]] PoseBelief at(double stamp_s) const;
};

/// T_odom_base at a stamp, between two lines interpolated (position linearly, attitude along the
/// great circle). A stamp beyond either end by no more than the spacing of the lines there gets the
/// pose of that end. Throws Error, beginning with the file, beyond, and when there is no line.
[[nodiscard]] Pose odometry_at(const std::vector<OdometryPose>& odometry, double stamp_s,
                               const std::string& file = "odometry.txt");

/// T_map_base and its covariance, x y yaw.
[[nodiscard]] PoseEstimate planar_estimate(const PoseBelief& belief);

/// Text of localization.txt: for each entry its stamp, T_map_base, and the 36 numbers of the
/// covariance row by row; see docs/formats.md. Numbers are the shortest texts that read back the
/// same.
[[nodiscard]] std::string believed_text(const BelievedTrajectory& believed);

/// Reads localization.txt, or a trajectory in the format of TUM (T_map_base_footprint, 8 columns),
/// whose covariance is then 0. The poses take the place of the odometry, T_map_odom is the
/// identity: between two lines the pose is interpolated, the covariance is that of the line before.
/// Throws Error with file and line for another number of columns, stamps that do not ascend,
/// numbers that are not finite, quaternions that are not unit, and a covariance that is not
/// symmetric positive semi-definite.
[[nodiscard]] BelievedTrajectory read_believed(const std::filesystem::path& file);

}  // namespace mapscore::eval
