// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#include "eval/recording/png_size.hpp"

#include "core/error.hpp"

#include <cstdint>

namespace mapscore::eval {

cv::Size png_size(std::string_view bytes, const std::string& name) {
  constexpr std::size_t kWidth = 16, kHeight = 20;  // after signature, length and type
  constexpr std::uint32_t kMost = 16384;
  if (!bytes.starts_with("\x89PNG\r\n\x1a\n") || bytes.size() < kHeight + 4)
    throw Error(name + ": is no PNG file; convert it, or copy it anew");
  const auto number_at = [&](std::size_t start) {
    std::uint32_t number = 0;
    for (std::size_t i = 0; i < 4; ++i)
      number = number << 8 | static_cast<std::uint8_t>(bytes[start + i]);
    return number;
  };
  const std::uint32_t width = number_at(kWidth), height = number_at(kHeight);
  if (width < 1 || width > kMost || height < 1 || height > kMost)
    throw Error(name + ": its header says no size of 1 to 16384 pixels; copy the file anew");
  return {static_cast<int>(width), static_cast<int>(height)};
}

}  // namespace mapscore::eval
