// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#pragma once

#include "core/geometry/camera.hpp"
#include "core/geometry/pose.hpp"

#include <opencv2/core.hpp>

namespace mapscore {

/// A depth image and where it was taken from, or is believed to have been.
struct PosedDepth {
  CameraModel camera;
  Pose T_map_camera = Pose::Identity();         ///< depth_optical -> map
  double range_min_m = 0.6, range_max_m = 8.0;  ///< planar z that is measured, limits included
  cv::Mat1w depth;  ///< planar z in 1/5000 m, 0 = none; of the camera's size
};

/// Throws Error when the image has another size than the camera, or the range is not one.
void check(const PosedDepth& view);

}  // namespace mapscore
