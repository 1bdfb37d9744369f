// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#pragma once

#include "core/geometry/camera.hpp"
#include "core/segmentation/rivals/surface_normals.hpp"

#include <opencv2/core.hpp>

namespace mapscore {

/// Numbers of the geometric segmentation of a depth image; their meanings stand in DepthSegments.
struct GeometricParams {
  double discontinuity = 0.01;
  double convexity = 0.97;
  int normal_window_px = 5;
  int min_segment_px = 500;
};

/// Segments of a depth image.
struct GeometricSegments {
  cv::Mat1i labels;  ///< 1 to count; 0 where a pixel belongs to none
  int count = 0;
};

/// Pixels where a depth image steps, or where two surfaces meet in a concave edge, or without
/// depth: 255; 0 elsewhere. The first half of geometric_segments.
[[nodiscard]] cv::Mat1b geometric_edges(const VectorImage& points, const CameraModel& camera,
                                        const GeometricParams& params);

/// The geometric segmentation of Furrer et al. (IROS 2018), as ethz-asl/depth_segmentation does it
/// and docs/methods.md says it: pieces between geometric_edges, the small ones dropped, and what
/// remains filled from the nearest point of a piece. `depth_m`: 0 where there is none.
/// Thread-safe.
[[nodiscard]] GeometricSegments geometric_segments(const cv::Mat1f& depth_m,
                                                   const CameraModel& camera,
                                                   const GeometricParams& params);

}  // namespace mapscore
