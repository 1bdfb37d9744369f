// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#ifdef MAPSCORE_SIMULATOR

#include "eval/render/study_drive.hpp"

#include "sim/robot/drive_simulation.hpp"
#include "sim/sensors/lidar.hpp"
#include "sim/world/motion.hpp"

#include <algorithm>
#include <map>
#include <numbers>
#include <variant>

namespace mapscore::eval {
namespace {

constexpr double kRadiansPerDegree = std::numbers::pi / 180.0;

/// With a motion the robot stands at its last waypoint until that ends.
sim::Drive way_of(const TrajectorySettings& settings, const sim::Motion* motion) {
  sim::Drive drive;
  for (const auto& [x, y, yaw_deg] : settings.waypoints_m_deg)
    drive.waypoints.push_back({x, y, yaw_deg * kRadiansPerDegree});
  drive.speed_mps = settings.speed_mps;
  drive.turn_rate_radps = settings.turn_rate_dps * kRadiansPerDegree;
  drive.frames_per_s = settings.frames_per_s;
  drive.max_frames = settings.max_frames;
  if (motion) drive.until_s = motion->stamps_s.back();
  return drive;
}

/// The depth camera's images end with the colour camera's.
void end_with_color(sim::Streams& streams) {
  std::erase_if(streams.depth, [end_s = streams.color.back().stamp_s](const auto& pose) {
    return pose.stamp_s > end_s;
  });
}

StudyDrive drive_by_poses(const Study& study, sim::Drive way) {
  StudyDrive drive;
  drive.streams = {sim::poses_along(way), {}};
  if (depth_rate(study) == way.frames_per_s) {
    drive.streams.depth = drive.streams.color;
    return drive;
  }
  way.frames_per_s = depth_rate(study);
  way.max_frames = 0;
  drive.streams.depth = sim::poses_along(way);
  end_with_color(drive.streams);
  return drive;
}

StudyDrive drive_on_wheels(const Study& study, const sim::DriveLog& log, double until_s) {
  StudyDrive drive;
  const int most = study.trajectory.max_frames;
  double end_s = std::max(log.end_s, until_s);
  drive.streams.color = sim::poses_along(log, study.trajectory.frames_per_s, end_s, most);
  drive.streams.depth = sim::poses_along(log, depth_rate(study), end_s);
  end_with_color(drive.streams);
  if (drive.streams.color.size() == static_cast<std::size_t>(most))
    end_s = drive.streams.color.back().stamp_s;
  drive.scans = sim::poses_along(log, study.lidar.scans_per_s, end_s);
  drive.odometry = odometry_of(log, end_s);
  drive.truth = truth_of(log, drive.odometry, drive.scans);
  return drive;
}

}  // namespace

sim::DriveSettings drive_settings(const Study& study) {
  const auto* given = std::get_if<WheelDrive>(&study.trajectory.drive);
  const WheelDrive wheels = given ? *given : WheelDrive{};
  sim::DriveSettings settings;
  settings.controller.speed_mps = study.trajectory.speed_mps;
  settings.controller.turn_rate_radps = study.trajectory.turn_rate_dps * kRadiansPerDegree;
  settings.controller.acceleration_mps2 = wheels.acceleration_mps2;
  settings.controller.turn_acceleration_radps2 = wheels.turn_acceleration_dps2 * kRadiansPerDegree;
  settings.encoder_ticks_per_turn = wheels.encoder_ticks_per_turn;
  settings.radius_error = wheels.wheel_radius_error_percent / 100.0;
  settings.track_error = wheels.track_error_percent / 100.0;
  settings.clearance_m = wheels.clearance_m;
  return settings;
}

sim::LidarSettings lidar_settings(const Study& study) {
  sim::LidarSettings settings;
  settings.beams = study.lidar.beams;
  settings.range_min_m = study.lidar.range_min_m;
  settings.range_max_m = study.lidar.range_max_m;
  return settings;
}

std::vector<OdometryPose> odometry_of(const sim::DriveLog& log, double end_s) {
  std::vector<OdometryPose> odometry;
  for (const sim::DriveSample& sample : log.samples) {
    odometry.push_back({sample.stamp_s, sample.T_odom_base});
    if (sample.stamp_s >= end_s) break;
  }
  return odometry;
}

std::vector<TrajectoryPose> truth_of(const sim::DriveLog& log,
                                     const std::vector<OdometryPose>& odometry,
                                     const std::vector<sim::StampedPose>& scans) {
  std::map<double, Pose> poses;
  for (const OdometryPose& pose : odometry)
    poses.emplace(pose.stamp_s, sim::pose_at(log, pose.stamp_s));
  for (const sim::StampedPose& pose : scans) poses.emplace(pose.stamp_s, pose.T_world_base);
  std::vector<TrajectoryPose> truth;
  for (const auto& [stamp_s, pose] : poses) truth.push_back({stamp_s, pose});
  return truth;
}

ScanGeometry scan_geometry(const sim::LidarSettings& settings, const sim::Lidar& lidar) {
  return {settings.first_angle_rad, lidar.angle_step_rad(), settings.range_min_m,
          settings.range_max_m, lidar.T_base_lidar()};
}

StudyDrive drive_of(const Study& study, const sim::World& world,
                    const std::function<void(int, int)>& progress) {
  const sim::Drive way = way_of(study.trajectory, world.motion());
  if (!std::holds_alternative<WheelDrive>(study.trajectory.drive))
    return drive_by_poses(study, way);
  const sim::DriveLog log =
      sim::simulate_drive(world, robot_path(study), way, drive_settings(study), progress);
  return drive_on_wheels(study, log, way.until_s);
}

ScanLog scans_of(const Study& study, const sim::World& world,
                 const std::vector<sim::StampedPose>& poses, int jobs) {
  const sim::LidarSettings settings = lidar_settings(study);
  const sim::Lidar lidar(world, settings);
  ScanLog log{scan_geometry(settings, lidar), {}};
  std::vector<sim::LidarRanges> turns = lidar.scans(poses, jobs);
  for (std::size_t i = 0; i < poses.size(); ++i)
    log.scans.push_back({poses[i].stamp_s, std::move(turns[i])});
  return log;
}

}  // namespace mapscore::eval

#endif
