// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#pragma once

#include "core/localization/occupancy_grid.hpp"
#include "eval/recording/recording_writer.hpp"
#include "eval/truth/floor_grid.hpp"
#include "tests/support/tiny_recording.hpp"

#include <cmath>
#include <filesystem>
#include <limits>
#include <vector>

namespace mapscore::eval::testing {

inline constexpr double kLidarHeight_m = 0.4;
inline constexpr double kOdometryScale = 1.1;  ///< of the way that the wheels believe
inline constexpr int kBeams = 360;

/// Crate and wall, and three walls behind and beside the robot that no camera sees.
inline std::vector<Shape> driven_home() {
  std::vector<Shape> shapes = mapscore::testing::tiny_shapes();
  const auto add_wall = [&](double x_m, double y_m, const Eigen::Vector3d& half_m) {
    Shape wall;
    wall.kind = ShapeKind::box;
    wall.name = "unseen_geom";
    wall.T_world_shape.translation() = Eigen::Vector3d(x_m, y_m, 0.5);
    wall.size = half_m;
    shapes.push_back(wall);
  };
  add_wall(-1.53, 0.0, {0.05, 2.5, 0.5});
  add_wall(0.5, 2.51, {2.0, 0.05, 0.5});
  add_wall(0.5, -2.49, {2.0, 0.05, 0.5});
  return shapes;
}

/// An odometry that makes every way too long.
inline std::vector<OdometryPose> driven_odometry(const std::vector<Frame>& frames) {
  std::vector<OdometryPose> lines;
  for (const Frame& frame : frames) {
    Pose T_odom_base = frames.front().T_world_base.inverse() * frame.T_world_base;
    T_odom_base.translation() *= kOdometryScale;
    lines.push_back({frame.stamp_s, T_odom_base});
  }
  return lines;
}

/// Turns of a lidar against the crate and the walls.
inline ScanLog driven_scans(const std::vector<Frame>& frames, const std::vector<Shape>& shapes) {
  const OccupancyGrid grid =
      floor_grid(shapes, Pose::Identity(), {.height_m = kLidarHeight_m, .resolution_m = 0.01});
  ScanLog log;
  log.geometry = {-M_PI, 2.0 * M_PI / kBeams, 0.1, 12.0, Pose::Identity()};
  log.geometry.T_base_lidar.translation().z() = kLidarHeight_m;
  for (const Frame& frame : frames) {
    StampedScan scan{frame.stamp_s, {}};
    const PlanarPose base = planar(frame.T_world_base);
    for (int beam = 0; beam < kBeams; ++beam) {
      const double angle =
          base.yaw_rad + log.geometry.first_angle_rad + beam * log.geometry.angle_step_rad;
      scan.ranges_m.push_back(
          static_cast<float>(cast_ray(grid, {base.x_m, base.y_m}, angle, 12.0)
                                 .value_or(std::numeric_limits<double>::infinity())));
    }
    log.scans.push_back(scan);
  }
  return log;
}

/// The tiny recording within these walls, with the logs of its drive or without.
inline void write_driven_recording(const std::filesystem::path& folder, bool logs) {
  const std::vector<Frame> frames = mapscore::testing::tiny_frames();
  const std::vector<Shape> shapes = driven_home();
  RecordingWriter writer(folder, mapscore::testing::tiny_info());
  for (const Frame& frame : frames) mapscore::testing::write_frame(writer, frame);
  writer.write_shapes(shapes);
  if (logs) {
    writer.write_odometry(driven_odometry(frames));
    writer.write_scans(driven_scans(frames, shapes));
  }
  writer.finish();
}

}  // namespace mapscore::eval::testing
