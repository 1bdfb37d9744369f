// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#pragma once

#include "core/geometry/pose.hpp"

#include <filesystem>
#include <string>
#include <vector>

namespace mapscore::eval {

/// One line of color.txt or depth.txt: when, and which file below the recording's folder.
struct StampedImage {
  double stamp_s = 0.0;
  std::string path;
};

/// One line of groundtruth.txt.
struct TrajectoryPose {
  double stamp_s = 0.0;
  Pose T_world_base = Pose::Identity();
};

/// Both readers throw Error with file and line when the file is missing or empty, a line is not of
/// the format, or stamps do not ascend. Lines that start with `#` and empty lines are skipped.
[[nodiscard]] std::vector<StampedImage> read_stamp_list(const std::filesystem::path& file);
[[nodiscard]] std::vector<TrajectoryPose> read_trajectory(const std::filesystem::path& file);

[[nodiscard]] std::string stamp_list_text(const std::vector<StampedImage>& images);
[[nodiscard]] std::string trajectory_text(const std::vector<TrajectoryPose>& poses);

/// Index of the image nearest in time, the earlier one of two equally near; `images` is not empty.
[[nodiscard]] std::size_t nearest_in_time(const std::vector<StampedImage>& images, double stamp_s);

}  // namespace mapscore::eval
