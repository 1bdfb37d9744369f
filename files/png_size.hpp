// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#pragma once

#include <opencv2/core.hpp>

#include <string>
#include <string_view>

namespace mapscore {

/// Greatest side and number of pixels (4096 x 4096) of an image that is read. A few kilobytes of
/// PNG can unpack to gigabytes, so only these limits bound the memory that an image takes.
inline constexpr int kMostImageSide_px = 16384;
inline constexpr int kMostImagePixels = 1 << 24;

/// Says how many pixels there are at most, for an Error; empty for an image of allowed size.
[[nodiscard]] std::string too_many_pixels(int width_px, int height_px);

/// Width and height by the header of a PNG, within the bounds above. `name` opens the message of
/// the Error. Decoding checks the rest.
[[nodiscard]] cv::Size png_size(std::string_view bytes, const std::string& name);

}  // namespace mapscore
