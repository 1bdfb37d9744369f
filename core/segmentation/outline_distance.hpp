// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#pragma once

#include <opencv2/core.hpp>

namespace mapscore {

/// Pixels to the nearest outline of an owner, negative inside: half a pixel beyond the nearest
/// pixel of an owner, and inside half a pixel and the way to the nearest pixel of its rim, which
/// has another owner, or none, above, below or beside it. Ways are shortest paths of steps along
/// rows and columns (0.955) and diagonals (1.3693), in 1/65536 pixel (Borgefors 1986, Distance
/// transformations in digital images); cv::distanceTransform(DIST_L2, DIST_MASK_3) gives the same.
/// 8192 where there is nothing to go to. `distance` is of the size of `owner`, which may be a
/// window of an image; what lies beyond is not looked at.
void measure_outline_distance(const cv::Mat1w& owner, cv::Mat1f distance);

}  // namespace mapscore
