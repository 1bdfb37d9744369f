// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

namespace mapscore {

/// Grey image of 8 bits, row-major, row 0 at the top.
struct GreyImage {
  std::int32_t width = 0, height = 0;
  std::vector<std::uint8_t> pixels;
};

/// Decodes a PGM, binary (P5) or text (P2), of maxval 255. Throws Error that begins with `file`
/// when the header is wrong, or pixels are missing, too many, or beyond 255.
[[nodiscard]] GreyImage decode_pgm(std::string_view bytes, const std::filesystem::path& file);

/// P5.
[[nodiscard]] std::string encode_pgm(const GreyImage& image);

}  // namespace mapscore
