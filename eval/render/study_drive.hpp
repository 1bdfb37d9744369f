// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#pragma once

#include "eval/recording/scan_file.hpp"
#include "eval/recording/stamp_list.hpp"
#include "eval/study/study.hpp"
#include "sim/recorder/recorded_drive.hpp"
#include "sim/recorder/recorder.hpp"
#include "sim/robot/drive_session.hpp"
#include "sim/sensors/lidar.hpp"
#include "sim/world/world.hpp"

#include <functional>
#include <vector>

namespace mapscore::eval {

/// Where the robot of a study is when its sensors look, and what its wheels say. Poses are those of
/// base_footprint in the world.
struct StudyDrive {
  sim::Streams streams;
  std::vector<OdometryPose> odometry;   ///< empty along poses
  std::vector<TrajectoryPose> truth;    ///< at the stamps of odometry and scans
  std::vector<sim::StampedPose> scans;  ///< empty along poses
};

/// Drives a study's robot along its waypoints, by poses or on wheels, at least until the motion of
/// the world ends. Nothing is logged after the last image where `max_frames` cuts the drive.
/// `progress(reached, waypoints)` is called along a drive on wheels. Throws Error as
/// sim::poses_along and sim::simulate_drive.
[[nodiscard]] StudyDrive drive_of(const Study& study, const sim::World& world,
                                  const std::function<void(int, int)>& progress = {});

/// How the wheels of a study's robot drive; those of a study that says nothing of them are as
/// WheelDrive has them.
[[nodiscard]] sim::DriveSettings drive_settings(const Study& study);
[[nodiscard]] sim::LidarSettings lidar_settings(const Study& study);

/// The odometry of a log up to its first line that is not before `end_s`.
[[nodiscard]] std::vector<OdometryPose> odometry_of(const sim::DriveLog& log, double end_s);
/// True poses at the stamps of odometry and scans.
[[nodiscard]] std::vector<TrajectoryPose> truth_of(const sim::DriveLog& log,
                                                   const std::vector<OdometryPose>& odometry,
                                                   const std::vector<sim::StampedPose>& scans);

/// What the turns of the study's lidar share.
[[nodiscard]] ScanGeometry scan_geometry(const sim::LidarSettings& settings,
                                         const sim::Lidar& lidar);

/// The exact turns of the study's lidar; the same bytes for any number of jobs. Throws Error as
/// sim::Lidar.
[[nodiscard]] ScanLog scans_of(const Study& study, const sim::World& world,
                               const std::vector<sim::StampedPose>& poses, int jobs);

}  // namespace mapscore::eval
