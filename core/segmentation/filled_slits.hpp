// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#pragma once

#include "core/segmentation/depth_edges.hpp"

#include <opencv2/core.hpp>

namespace mapscore {

/// 255 on depth pixels seen through a slit of an object: in their row or column a run of up to
/// `widest_px` pixels that lies a step behind both its ends, where run and ends have the same
/// `owner` (depth image, 0 for none). Masks grown by half that width leave no trace of such a slit.
[[nodiscard]] cv::Mat1b filled_slits(const DepthEdges& edges, const cv::Mat1w& owner,
                                     int widest_px);

}  // namespace mapscore
