// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#pragma once

#include "core/geometry/camera.hpp"

#include <opencv2/core.hpp>

#include <vector>

namespace mapscore {

/// Columns of one row of the depth image, limits included; none where first > last.
struct ColumnSpan {
  int first = 0, last = -1;
};

/// By row of the depth image: outside of these columns no pixel covers a colour pixel that is
/// `wanted` (not 0; none: all are), whatever depth within the camera's range it has, as
/// register_depth says it. Wider than need be; all columns where the cameras do not look the same
/// way, or one stands in what the other sees. Thread-safe.
[[nodiscard]] std::vector<ColumnSpan> spans_that_may_cover(const cv::Mat1b& wanted,
                                                           const Calibration& believed);

}  // namespace mapscore
