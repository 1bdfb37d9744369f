// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#pragma once

#include "core/geometry/pose.hpp"

#include <filesystem>
#include <string>
#include <vector>

namespace mapscore::eval {

/// One line of odometry.txt. The odom frame is base_footprint at the start of the drive.
struct OdometryPose {
  double stamp_s = 0.0;
  Pose T_odom_base = Pose::Identity();
};

/// Text of odometry.txt: TUM lines, stamps and poses as the shortest texts that read back the same.
[[nodiscard]] std::string odometry_text(const std::vector<OdometryPose>& poses);

/// Throws Error as read_trajectory.
[[nodiscard]] std::vector<OdometryPose> read_odometry(const std::filesystem::path& file);

}  // namespace mapscore::eval
