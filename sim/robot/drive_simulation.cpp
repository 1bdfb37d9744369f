// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#include "sim/robot/drive_simulation.hpp"

#include "core/error.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace mapscore::sim {
namespace {

constexpr double kRestS = 0.2;  ///< logged after the last waypoint
constexpr double kLongestStandS = 4 * 3600.0;
constexpr double kMostPoses = 1e7;  ///< more than any recording could hold

void check(const Drive& drive) {
  if (drive.waypoints.empty()) throw Error("trajectory: no waypoints; give at least one");
  for (const Drive::Waypoint& w : drive.waypoints)
    if (!std::isfinite(w.x_m) || !std::isfinite(w.y_m) || !std::isfinite(w.yaw_rad))
      throw Error("trajectory: waypoints must be finite numbers");
  if (!(drive.until_s <= kLongestStandS))
    throw Error(fmt::format("drive: stands until {} s; a drive on wheels lasts {} s at most",
                            drive.until_s, kLongestStandS));
}

DriveSettings settings_of(const Drive& drive, DriveSettings settings) {
  settings.controller.speed_mps = drive.speed_mps;
  settings.controller.turn_rate_radps = drive.turn_rate_radps;
  return settings;
}

[[noreturn]] void refuse(const DriveSession& drive, WayState state) {
  if (state == WayState::blocked)
    refuse_blocked(drive.way(), drive.target(), drive.obstacle().value(),
                   drive.health().bump_contacts == 0 ? "made the robot stop, standing"
                                                     : "was touched, standing");
  if (const auto touched = drive.touched())
    refuse_blocked(drive.way(), drive.target(), *touched, "holds the robot up");
  throw Error(fmt::format(
      "trajectory: {} cannot be reached: the robot is stuck at ({:.2f}, {:.2f} m); "
      "lead it around",
      waypoint_text(drive.way(), drive.target()), drive.place().x_m, drive.place().y_m));
}

}  // namespace

DriveLog simulate_drive(const World& world, const std::filesystem::path& robot, const Drive& drive,
                        const DriveSettings& given,
                        const std::function<void(std::size_t, std::size_t)>& progress) {
  check(drive);
  const DriveSettings settings = settings_of(drive, given);
  const DriveModel model = make_drive_model(world, robot, settings.clearance_m);
  Clearance clearance(model);
  check_way(drive.waypoints, !settings.check_way_first, clearance);
  DriveSession session(model, drive.waypoints.front(), settings);
  session.follow(drive.waypoints);
  std::size_t reached = 0;
  const auto tell = [&] {
    for (; reached < session.log().arrivals.size(); ++reached)
      if (progress) progress(reached + 1, drive.waypoints.size());
  };
  tell();
  WayState state = WayState::driving;
  for (; state == WayState::driving; tell()) state = session.step();
  if (state != WayState::arrived) refuse(session, state);
  session.rest_until(std::max(session.log().end_s, drive.until_s) + kRestS);
  return session.take_log();
}

Pose pose_at(const DriveLog& log, double stamp_s) {
  if (log.samples.empty()) throw Error("drive: an empty log has no poses");
  const auto after = std::lower_bound(
      log.samples.begin(), log.samples.end(), stamp_s,
      [](const DriveSample& sample, double stamp) { return sample.stamp_s < stamp; });
  if (after == log.samples.begin()) return log.samples.front().T_world_base;
  if (after == log.samples.end()) return log.samples.back().T_world_base;
  const DriveSample& before = *std::prev(after);
  const double share = (stamp_s - before.stamp_s) / (after->stamp_s - before.stamp_s);
  const Eigen::Quaterniond from(before.T_world_base.linear()), to(after->T_world_base.linear());
  Pose pose = Pose::Identity();
  pose.linear() = from.slerp(share, to).toRotationMatrix();
  pose.translation() =
      (1.0 - share) * before.T_world_base.translation() + share * after->T_world_base.translation();
  return pose;
}

std::vector<StampedPose> poses_along(const DriveLog& log, double rate_hz, double until_s,
                                     int most) {
  constexpr double kRounding = 1e-9;  // a drive of a whole number of periods keeps its last one
  double count = std::floor(until_s * rate_hz + kRounding) + 1.0;
  if (most > 0) count = std::min(count, static_cast<double>(most));
  if (!(count >= 1.0) || !(count <= kMostPoses))
    throw Error(
        fmt::format("drive: {} poses a second over {:.1f} s are too many to record; lower "
                    "the rate",
                    rate_hz, until_s));
  std::vector<StampedPose> poses(static_cast<std::size_t>(count));
  for (std::size_t i = 0; i < poses.size(); ++i) {
    const double stamp_s = static_cast<double>(i) / rate_hz;
    poses[i] = {stamp_s, pose_at(log, stamp_s)};
  }
  return poses;
}

}  // namespace mapscore::sim
