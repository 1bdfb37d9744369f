// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#include "files/png.hpp"
#include "tests/support/mutations.hpp"
#include "tests/support/tiny_recording.hpp"

#include <libdeflate.h>

#include <functional>

namespace mapscore::eval {
namespace {

constexpr std::uint64_t kMutations = 1000;
constexpr std::size_t kSignature = 8, kChunkHead = 8, kCrc = 4;

using Decode = std::function<void(std::string_view png, cv::Size size)>;
const Decode kColour = [](std::string_view png, cv::Size size) {
  ASSERT_EQ(decode_color_png(png, size, "image.png").size(), size);
};
const Decode kGrey16 = [](std::string_view png, cv::Size size) {
  ASSERT_EQ(decode_grey16_png(png, size, "image.png").size(), size);
};
const Decode kId = [](std::string_view png, cv::Size size) {
  ASSERT_EQ(decode_id_png(png, size, "image.png").size(), size);
};

std::string big_endian(std::size_t value) {
  return {static_cast<char>(value >> 24), static_cast<char>(value >> 16 & 255),
          static_cast<char>(value >> 8 & 255), static_cast<char>(value & 255)};
}

std::size_t length_at(const std::string& png, std::size_t offset) {
  std::size_t length = 0;
  for (std::size_t i = 0; i < 4; ++i)
    length = length << 8 | static_cast<std::uint8_t>(png[offset + i]);
  return length;
}

std::string chunk(const std::string& type, const std::string& data) {
  const std::string checked = type + data;
  return big_endian(data.size()) + checked +
         big_endian(libdeflate_crc32(0, checked.data(), checked.size()));
}

/// Makes the CRCs right again, as far as the chunks can be told, so that damage gets further in.
std::string with_crcs(std::string png) {
  for (std::size_t at = kSignature; at + kChunkHead + kCrc <= png.size();) {
    const std::size_t length = length_at(png, at);
    if (length > png.size() - at - kChunkHead - kCrc) break;
    const std::string whole = chunk(png.substr(at + 4, 4), png.substr(at + kChunkHead, length));
    png.replace(at, whole.size(), whole);
    at += whole.size();
  }
  return png;
}

/// The filtered rows of a PNG of one IDAT, and the PNG of other rows.
struct Rows {
  std::string before, rows, after;

  explicit Rows(const std::string& png, std::size_t bytes) : rows(bytes, '\0') {
    const std::size_t start = png.find("IDAT") - 4, length = length_at(png, start);
    before = png.substr(0, start);
    after = png.substr(start + kChunkHead + length + kCrc);
    auto* inflater = libdeflate_alloc_decompressor();
    EXPECT_EQ(libdeflate_zlib_decompress(inflater, png.data() + start + kChunkHead, length,
                                         rows.data(), bytes, nullptr),
              LIBDEFLATE_SUCCESS);
    libdeflate_free_decompressor(inflater);
  }

  [[nodiscard]] std::string png_of(const std::string& other) const {
    auto* deflater = libdeflate_alloc_compressor(1);
    std::string data(libdeflate_zlib_compress_bound(deflater, other.size()), '\0');
    data.resize(
        libdeflate_zlib_compress(deflater, other.data(), other.size(), data.data(), data.size()));
    libdeflate_free_compressor(deflater);
    return before + chunk("IDAT", data) + after;
  }
};

/// Damages the file, the file under right CRCs, and its rows under a right checksum.
template <class Image>
void expect_read_or_refused(const Image& image, const Decode& decode) {
  const std::string png = encode_png(image);
  const cv::Size size = image.size();
  const auto plain = testing::read_mutations(
      png, kMutations, [&](const std::string& bytes) { decode(bytes, size); });
  EXPECT_GT(plain.refused, static_cast<int>(kMutations) * 9 / 10) << "the CRCs see nearly all";
  const auto repaired = testing::read_mutations(
      png, kMutations, [&](const std::string& bytes) { decode(with_crcs(bytes), size); });
  EXPECT_GT(repaired.refused, 100);
  const Rows rows(png, static_cast<std::size_t>(size.height) *
                           (1 + static_cast<std::size_t>(size.width) * image.elemSize()));
  ASSERT_NO_THROW(decode(rows.png_of(rows.rows), size));
  const auto deep = testing::read_mutations(
      rows.rows, kMutations, [&](const std::string& bytes) { decode(rows.png_of(bytes), size); });
  EXPECT_GT(deep.read, 100);
  EXPECT_GT(deep.refused, 100) << "rows missing, or of an unknown filter";
}

TEST(DamagedPng, Colour) {
  expect_read_or_refused(testing::tiny_frames()[0].color, kColour);
}

TEST(DamagedPng, Depth) {
  expect_read_or_refused(testing::tiny_frames()[0].depth, kGrey16);
}

TEST(DamagedPng, Ids) {
  expect_read_or_refused(testing::tiny_frames()[0].label, kId);
}

}  // namespace
}  // namespace mapscore::eval
