// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#include "eval/recording/stamp_list.hpp"

#include "eval/recording/pose_text.hpp"
#include "files/file_bytes.hpp"
#include "files/refusal.hpp"
#include "files/text.hpp"
#include "files/text_rows.hpp"

namespace mapscore::eval {
namespace {

/// No robot is farther from where it started; beyond, sums of such numbers lose centimetres.
constexpr double kFarthest_m = 1e9;
constexpr const char* kNoFrames = "the file was cut off, or nothing was recorded; record anew";

/// Lines of poses under a comment that names the frame.
std::string poses_text(const char* frame, const auto& poses, auto pose_of) {
  std::string text = fmt::format("# {}: stamp_s tx ty tz qx qy qz qw\n", frame);
  for (const auto& line : poses)
    text += fmt::format("{} {}\n", line.stamp_s, join_numbers(numbers_of(line.*pose_of), " "));
  return text;
}

}  // namespace

void StampedLine::refuse(const std::string& what) const {
  mapscore::refuse(file, number, "{}", shown(what));
}

double StampedLine::number_at(std::size_t word) const {
  const auto value = parse_number(words[word]);
  if (!value) refuse(fmt::format("'{}' is not a finite number; mend the line", words[word]));
  return *value;
}

Pose StampedLine::pose() const {
  PoseNumbers numbers{};
  for (std::size_t i = 0; i < numbers.size(); ++i) numbers[i] = number_at(i + 1);
  const auto pose = pose_of(numbers);
  if (!pose) refuse("quaternion qx qy qz qw is not of length 1; normalise it");
  if (pose->translation().cwiseAbs().maxCoeff() > kFarthest_m)
    refuse("a position of more than 1e9 m; give tx, ty and tz in metres");
  return *pose;
}

void read_stamped_lines(const std::filesystem::path& file, const LineFormat& format,
                        const std::function<void(const StampedLine&)>& take) {
  const std::string text = read_file(file);
  TextLines lines(text);
  std::optional<double> before_s;
  const std::size_t most_words = std::ranges::max(format.words);
  for (StampedLine line{file.string(), 0, 0.0, {}}; lines.next_words(line.words, most_words);) {
    line.number = lines.number();
    if (line.words[0][0] == '#') continue;
    if (std::ranges::find(format.words, line.words.size()) == format.words.end())
      line.refuse(fmt::format("expected {}; mend the line", format.text));
    const auto stamp_s = parse_number(line.words[0]);
    if (!stamp_s)
      line.refuse(
          fmt::format("'{}' is no time stamp; give seconds as a finite number", line.words[0]));
    if (before_s && *stamp_s <= *before_s)
      line.refuse(fmt::format("stamp {} does not come after {}; sort the lines by time", *stamp_s,
                              *before_s));
    line.stamp_s = *stamp_s;
    before_s = stamp_s;
    take(line);
  }
  if (!before_s) refuse(file, "no lines; {}", format.mend_empty);
}

std::vector<StampedImage> read_stamp_list(const std::filesystem::path& file) {
  std::vector<StampedImage> images;
  read_stamped_lines(file, {{2}, "'stamp_s path'", kNoFrames}, [&](const StampedLine& line) {
    images.push_back({line.stamp_s, std::string(line.words[1])});
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

std::vector<OdometryPose> read_odometry(const std::filesystem::path& file) {
  std::vector<OdometryPose> poses;
  for (const TrajectoryPose& line : read_trajectory(file))
    poses.push_back({line.stamp_s, line.T_world_base});
  return poses;
}

std::string stamp_list_text(const std::vector<StampedImage>& images) {
  std::string text = "# stamp_s path\n";
  for (const StampedImage& image : images)
    text += fmt::format("{} {}\n", image.stamp_s, image.path);
  return text;
}

std::string trajectory_text(const std::vector<TrajectoryPose>& poses) {
  return poses_text("T_world_base_footprint", poses, &TrajectoryPose::T_world_base);
}

std::string odometry_text(const std::vector<OdometryPose>& poses) {
  return poses_text("T_odom_base_footprint", poses, &OdometryPose::T_odom_base);
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
