// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#pragma once

#include <opencv2/core.hpp>

namespace mapscore {

/// Recursive averages of votes, which do not cross depth edges: along rows, columns, columns, rows,
/// rows and columns, over `reach_px` twice, 1/2 and 1/4 of it. `right` and `down` are the
/// continuity to the next pixel of the row and of the column, 0 to 1 (DepthEdges). Not divided by
/// the number of pixels. Thread-safe.
void average_on_surfaces(cv::Mat1f& votes, const cv::Mat1f& right, const cv::Mat1f& down,
                         float reach_px);

}  // namespace mapscore
