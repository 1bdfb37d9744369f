// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#pragma once

#include "core/segmentation/edge_aligned/depth_edges.hpp"

#include <opencv2/core.hpp>

namespace mapscore {

/// Smooths the inverse depth w = 1/z of labelled pixels: a plane w = a + b du + c dv is fitted
/// around each pixel and gives its new w, twice, the second time through what the first gave. The
/// fit takes pixels of the same label in the 9 x 9 window whose w differs from the pixel's by at
/// most a band: 4 sigma, in the second fit 2 cm of depth if that lies between 1.5 and 4 sigma, else
/// the nearer of these. If the pixels are fewer than 4, or fewer than half of the label's in the
/// window, the surface may slope: then those count whose w lies within the band about a plane
/// through the pixel that rises from pixel to pixel by the medians over pairs of neighbours of the
/// label. If these are too few as well, the pixel lies on no surface and its label becomes 0. So
/// does that of a pixel whose depth is still uncertain: the standard error of its w in the second
/// fit, with sigma the noise of each pixel's w, is more than 9 mm of depth. `labels`: 0 for none;
/// changed. Returns 1/m, 0 where there is no label.
[[nodiscard]] cv::Mat1f settle_on_surfaces(const DepthEdges& edges, cv::Mat1w& labels);

}  // namespace mapscore
