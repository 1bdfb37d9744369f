// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#pragma once

#include "core/geometry/camera.hpp"
#include "core/geometry/pose.hpp"
#include "core/geometry/voxel.hpp"

#include <opencv2/core.hpp>

#include <Eigen/Geometry>

namespace mapscore {

/// What one depth image says of the space in its frustum. Immutable, safe to share between threads.
class DepthView {
 public:
  /// `depth` in units of kDepthUnitsPerMetre, range as Calibration's (metres). Throws Error when
  /// the image has another size than its camera.
  DepthView(const cv::Mat1w& depth, const CameraModel& camera, const Pose& T_map_depth,
            double range_min_m, double range_max_m);

  /// Whether a voxel is in view: its centre has planar z within the range, limits included,
  /// projects into the image, onto a pixel that has a depth, and lies at most one edge behind that
  /// depth.
  [[nodiscard]] bool sees(const VoxelKey& key, double edge_m) const;

  /// Box around all that is in view, in frame map; empty when no pixel has a depth.
  [[nodiscard]] Eigen::AlignedBox3d box(double edge_m) const;

 private:
  cv::Mat1w depth_;
  CameraModel camera_;
  Pose T_map_depth_, T_depth_map_;
  double range_min_m_, range_max_m_;
};

}  // namespace mapscore
