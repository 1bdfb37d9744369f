// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#include "eval/recording/stamp_list.hpp"

#include "eval/recording/pose_text.hpp"
#include "eval/recording/stamped_lines.hpp"
#include "files/text_rows.hpp"

#include <fmt/format.h>

namespace mapscore::eval {
namespace {

constexpr const char* kNoFrames = "the file was cut off, or nothing was recorded; record anew";

}  // namespace

std::vector<StampedImage> read_stamp_list(const std::filesystem::path& file) {
  std::vector<StampedImage> images;
  read_stamped_lines(file, {{2}, "'stamp_s path'", kNoFrames}, [&](const StampedLine& line) {
    images.push_back({line.stamp_s, line.words[1]});
  });
  return images;
}

std::vector<TrajectoryPose> read_trajectory(const std::filesystem::path& file) {
  std::vector<TrajectoryPose> poses;
  const LineFormat format{{kPoseColumns}, "'stamp_s tx ty tz qx qy qz qw'", kNoFrames};
  read_stamped_lines(file, format, [&](const StampedLine& line) {
    poses.push_back({line.stamp_s, line.pose()});
  });
  return poses;
}

std::string stamp_list_text(const std::vector<StampedImage>& images) {
  std::string text = "# stamp_s path\n";
  for (const StampedImage& image : images)
    text += fmt::format("{} {}\n", image.stamp_s, image.path);
  return text;
}

std::string trajectory_text(const std::vector<TrajectoryPose>& poses) {
  std::string text = "# T_world_base_footprint: stamp_s tx ty tz qx qy qz qw\n";
  for (const TrajectoryPose& pose : poses)
    text += fmt::format("{} {}\n", pose.stamp_s, join_numbers(numbers_of(pose.T_world_base), " "));
  return text;
}

std::optional<Pose> interpolated(const std::vector<TrajectoryPose>& trajectory, double stamp_s) {
  const auto after = first_from(trajectory, stamp_s);
  if (after == trajectory.end()) return std::nullopt;
  if (after->stamp_s == stamp_s) return after->T_world_base;
  if (after == trajectory.begin()) return std::nullopt;
  const TrajectoryPose &from = *std::prev(after), &to = *after;
  const double share = (stamp_s - from.stamp_s) / (to.stamp_s - from.stamp_s);
  return pose_between(from.T_world_base, to.T_world_base, share);
}

Pose pose_between(const Pose& from, const Pose& to, double share) {
  const Eigen::Quaterniond q_from(from.linear()), q_to(to.linear());
  Pose pose = Pose::Identity();
  pose.linear() = q_from.slerp(share, q_to).toRotationMatrix();
  pose.translation() = (1.0 - share) * from.translation() + share * to.translation();
  return pose;
}

}  // namespace mapscore::eval
