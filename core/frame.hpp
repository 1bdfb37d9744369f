// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#pragma once

#include "core/geometry/camera.hpp"
#include "core/geometry/pose.hpp"

#include <opencv2/core.hpp>

namespace mapscore {

/// One colour image and the depth image paired with it. Images are row-major, row 0 at the top; an
/// image that was not asked for is empty. Copies share pixels (cv::Mat): treat them as read-only.
struct Frame {
  int index = 0;                         ///< position of the colour image in the recording
  int depth_index = 0;                   ///< position of the depth image in the recording
  double stamp_s = 0.0;                  ///< of the depth image
  Pose T_world_base = Pose::Identity();  ///< true pose of base_footprint at `stamp_s`
  cv::Mat3b color;                       ///< BGR, as OpenCV keeps it; from the colour camera
  cv::Mat1w label;                       ///< instance id per colour pixel
  cv::Mat1w depth;                       ///< planar z in 1/5000 m, 0 = none; from the depth camera
  cv::Mat1w depth_label;                 ///< instance id per depth pixel; truth only
};

}  // namespace mapscore
