// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#include "eval/localization/believed_file.hpp"

#include "core/error.hpp"
#include "eval/recording/pose_text.hpp"
#include "eval/recording/stamped_lines.hpp"
#include "files/text_rows.hpp"

#include <fmt/format.h>

#include <cstddef>

namespace mapscore::eval {
namespace {

constexpr std::size_t kBelievedColumns = kPoseColumns + 36;
/// Two hours at 50 poses a second and more; each takes 0.7 kB.
constexpr std::size_t kMostPoses = 500'000;

/// Words 8 to 43, row by row.
Covariance6 covariance_of(const StampedLine& line) {
  Covariance6 covariance;
  std::size_t word = kPoseColumns;
  for (int row = 0; row < 6; ++row)
    for (int column = 0; column < 6; ++column) covariance(row, column) = line.number_at(word++);
  try {
    static_cast<void>(covariance_root(covariance));
  } catch (const Error& error) {
    line.refuse(error.what());
  }
  return covariance;
}

}  // namespace

std::string believed_text(const BelievedTrajectory& believed) {
  std::string text =
      "# T_map_base_footprint: stamp_s tx ty tz qx qy qz qw, then its covariance 6x6 row by row, "
      "x y z roll pitch yaw in the axes of base_footprint\n";
  for (const StampedBelief& entry : believed.entries) {
    const PoseBelief& belief = entry.belief;
    const PoseNumbers pose = numbers_of(belief.T_map_odom * belief.T_odom_base);
    text += fmt::format("{} {}", entry.stamp_s, join_numbers(pose, " "));
    for (int row = 0; row < 6; ++row)
      for (int column = 0; column < 6; ++column)
        text += fmt::format(" {}", belief.covariance(row, column));
    text += '\n';
  }
  return text;
}

BelievedTrajectory read_believed(const std::filesystem::path& file) {
  BelievedTrajectory believed;
  const LineFormat format{
      {kPoseColumns, kBelievedColumns},
      "'stamp_s tx ty tz qx qy qz qw', alone or with the 36 numbers of a covariance",
      "give one pose or more"};
  std::size_t columns = 0;
  read_stamped_lines(file, format, [&](const StampedLine& line) {
    if (believed.entries.size() == kMostPoses)
      line.refuse(
          fmt::format("more than {} poses; leave some out, between two the pose is "
                      "interpolated",
                      kMostPoses));
    if (columns == 0) columns = line.words.size();
    if (line.words.size() != columns)
      line.refuse(
          fmt::format("{} columns after lines of {}; mend the line", line.words.size(), columns));
    const Pose T_map_base = line.pose();
    believed.odometry.push_back({line.stamp_s, T_map_base});
    believed.entries.push_back({line.stamp_s, {Pose::Identity(), T_map_base, Covariance6::Zero()}});
    if (columns == kBelievedColumns)
      believed.entries.back().belief.covariance = covariance_of(line);
  });
  return believed;
}

}  // namespace mapscore::eval
