// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#pragma once

#include "core/geometry/pose.hpp"

#include <Eigen/Core>

namespace mapscore {

/// Pinhole camera without distortion. Optical frame: x right, y down, z forward. Integer pixel
/// coordinates (u = column, v = row, row 0 at the top) are pixel centres, so that a centred
/// principal point lies at ((width - 1) / 2, (height - 1) / 2). Focal lengths and centre in pixels.
struct CameraModel {
  int width_px = 640;
  int height_px = 480;
  double fx_px = 0, fy_px = 0, cx_px = 0, cy_px = 0;

  bool operator==(const CameraModel&) const = default;

  /// Square pixels and a centred principal point from the horizontal field of view.
  [[nodiscard]] static CameraModel from_hfov(int width_px, int height_px, double hfov_rad);

  /// Point at planar depth z_m (metres) seen by pixel (u, v): z * ((u - cx) / fx, (v - cy) / fy,
  /// 1).
  [[nodiscard]] Eigen::Vector3d back_project(double u, double v, double z_m) const {
    return {z_m * ((u - cx_px) / fx_px), z_m * ((v - cy_px) / fy_px), z_m};
  }
  /// Pixel coordinates of a point in the optical frame, z > 0: (fx * x / z + cx, fy * y / z + cy).
  [[nodiscard]] Eigen::Vector2d project(const Eigen::Vector3d& p) const {
    return {fx_px * p.x() / p.z() + cx_px, fy_px * p.y() / p.z() + cy_px};
  }
};

/// What is known, or believed, of the RGB-D pair and of its place on the robot.
struct Calibration {
  CameraModel color, depth;
  Pose T_color_depth = Pose::Identity();  ///< depth_optical -> color_optical
  Pose T_base_depth = Pose::Identity();   ///< depth_optical -> base_footprint
  double range_min_m = 0.6;               ///< planar z of the depth camera, limits included
  double range_max_m = 8.0;
  bool is_doubtful = false;  ///< it was to be estimated, and the estimate was refused
};

/// Throws Error naming the camera unless both have pixels, positive focal lengths and a finite
/// centre, and the depth camera's poses are finite and at most 10 m long. Thread-safe.
void check(const Calibration& calibration);

/// Depth images hold planar z in units of 1/5000 m (TUM RGB-D); 0 where there is none.
inline constexpr double kDepthUnitsPerMetre = 5000.0;

}  // namespace mapscore
