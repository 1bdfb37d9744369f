// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#pragma once

#include "core/geometry/camera.hpp"
#include "core/geometry/depth_rays.hpp"

#include <opencv2/core.hpp>

#include <Eigen/Core>
#include <cstdint>
#include <span>
#include <vector>

namespace mapscore {

/// Organised cloud: for each colour pixel the depth pixel whose surface it sees, and that one's
/// point in depth_optical (metres). Registration decides only which point a colour pixel gets; the
/// point itself keeps the depth camera's own coordinates. Immutable, safe to share between threads.
class RegisteredCloud {
 public:
  static constexpr int kNone = -1;

  /// `source`: index of a depth pixel (row-major) per colour pixel, kNone where there is none.
  RegisteredCloud(cv::Mat1w depth, const CameraModel& depth_camera, cv::Mat1i source);

  /// Index of the depth pixel behind colour pixel (u, v), or kNone.
  [[nodiscard]] int source(int u, int v) const { return source_(v, u); }
  [[nodiscard]] const cv::Mat1i& sources() const { return source_; }
  [[nodiscard]] int width_px() const { return source_.cols; }
  [[nodiscard]] int height_px() const { return source_.rows; }

  /// Point of a depth pixel in depth_optical: z * ((u - cx) / fx, (v - cy) / fy, 1), z = value /
  /// 5000.
  [[nodiscard]] Eigen::Vector3d point(int depth_pixel) const {
    const int v = depth_pixel / depth_.cols, u = depth_pixel % depth_.cols;
    return rays_.point(u, v, depth_(v, u) / kDepthUnitsPerMetre);
  }
  /// Appends the points behind the pixels (u, v), (u + 1, v), ... that are `inside` (not 0).
  void append_points(int u, int v, std::span<const std::uint8_t> inside,
                     std::vector<Eigen::Vector3d>& points) const;

 private:
  void append_points(std::span<const int> depth_pixels, std::vector<Eigen::Vector3d>& points) const;

  cv::Mat1w depth_;
  DepthRays rays_;
  cv::Mat1i source_;
};

/// Registers depth to colour with the believed calibration (docs/methods.md). A depth pixel with
/// a value within the camera's range (limits included) is projected to (u, v) at depth z_color > 0
/// in the colour camera; it covers the columns with |column - u| <= h, h = max(1, (fx_color /
/// fx_depth) (z_depth / z_color)) / 2, and the rows likewise with v and fy. Of the depth pixels
/// that cover a colour pixel the nearest in z_color wins, ties to the lower row, then column.
/// `wanted` (not 0 on the colour pixels that matter) limits the work: the others get kNone. Throws
/// Error when an image has another size than its camera, and for cameras that are none (check).
/// Thread-safe.
[[nodiscard]] RegisteredCloud register_depth(const cv::Mat1w& depth, const Calibration& believed,
                                             const cv::Mat1b& wanted = {});

}  // namespace mapscore
