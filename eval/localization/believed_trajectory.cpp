// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#include "eval/localization/believed_trajectory.hpp"

#include "core/error.hpp"
#include "eval/recording/stamp_list.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cstddef>
#include <iterator>

namespace mapscore::eval {

PoseBelief BelievedTrajectory::at(double stamp_s) const {
  if (entries.empty()) throw Error("believed trajectory: has no entry; localise the robot first");
  const auto after = std::ranges::upper_bound(entries, stamp_s, {}, &StampedBelief::stamp_s);
  const PoseBelief& latest =
      after == entries.begin() ? entries.front().belief : std::prev(after)->belief;
  return {latest.T_map_odom, odometry_at(odometry, stamp_s), latest.covariance};
}

Pose odometry_at(const std::vector<OdometryPose>& odometry, double stamp_s) {
  if (odometry.empty()) throw Error("odometry: has no pose; record the drive again");
  const std::size_t count = odometry.size();
  const OdometryPose &first = odometry.front(), &last = odometry.back();
  const double spacing_first_s = count > 1 ? odometry[1].stamp_s - first.stamp_s : 0.0;
  const double spacing_last_s = count > 1 ? last.stamp_s - odometry[count - 2].stamp_s : 0.0;
  if (!(stamp_s >= first.stamp_s - spacing_first_s && stamp_s <= last.stamp_s + spacing_last_s))
    throw Error(
        fmt::format("trajectory: reaches from {} to {} s, not to the stamp {} s; give poses for "
                    "the whole drive, with stamps of the same clock",
                    first.stamp_s, last.stamp_s, stamp_s));
  const auto after = first_from(odometry, stamp_s);
  if (after == odometry.end()) return last.T_odom_base;
  if (after == odometry.begin() || after->stamp_s == stamp_s) return after->T_odom_base;
  const OdometryPose& before = *std::prev(after);
  const double share = (stamp_s - before.stamp_s) / (after->stamp_s - before.stamp_s);
  return pose_between(before.T_odom_base, after->T_odom_base, share);
}

PoseEstimate planar_estimate(const PoseBelief& belief) {
  constexpr int kAxes[] = {0, 1, 5};
  PoseEstimate estimate{planar(belief.T_map_odom * belief.T_odom_base), {}};
  for (int row = 0; row < 3; ++row)
    for (int column = 0; column < 3; ++column)
      estimate.covariance(row, column) = belief.covariance(kAxes[row], kAxes[column]);
  return estimate;
}

}  // namespace mapscore::eval
