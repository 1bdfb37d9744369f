// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#pragma once

#include <opencv2/core.hpp>

namespace mapscore {

/// Signed distance in pixels to the nearest outline of a mask, negative inside masks. With d the
/// distance to the nearest rim pixel (a mask's pixel with a 4-neighbour of another owner or none):
/// d - 1/2 outside masks, -(d + 1/2) inside. d is a chamfer distance, with steps of 0.955 along
/// rows and columns and 1.3693 along diagonals, in 1/65536 pixel (Borgefors 1986, Distance
/// transformations in digital images); cv::distanceTransform(DIST_L2, DIST_MASK_3) gives the same.
/// d = 8192 without a rim. `owner`: an image or a window of one, 0 for none; `distance`: its size.
void measure_outline_distance(const cv::Mat1w& owner, cv::Mat1f distance);

}  // namespace mapscore
