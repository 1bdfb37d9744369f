// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#pragma once

#include "core/geometry/pose.hpp"

#include <algorithm>
#include <cstddef>
#include <filesystem>
#include <iterator>
#include <optional>
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

/// First element of an ascending list whose stamp is not before `stamp_s`.
template <class Stamped>
[[nodiscard]] auto first_from(const std::vector<Stamped>& list, double stamp_s) {
  return std::ranges::lower_bound(list, stamp_s, {}, &Stamped::stamp_s);
}

/// Index of the element nearest in time, the earlier one of two equally near; `list` ascends and is
/// not empty.
template <class Stamped>
[[nodiscard]] std::size_t nearest_in_time(const std::vector<Stamped>& list, double stamp_s) {
  const auto after = first_from(list, stamp_s);
  if (after == list.begin()) return 0;
  const auto before = std::prev(after);
  const bool later = after != list.end() && after->stamp_s - stamp_s < stamp_s - before->stamp_s;
  return static_cast<std::size_t>((later ? after : before) - list.begin());
}

/// Pose at a stamp: that of the line there, bit for bit, else between the lines around it, position
/// linearly and attitude along the great circle. Nothing before the first and after the last line.
[[nodiscard]] std::optional<Pose> interpolated(const std::vector<TrajectoryPose>& trajectory,
                                               double stamp_s);

/// Position linearly and attitude along the great circle; share 0 is `from`, 1 is `to`.
[[nodiscard]] Pose pose_between(const Pose& from, const Pose& to, double share);

}  // namespace mapscore::eval
