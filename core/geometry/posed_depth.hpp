// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#pragma once

#include "core/geometry/camera.hpp"
#include "core/geometry/pose.hpp"
#include "core/geometry/voxel.hpp"

#include <opencv2/core.hpp>

#include <Eigen/Geometry>

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

/// What one depth image says of the space in its frustum. Immutable, safe to share between threads.
class DepthView {
 public:
  /// Throws Error as check(PosedDepth).
  explicit DepthView(PosedDepth seen);

  /// Whether a voxel is in view: its centre has planar z within the range, limits included,
  /// projects into the image, onto a pixel that has a depth, and lies at most one edge behind that
  /// depth.
  [[nodiscard]] bool sees(const VoxelKey& key, double edge_m) const;

  /// Box around all that is in view, in frame map; empty when no pixel has a depth.
  [[nodiscard]] Eigen::AlignedBox3d box(double edge_m) const;

 private:
  PosedDepth seen_;
  Pose T_camera_map_;
};

}  // namespace mapscore
