// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#pragma once

#include <opencv2/core.hpp>

#include <span>

namespace mapscore {

inline constexpr int kBand_px = 32;  ///< height of the parts of an image that are averaged

/// Recursive averages of votes in some parts of an image, which do not cross depth edges: along
/// rows, columns, columns, rows, rows and columns, over `reach_px` twice, 1/2 and 1/4 of it. Not
/// divided by the number of pixels. `parts`: each within one band of kBand_px rows, in order of
/// bands; those of a band lie apart, and one that shares columns with a part of the next band
/// reaches it. Nothing comes from other pixels.
/// `right` and `down` are the continuity to the next pixel of the row and of the column, 0 to 1
/// (DepthEdges). Thread-safe.
void average_on_surfaces(cv::Mat1f& votes, std::span<const cv::Rect> parts, const cv::Mat1f& right,
                         const cv::Mat1f& down, float reach_px);

}  // namespace mapscore
