// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#pragma once

#include "core/geometry/camera.hpp"
#include "core/segmentation/segmentation.hpp"

#include <opencv2/core.hpp>

#include <vector>

namespace mapscore {

/// Depth pixels with the detections they belong to.
struct LabelledDepth {
  cv::Mat1w labels;         ///< 1 + index of the detection; 0 for none
  cv::Mat1f inverse_depth;  ///< of the surface at labelled pixels, 1/m; empty: as measured
};

/// Labels a frame's depth pixels; of a noisy depth image settles them on their surfaces too
/// (settled_depth.hpp). Throws Error on a depth image of another size than its camera's and on bad
/// parameters.
[[nodiscard]] LabelledDepth label_surfaces(const std::vector<Detection>& detections,
                                           const cv::Mat1w& depth, const Calibration& believed,
                                           const EdgeAlignedParams& params);

/// The labels alone.
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
