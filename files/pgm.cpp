// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#include "files/pgm.hpp"

#include "core/error.hpp"

#include <fmt/format.h>

#include <cstddef>

namespace mapscore {
namespace {

constexpr std::uint32_t kMaxSize = 1u << 28;  // pixels on an axis

bool is_space(char c) {
  return c == ' ' || (c >= '\t' && c <= '\r');
}

/// Reads the header's and a P2's numbers; `#` starts a comment up to the end of its line.
class PgmText {
 public:
  PgmText(std::string_view bytes, const std::filesystem::path& file) : bytes_(bytes), file_(file) {}

  [[noreturn]] void refuse(const std::string& what) const {
    throw Error(
        fmt::format("{}: {}; write it as PGM, P5 or P2, with maxval 255", file_.string(), what));
  }

  std::uint32_t number(const char* name, std::uint32_t low, std::uint32_t high) {
    skip_space();
    std::uint32_t value = 0;
    const std::size_t first = at_;
    for (; at_ < bytes_.size() && bytes_[at_] >= '0' && bytes_[at_] <= '9'; ++at_) {
      value = 10 * value + static_cast<std::uint32_t>(bytes_[at_] - '0');
      if (value > high) break;
    }
    if (at_ == first) refuse(fmt::format("{} is missing at byte {}", name, first));
    if (value < low || value > high)
      refuse(fmt::format("{} at byte {} is not within {} to {}", name, first, low, high));
    return value;
  }

  void skip_space() {
    for (bool comment = false; at_ < bytes_.size(); ++at_) {
      const char c = bytes_[at_];
      if (c == '#') comment = true;
      if (c == '\n' || c == '\r') comment = false;
      if (!comment && !is_space(c)) return;
    }
  }

  /// The one white space before binary pixels, and what follows it.
  std::string_view rest() {
    if (at_ >= bytes_.size() || !is_space(bytes_[at_])) refuse("no white space after maxval");
    return bytes_.substr(at_ + 1);
  }

  [[nodiscard]] bool at_end() const { return at_ >= bytes_.size(); }
  void skip(std::size_t count) { at_ += count; }

 private:
  std::string_view bytes_;
  const std::filesystem::path& file_;
  std::size_t at_ = 0;
};

void read_text_pixels(PgmText& text, std::size_t count, GreyImage& image) {
  image.pixels.reserve(count);
  for (std::size_t n = 0; n < count; ++n)
    image.pixels.push_back(static_cast<std::uint8_t>(text.number("a pixel", 0, 255)));
  text.skip_space();
  if (!text.at_end()) text.refuse("something follows the pixels");
}

}  // namespace

GreyImage decode_pgm(std::string_view bytes, const std::filesystem::path& file) {
  PgmText text(bytes, file);
  const bool binary = bytes.substr(0, 2) == "P5";
  if (!binary && bytes.substr(0, 2) != "P2")
    text.refuse("is no PGM: begins with neither P5 nor P2");
  if (bytes.size() < 3 || !is_space(bytes[2])) text.refuse("no white space after the magic number");
  text.skip(2);
  GreyImage image;
  image.width = static_cast<std::int32_t>(text.number("the width", 1, kMaxSize));
  image.height = static_cast<std::int32_t>(text.number("the height", 1, kMaxSize));
  text.number("maxval", 255, 255);
  const std::size_t count =
      static_cast<std::size_t>(image.width) * static_cast<std::size_t>(image.height);
  if (count > bytes.size())
    text.refuse(fmt::format("{} x {} pixels do not fit into {} bytes", image.width, image.height,
                            bytes.size()));
  if (!binary) {
    read_text_pixels(text, count, image);
    return image;
  }
  const std::string_view pixels = text.rest();
  if (pixels.size() != count)
    text.refuse(fmt::format("holds {} bytes of pixels where {} x {} are {}", pixels.size(),
                            image.width, image.height, count));
  image.pixels.assign(pixels.begin(), pixels.end());
  return image;
}

std::string encode_pgm(const GreyImage& image) {
  std::string bytes = fmt::format("P5\n{} {}\n255\n", image.width, image.height);
  bytes.append(image.pixels.begin(), image.pixels.end());
  return bytes;
}

}  // namespace mapscore
