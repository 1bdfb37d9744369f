// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#include "eval/recording/stamp_list.hpp"

#include "core/error.hpp"
#include "eval/recording/file_bytes.hpp"
#include "eval/recording/pose_text.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <sstream>

namespace mapscore::eval {
namespace {

/// One line cut into words.
struct Line {
  int number;  ///< in the file, from 1
  std::vector<std::string> words;
};

[[noreturn]] void refuse(const std::filesystem::path& file, int line, const std::string& what) {
  throw Error(fmt::format("{}:{}: {}", file.string(), line, what));
}

std::vector<Line> lines_of(const std::filesystem::path& file) {
  std::istringstream text(read_file(file));
  std::vector<Line> lines;
  std::string line;
  for (int number = 1; std::getline(text, line); ++number) {
    std::istringstream words(line);
    Line cut{number, {}};
    for (std::string word; words >> word;) cut.words.push_back(word);
    if (!cut.words.empty() && cut.words[0][0] != '#') lines.push_back(std::move(cut));
  }
  if (lines.empty())
    throw Error(
        fmt::format("{}: no lines; the recording has no frames, record it again", file.string()));
  return lines;
}

double stamp_of(const std::filesystem::path& file, const Line& line, const double* before_s) {
  const auto stamp_s = parse_number(line.words[0]);
  if (!stamp_s)
    refuse(file, line.number,
           fmt::format("'{}' is no time stamp; give seconds as a finite number", line.words[0]));
  if (before_s != nullptr && *stamp_s <= *before_s)
    refuse(file, line.number,
           fmt::format("stamp {} does not come after {}; sort the lines by time", *stamp_s,
                       *before_s));
  return *stamp_s;
}

}  // namespace

std::vector<StampedImage> read_stamp_list(const std::filesystem::path& file) {
  std::vector<StampedImage> images;
  for (const Line& line : lines_of(file)) {
    if (line.words.size() != 2) refuse(file, line.number, "expected 'stamp_s path'; mend the line");
    const double stamp_s = stamp_of(file, line, images.empty() ? nullptr : &images.back().stamp_s);
    images.push_back({stamp_s, line.words[1]});
  }
  return images;
}

std::vector<TrajectoryPose> read_trajectory(const std::filesystem::path& file) {
  std::vector<TrajectoryPose> poses;
  for (const Line& line : lines_of(file)) {
    if (line.words.size() != 8)
      refuse(file, line.number, "expected 'stamp_s tx ty tz qx qy qz qw'; mend the line");
    const double stamp_s = stamp_of(file, line, poses.empty() ? nullptr : &poses.back().stamp_s);
    PoseNumbers numbers{};
    for (std::size_t i = 0; i < numbers.size(); ++i) {
      const auto number = parse_number(line.words[i + 1]);
      if (!number)
        refuse(file, line.number,
               fmt::format("'{}' is not a finite number; mend the pose", line.words[i + 1]));
      numbers[i] = *number;
    }
    const auto pose = pose_of(numbers);
    if (!pose) refuse(file, line.number, "quaternion qx qy qz qw is not of length 1; normalise it");
    poses.push_back({stamp_s, *pose});
  }
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
  const Pose &a = from.T_world_base, &b = to.T_world_base;
  const Eigen::Quaterniond q_a(a.linear()), q_b(b.linear());
  Pose pose = Pose::Identity();
  pose.linear() = q_a.slerp(share, q_b).toRotationMatrix();
  pose.translation() = (1.0 - share) * a.translation() + share * b.translation();
  return pose;
}

}  // namespace mapscore::eval
