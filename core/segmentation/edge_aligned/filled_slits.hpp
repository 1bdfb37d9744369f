// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#pragma once

#include "core/segmentation/edge_aligned/depth_edges.hpp"

#include <opencv2/core.hpp>

namespace mapscore {

/// Finds background that a mask covers because it is too large and closes narrow gaps of its
/// object, such as those in a chair's back. 255 on the depth pixels of each run of up to
/// `widest_px` pixels in a row or column that lies a step behind the pixels at both its ends, where
/// run and ends have the same `owner` (depth image, 0 for none).
[[nodiscard]] cv::Mat1b filled_slits(const DepthEdges& edges, const cv::Mat1w& owner,
                                     int widest_px);

}  // namespace mapscore
