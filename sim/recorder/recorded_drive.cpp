// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#include "sim/recorder/recorded_drive.hpp"

#include "core/error.hpp"
#include "sim/recorder/recorder.hpp"

#include <algorithm>
#include <cmath>

namespace mapscore::sim {
namespace {

constexpr double kMostFrames = 1e7;  ///< more than any recording could hold

void check(const Drive& drive) {
  if (drive.waypoints.empty()) throw Error("trajectory: no waypoints; give at least one");
  const auto positive = [](double value, const char* name) {
    if (!(value > 0) || !std::isfinite(value))
      throw Error(std::string("trajectory: ") + name + " must be above 0");
  };
  positive(drive.speed_mps, "speed_mps");
  positive(drive.turn_rate_radps, "turn_rate");
  positive(drive.frames_per_s, "frames_per_s");
  if (drive.max_frames < 0) throw Error("trajectory: max_frames must be 0 (no limit) or more");
  for (const Drive::Waypoint& w : drive.waypoints) {
    if (!std::isfinite(w.x_m) || !std::isfinite(w.y_m) || !std::isfinite(w.yaw_rad))
      throw Error("trajectory: waypoints must be finite numbers");
  }
}

/// The straight way between two waypoints, the heading turning the short way.
struct Leg {
  Drive::Waypoint from, to;
  double start_s, duration_s;

  Pose pose_at(double time_s) const {
    const double share =
        duration_s > 0 ? std::clamp((time_s - start_s) / duration_s, 0.0, 1.0) : 1.0;
    const double turn = wrapped_angle(to.yaw_rad - from.yaw_rad);
    return planar_pose(from.x_m + share * (to.x_m - from.x_m),
                       from.y_m + share * (to.y_m - from.y_m), from.yaw_rad + share * turn);
  }
};

std::vector<Leg> legs_of(const Drive& drive) {
  const auto& points = drive.waypoints;
  std::vector<Leg> legs;
  double time_s = 0.0;
  for (std::size_t i = 0; i + 1 < points.size(); ++i) {
    const auto &from = points[i], &to = points[i + 1];
    const double distance = std::hypot(to.x_m - from.x_m, to.y_m - from.y_m);
    const double turn = std::abs(wrapped_angle(to.yaw_rad - from.yaw_rad));
    const double duration = std::max(distance / drive.speed_mps, turn / drive.turn_rate_radps);
    legs.push_back({from, to, time_s, duration});
    time_s += duration;
  }
  if (legs.empty()) legs.push_back({points.front(), points.front(), 0.0, 0.0});
  return legs;
}

}  // namespace

std::vector<StampedPose> poses_along(const Drive& drive) {
  check(drive);
  const std::vector<Leg> legs = legs_of(drive);
  const double end_s = std::max(legs.back().start_s + legs.back().duration_s, drive.until_s);
  constexpr double kRounding = 1e-9;  // a drive of a whole number of frames keeps its last one
  double frames = std::floor(end_s * drive.frames_per_s + kRounding) + 1.0;
  if (drive.max_frames > 0) frames = std::min(frames, static_cast<double>(drive.max_frames));
  if (!(frames <= kMostFrames))
    throw Error(
        "trajectory: the drive takes too many frames to record; raise speed_mps or turn_rate_dps, "
        "lower frames_per_s, or set max_frames");
  const auto count = static_cast<std::size_t>(frames);
  std::vector<StampedPose> poses(count);
  std::size_t leg = 0;
  for (std::size_t i = 0; i < count; ++i) {
    const double time_s = static_cast<double>(i) / drive.frames_per_s;
    while (leg + 1 < legs.size() && time_s >= legs[leg + 1].start_s) ++leg;
    poses[i] = {time_s, legs[leg].pose_at(time_s)};
  }
  return poses;
}

}  // namespace mapscore::sim
