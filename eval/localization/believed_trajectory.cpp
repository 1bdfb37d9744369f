// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#include "eval/localization/believed_trajectory.hpp"

#include "core/error.hpp"
#include "eval/recording/pose_text.hpp"
#include "eval/recording/stamp_list.hpp"
#include "files/text_rows.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <iterator>

namespace mapscore::eval {
namespace {

constexpr std::size_t kBelievedColumns = kPoseColumns + 36;
/// Two hours at 50 poses a second and more; each takes 0.7 kB.
constexpr std::size_t kMostPoses = 500'000;

/// Words 8 to 43, row by row.
Covariance6 covariance_of(const StampedLine& line) {
  Covariance6 covariance;
  std::size_t word = kPoseColumns;
  for (double& cell : covariance.reshaped<Eigen::RowMajor>()) cell = line.number_at(word++);
  try {
    static_cast<void>(covariance_root(covariance));
  } catch (const Error& error) {
    line.refuse(error.what());
  }
  return covariance;
}

}  // namespace

PoseBelief BelievedTrajectory::at(double stamp_s) const {
  if (entries.empty()) throw Error("believed trajectory: has no entry; localise the robot first");
  const auto after = std::ranges::upper_bound(entries, stamp_s, {}, &StampedBelief::stamp_s);
  const PoseBelief& latest =
      after == entries.begin() ? entries.front().belief : std::prev(after)->belief;
  return {latest.T_map_odom, odometry_at(odometry, stamp_s, file), latest.covariance};
}

Pose odometry_at(const std::vector<OdometryPose>& odometry, double stamp_s,
                 const std::string& file) {
  if (odometry.empty()) throw Error(file + ": has no pose; record the drive again");
  const std::size_t count = odometry.size();
  const OdometryPose &first = odometry.front(), &last = odometry.back();
  const double spacing_first_s = count > 1 ? odometry[1].stamp_s - first.stamp_s : 0.0;
  const double spacing_last_s = count > 1 ? last.stamp_s - odometry[count - 2].stamp_s : 0.0;
  if (!(stamp_s >= first.stamp_s - spacing_first_s && stamp_s <= last.stamp_s + spacing_last_s))
    throw Error(
        fmt::format("{}: reaches from {} to {} s, not to the stamp {} s; give poses for "
                    "the whole drive, with stamps of the same clock",
                    file, first.stamp_s, last.stamp_s, stamp_s));
  const auto after = first_from(odometry, stamp_s);
  if (after == odometry.end()) return last.T_odom_base;
  if (after == odometry.begin() || after->stamp_s == stamp_s) return after->T_odom_base;
  const OdometryPose& before = *std::prev(after);
  const double share = (stamp_s - before.stamp_s) / (after->stamp_s - before.stamp_s);
  return pose_between(before.T_odom_base, after->T_odom_base, share);
}

PoseEstimate planar_estimate(const PoseBelief& belief) {
  constexpr std::array kAxes{0, 1, 5};  // x, y, yaw
  return {planar(belief.T_map_odom * belief.T_odom_base), belief.covariance(kAxes, kAxes)};
}

std::string believed_text(const BelievedTrajectory& believed) {
  std::string text =
      "# T_map_base_footprint: stamp_s tx ty tz qx qy qz qw, then its covariance 6x6 row by row, "
      "x y z roll pitch yaw in the axes of base_footprint\n";
  for (const StampedBelief& entry : believed.entries) {
    const PoseBelief& belief = entry.belief;
    const PoseNumbers pose = numbers_of(belief.T_map_odom * belief.T_odom_base);
    text += fmt::format("{} {}", entry.stamp_s, join_numbers(pose, " "));
    for (const double cell : belief.covariance.reshaped<Eigen::RowMajor>())
      text += fmt::format(" {}", cell);
    text += '\n';
  }
  return text;
}

BelievedTrajectory read_believed(const std::filesystem::path& file) {
  BelievedTrajectory believed;
  believed.file = file.string();
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
