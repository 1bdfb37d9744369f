// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#pragma once

#include <opencv2/core.hpp>

namespace mapscore {

/// Of pixels whose nearest outline is no border of two masks.
inline constexpr float kNoBorder = 1e4F;

/// Signed distance in pixels to the nearest outline of a mask, negative inside masks. With d the
/// distance to the nearest rim pixel (a mask's pixel with a 4-neighbour of another owner or none):
/// d - 1/2 outside masks, -(d + 1/2) inside. d is a chamfer distance, with steps of 0.955 along
/// rows and columns and 1.3693 along diagonals, rounded to 1/16384 pixel (Borgefors 1986, Distance
/// transformations in digital images); cv::distanceTransform(DIST_L2, DIST_MASK_3) gives the same
/// within 1/30000 of it. d = 8192 without a rim. `owner`: an image or a window of one, 0 for none;
/// `distance`: its size.
/// `beyond_border`, empty or of that size: where the nearest rim pixel touches another mask, the
/// distance from that border, negative in the mask of the lower number, positive in the other, so
/// that it is 0 on the border and goes on evenly; kNoBorder elsewhere. A rim pixel that touches
/// several counts as beside one of a higher number; of rims equally near one that is no border
/// comes first, then one beside a higher number. So in a strip of 1 to 3 pixels between a mask of a
/// lower and one of a higher number it may change its sign.
void measure_outline_distance(const cv::Mat1w& owner, cv::Mat1f distance,
                              cv::Mat1f beyond_border = {});

}  // namespace mapscore
