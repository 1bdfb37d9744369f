// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#pragma once

#include "core/geometry/camera.hpp"
#include "core/segmentation/segmentation.hpp"

#include <opencv2/core.hpp>

#include <vector>

namespace mapscore {

/// Segments of all detections of one frame, in their order, with any method: those that take one
/// detection and a registered cloud get them here. Arguments as of `segment` and `register_depth`,
/// whose errors it throws, with any method. Thread-safe.
[[nodiscard]] std::vector<Segment> segment_frame(const std::vector<Detection>& detections,
                                                 const cv::Mat1w& depth,
                                                 const Calibration& believed, double voxel_m,
                                                 const SegmentationParams& params,
                                                 bool with_voxels);

}  // namespace mapscore
