// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#include "files/png_size.hpp"

#include "core/error.hpp"

#include <fmt/format.h>

#include <cstdint>

namespace mapscore {

std::string too_many_pixels(int width_px, int height_px) {
  if (std::int64_t{width_px} * height_px <= kMostImagePixels) return {};
  return fmt::format("{} x {} pixels are more than {}, as of 4096 x 4096; make the images smaller",
                     width_px, height_px, kMostImagePixels);
}

cv::Size png_size(std::string_view bytes, const std::string& name) {
  constexpr std::size_t kWidth = 16, kHeight = 20;  // after signature, length and type
  constexpr std::uint32_t kMost = kMostImageSide_px;
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
  const cv::Size size(static_cast<int>(width), static_cast<int>(height));
  if (const std::string problem = too_many_pixels(size.width, size.height); !problem.empty())
    throw Error(name + ": " + problem);
  return size;
}

}  // namespace mapscore
