// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#pragma once

#include "core/geometry/camera.hpp"

#include <opencv2/core.hpp>

namespace mapscore {

/// Depth in metres within the range of the believed depth camera, limits included; 0 elsewhere.
[[nodiscard]] cv::Mat1f depth_in_range(const cv::Mat1w& depth, const Calibration& believed);

/// Three numbers a pixel, as three images: points or unit normals in depth_optical.
struct VectorImage {
  cv::Mat1f x, y, z;
};

/// Points of the pixels; (0, 0, 0) where there is no depth.
[[nodiscard]] VectorImage points_of(const cv::Mat1f& depth_m, const CameraModel& camera);

/// Pixels side by side lie on one surface when their depths differ by at most this share of the
/// nearer one (distance_factor_threshold of ethz-asl/depth_segmentation).
inline constexpr float kOneSurface = 0.05F;

/// Unit normals that face the camera; (0, 0, 0) where there is none. On a plane w = 1/z is linear
/// in the pixel, w = a x + b y + c with the ray (x, y, 1), and its normal is -(a, b, c) over its
/// length. The slopes are the means of w's differences between pixels side by side on one surface
/// within `window_px` x `window_px` about the pixel; c follows from the pixel's own w. A window
/// without such a pair in a row or in a column has no normal. `window_px` is odd. Thread-safe.
[[nodiscard]] VectorImage surface_normals(const cv::Mat1f& depth_m, const CameraModel& camera,
                                          int window_px);

}  // namespace mapscore
