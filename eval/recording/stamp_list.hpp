// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#pragma once

#include "core/geometry/pose.hpp"

#include <algorithm>
#include <cstddef>
#include <filesystem>
#include <functional>
#include <iterator>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace mapscore::eval {

/// Words of `stamp_s tx ty tz qx qy qz qw`.
inline constexpr std::size_t kPoseColumns = 8;

/// One line of a file whose lines begin with a stamp, cut into words.
struct StampedLine {
  std::string file;
  std::size_t number = 0;  ///< in the file, from 1
  double stamp_s = 0.0;
  std::vector<std::string_view> words;  ///< the stamp first

  /// Throws Error "FILE:NUMBER: what".
  [[noreturn]] void refuse(const std::string& what) const;
  /// The word as a finite number; the line must have it. Throws Error.
  [[nodiscard]] double number_at(std::size_t word) const;
  /// Words 1 to 7, tx ty tz qx qy qz qw; the line must have them. Throws Error.
  [[nodiscard]] Pose pose() const;
};

/// What a file of such lines is to hold.
struct LineFormat {
  std::vector<std::size_t> words;  ///< how many a line may have
  std::string text;                ///< the same for people: "expected TEXT"
  std::string mend_empty;          ///< what to do about a file without lines
};

/// Calls `take` with each line but empty ones and those that start with `#`, in the order of the
/// file. One line is cut at a time; its words live as long as the call. Throws Error with file and
/// line when the file is missing, a line has another number of words, a stamp is none or does not
/// come after the one before, or there is no line.
void read_stamped_lines(const std::filesystem::path& file, const LineFormat& format,
                        const std::function<void(const StampedLine&)>& take);

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

/// One line of odometry.txt. The odom frame is base_footprint at the start of the drive.
struct OdometryPose {
  double stamp_s = 0.0;
  Pose T_odom_base = Pose::Identity();
};

/// All readers throw Error as read_stamped_lines.
[[nodiscard]] std::vector<StampedImage> read_stamp_list(const std::filesystem::path& file);
[[nodiscard]] std::vector<TrajectoryPose> read_trajectory(const std::filesystem::path& file);
[[nodiscard]] std::vector<OdometryPose> read_odometry(const std::filesystem::path& file);

/// Stamps and poses are the shortest texts that read back the same.
[[nodiscard]] std::string stamp_list_text(const std::vector<StampedImage>& images);
[[nodiscard]] std::string trajectory_text(const std::vector<TrajectoryPose>& poses);
[[nodiscard]] std::string odometry_text(const std::vector<OdometryPose>& poses);

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
