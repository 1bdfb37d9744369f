// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#pragma once

#include <opencv2/core.hpp>

#include <bit>
#include <cstdint>

namespace mapscore {

/// What the lowest two bits of a distance tell of the outline that is nearest to its pixel: it is
/// no border of two masks, or the one beside a mask of a higher, or of a lower number.
enum Border : std::int32_t { kNoBorder, kBesideHigher, kBesideLower };
inline constexpr std::int32_t kBorderBits = 3;

[[nodiscard]] inline std::int32_t border_of(float distance) {
  return std::bit_cast<std::int32_t>(distance) & kBorderBits;
}

/// The distance from that border, where it is one: negative in the mask of the lower number,
/// positive in the other, so that it is 0 on the border and goes on evenly.
[[nodiscard]] inline float beyond_border(float distance) {
  return border_of(distance) == kBesideLower ? -distance : distance;
}

/// Signed distance in pixels to the nearest outline of a mask, negative inside masks. With d the
/// distance to the nearest rim pixel (a mask's pixel with a 4-neighbour of another owner or none):
/// d - 1/2 outside masks, -(d + 1/2) inside. d is a chamfer distance, with steps of 0.955 along
/// rows and columns and 1.3693 along diagonals, rounded to 1/16384 pixel (Borgefors 1986, Distance
/// transformations in digital images); cv::distanceTransform(DIST_L2, DIST_MASK_3) gives the same
/// within 1/30000 of it. d = 8192 without a rim. `owner`: an image or a window of one, 0 for none;
/// `distance`: its size.
/// In masks the lowest two bits of a distance are a Border, which tells whether the nearest rim
/// pixel touches another mask; they change the distance by less than 4e-7 of it. A rim pixel that
/// touches several masks counts as beside one of a higher number; of rims equally near one that is
/// no border comes first, then one beside a higher number. So between a mask of a lower and one of
/// a higher number `beyond_border` changes its sign once more in the middle of a strip, and a strip
/// of one pixel has no border with the lower one.
void measure_outline_distance(const cv::Mat1w& owner, cv::Mat1f distance);

}  // namespace mapscore
