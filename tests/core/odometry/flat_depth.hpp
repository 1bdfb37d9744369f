// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#pragma once

#include "core/geometry/camera.hpp"
#include "core/localization/planar_pose.hpp"
#include "core/random_stream.hpp"
#include "tests/core/exploration/box_flat.hpp"

#include <opencv2/core.hpp>

#include <cmath>
#include <cstdint>
#include <numbers>

namespace mapscore::testing {

/// A room of 6 m x 5 m with a chest, a cupboard, a box and a table in its corners.
inline BoxFlat furnished_room() {
  BoxFlat flat(6.0, 5.0);
  flat.add(4.5, 0.3, 0, 5.5, 1.3, 0.9);
  flat.add(4.8, 3.2, 0, 5.8, 4.7, 2.0);
  flat.add(0.3, 3.9, 0, 1.3, 4.7, 0.6);
  flat.add_table(0.4, 0.3, 1.4, 1.0, 0.75);
  return flat;
}

/// A wheeled robot's depth camera, 160 x 120 pixels, at 1.15 m and 12 degrees down.
inline Calibration odometry_camera() {
  Calibration calibration;
  calibration.depth = CameraModel::from_hfov(160, 120, 58.4 * std::numbers::pi / 180.0);
  calibration.color = calibration.depth;
  const double tilt = 12.0 * std::numbers::pi / 180.0;
  Eigen::Matrix3d R_link_optical;
  R_link_optical << 0, 0, 1, -1, 0, 0, 0, -1, 0;
  calibration.T_base_depth.linear() =
      Eigen::AngleAxisd(tilt, Eigen::Vector3d::UnitY()).toRotationMatrix() * R_link_optical;
  calibration.T_base_depth.translation() = Eigen::Vector3d(0.05, 0.025, 1.15);
  return calibration;
}

/// What that camera sees of a flat of boxes, whose floor is z = 0 of the base; `noise`: of depth,
/// in parts of 1 % of z, drawn by `seed`.
inline cv::Mat1w flat_depth(const BoxFlat& flat, const Pose& T_map_base,
                            const Calibration& calibration, double noise = 0.0,
                            std::uint64_t seed = 1) {
  const Pose T_map_depth =
      Eigen::Translation3d(0, 0, kFlatOrigin.z()) * T_map_base * calibration.T_base_depth;
  RandomStream draws(seed, "flat depth");
  cv::Mat1w depth(calibration.depth.height_px, calibration.depth.width_px, std::uint16_t{0});
  for (int v = 0; v < depth.rows; ++v)
    for (int u = 0; u < depth.cols; ++u) {
      const Eigen::Vector3d ray =
          T_map_depth.linear() * calibration.depth.back_project(u, v, 1.0);  // planar depth 1 m
      double z_m = flat.cast(T_map_depth.translation(), ray);
      if (noise > 0.0) z_m *= 1.0 + 0.01 * noise * draws.normal();
      if (z_m >= calibration.range_min_m && z_m <= calibration.range_max_m)
        depth(v, u) = static_cast<std::uint16_t>(std::lround(z_m * kDepthUnitsPerMetre));
    }
  return depth;
}

}  // namespace mapscore::testing
