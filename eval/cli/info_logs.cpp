// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#include "eval/cli/info_logs.hpp"

#include <fmt/format.h>

#include <cmath>
#include <numbers>

namespace mapscore::eval {
namespace {

/// How far the odometry has come off the truth since the true pose at its start, and on how long a
/// way; nothing where the trajectory does not reach its ends.
std::string drift_text(const Recording& recording, const std::vector<OdometryPose>& odometry) {
  const auto start = recording.T_world_base_at(odometry.front().stamp_s);
  const auto end = recording.T_world_base_at(odometry.back().stamp_s);
  if (!start || !end) return "";
  double way_m = 0.0;
  for (std::size_t i = 1; i < odometry.size(); ++i)
    way_m +=
        (odometry[i].T_odom_base.translation() - odometry[i - 1].T_odom_base.translation()).norm();
  const Pose T_world_odom = *start * odometry.front().T_odom_base.inverse();
  const Pose error = end->inverse() * T_world_odom * odometry.back().T_odom_base;
  const double yaw_deg =
      std::atan2(error.linear()(1, 0), error.linear()(0, 0)) * 180.0 / std::numbers::pi;
  return fmt::format(", {:.1f} m long, at its end {:.3f} m and {:.1f} deg off the truth", way_m,
                     error.translation().head<2>().norm(), std::abs(yaw_deg));
}

std::string odometry_line(const Recording& recording) {
  const std::vector<OdometryPose> odometry = recording.read_odometry();
  return fmt::format("odometry: {} poses, {:.1f} s{}\n", odometry.size(),
                     odometry.back().stamp_s - odometry.front().stamp_s,
                     drift_text(recording, odometry));
}

std::string scan_line(const Recording& recording) {
  const ScanLog log = recording.read_scans();
  return fmt::format("lidar: {} scans of {} beams, {:g} to {:g} m\n", log.scans.size(),
                     log.scans.front().ranges_m.size(), log.geometry.range_min_m,
                     log.geometry.range_max_m);
}

}  // namespace

std::string log_lines(const Recording& recording) {
  std::string text;
  if (recording.has_odometry()) text += odometry_line(recording);
  if (recording.has_scans()) text += scan_line(recording);
  return text;
}

}  // namespace mapscore::eval
