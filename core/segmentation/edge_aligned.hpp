// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#pragma once

#include "core/geometry/camera.hpp"
#include "core/segmentation/segmentation.hpp"

#include <opencv2/core.hpp>

#include <vector>

namespace mapscore {

/// 1 + index of the detection that each depth pixel belongs to; 0 for none.
[[nodiscard]] cv::Mat1w label_depth(const std::vector<Detection>& detections,
                                    const cv::Mat1w& depth, const Calibration& believed,
                                    const EdgeAlignedParams& params);

/// Segments of all detections of one frame, in their order; points in row-major order of their
/// depth pixels.
[[nodiscard]] std::vector<Segment> segment_edge_aligned(const std::vector<Detection>& detections,
                                                        const cv::Mat1w& depth,
                                                        const Calibration& believed, double voxel_m,
                                                        const EdgeAlignedParams& params,
                                                        bool with_voxels);

}  // namespace mapscore
