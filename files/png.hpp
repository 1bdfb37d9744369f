// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#pragma once

#include <opencv2/core.hpp>

#include <string>
#include <string_view>

namespace mapscore {

// Reads and writes the two kinds of PNG in a recording, 8-bit colour and 16-bit grey, and reads
// images of ids; not interlaced, by any writer. Chunks and row filters are our own, compression is
// libdeflate's: faster than libpng (results/notes/speed.md), which also prints to standard error.
// All functions are pure: the same image gives the same bytes with one release of libdeflate.

/// Greatest side and number of pixels (4096 x 4096) of an image that is read. A few kilobytes of
/// PNG can unpack to gigabytes, so only these limits bound the memory that an image takes.
inline constexpr int kMostImageSide_px = 16384;
inline constexpr int kMostImagePixels = 1 << 24;

/// Says how many pixels there are at most, for an Error; empty for an image of allowed size.
[[nodiscard]] std::string too_many_pixels(int width_px, int height_px);

/// Width and height by the header of a PNG, within the bounds above. `name` opens the message of
/// the Error. Decoding checks the rest.
[[nodiscard]] cv::Size png_size(std::string_view bytes, const std::string& name);

/// BGR in memory, RGB in the file.
[[nodiscard]] std::string encode_png(const cv::Mat3b& image);
[[nodiscard]] std::string encode_png(const cv::Mat1w& image);

/// The image in `bytes`, which must have `size`. Signature, chunk order and lengths, the CRC of
/// every chunk and the checksum of the pixels are verified. `name` opens the message of the Error.
[[nodiscard]] cv::Mat3b decode_color_png(std::string_view bytes, cv::Size size,
                                         const std::string& name);
[[nodiscard]] cv::Mat1w decode_grey16_png(std::string_view bytes, cv::Size size,
                                          const std::string& name);
/// An image of ids of any writer: grey or palette of 1, 2, 4 or 8 bits, or grey of 16. The id is
/// the stored sample, or the index into the palette, whatever colour that gives it.
[[nodiscard]] cv::Mat1w decode_id_png(std::string_view bytes, cv::Size size,
                                      const std::string& name);

}  // namespace mapscore
