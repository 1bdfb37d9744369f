// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#pragma once

#include "core/segmentation/depth_edges.hpp"

#include <opencv2/core.hpp>

namespace mapscore {

/// True where the noise of a depth image is above what its steps are told from: then its pixels are
/// worth settling on their surfaces.
[[nodiscard]] bool is_noisy(const DepthEdges& edges);

/// Inverse depth of labelled pixels, each from its surface: the plane w = a + b du + c dv fitted to
/// those of its label's pixels in the 9 x 9 about it whose w lies within 4 sigma of its own, read
/// at the pixel. If they are fewer than half of its label's pixels there, or fewer than 4, the
/// pixel lies on no surface: its label becomes 0. `labels`: changed; 0 for none. Returns 1/m, 0
/// where there is no label.
[[nodiscard]] cv::Mat1f settle_on_surfaces(const DepthEdges& edges, cv::Mat1w& labels);

}  // namespace mapscore
