// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#include "eval/recording/odometry_file.hpp"

#include "eval/recording/pose_text.hpp"
#include "eval/recording/stamp_list.hpp"
#include "files/text_rows.hpp"

#include <fmt/format.h>

namespace mapscore::eval {

std::string odometry_text(const std::vector<OdometryPose>& poses) {
  std::string text = "# T_odom_base_footprint: stamp_s tx ty tz qx qy qz qw\n";
  for (const OdometryPose& pose : poses)
    text += fmt::format("{} {}\n", pose.stamp_s, join_numbers(numbers_of(pose.T_odom_base), " "));
  return text;
}

std::vector<OdometryPose> read_odometry(const std::filesystem::path& file) {
  std::vector<OdometryPose> poses;
  for (const TrajectoryPose& line : read_trajectory(file))
    poses.push_back({line.stamp_s, line.T_world_base});
  return poses;
}

}  // namespace mapscore::eval
