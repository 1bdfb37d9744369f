// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#include "core/random_stream.hpp"
#include "files/png.hpp"
#include "tests/support/expect_error.hpp"

#include <gtest/gtest.h>
#include <libdeflate.h>
#include <opencv2/imgcodecs.hpp>

#include <vector>

namespace mapscore::eval {
namespace {

using mapscore::testing::expect_error;

constexpr int kWidth = 13, kHeight = 5;  // rows of 1, 2 and 4 bits end within a byte
const cv::Size kSize(kWidth, kHeight);

std::string big_endian(std::uint32_t value) {
  std::string bytes;
  for (int shift = 24; shift >= 0; shift -= 8) bytes += static_cast<char>(value >> shift & 255);
  return bytes;
}

std::string chunk(const std::string& type, const std::string& data) {
  const std::string checked = type + data;
  return big_endian(static_cast<std::uint32_t>(data.size())) + checked +
         big_endian(libdeflate_crc32(0, checked.data(), checked.size()));
}

cv::Mat1w ids(int bits) {
  RandomStream random(3, "id png");
  cv::Mat1w image(kSize);
  for (auto& id : image) id = static_cast<std::uint16_t>(random.uniform() * (1 << bits));
  return image;
}

/// A PNG of `bits` a pixel, unfiltered, as the specification says; of a palette with colour type 3.
std::string png_of(const cv::Mat1w& image, int bits, int colour_type) {
  std::string rows;
  for (int v = 0; v < image.rows; ++v) {
    rows += '\0';
    unsigned byte = 0;
    int filled = 0;
    for (int u = 0; u < image.cols; ++u) {
      byte = byte << bits | image(v, u);
      filled += bits;
      if (filled < 8 && u + 1 < image.cols) continue;
      rows += static_cast<char>(byte << (8 - filled));
      byte = 0;
      filled = 0;
    }
  }
  libdeflate_compressor* compressor = libdeflate_alloc_compressor(6);
  std::string packed(libdeflate_zlib_compress_bound(compressor, rows.size()), '\0');
  packed.resize(
      libdeflate_zlib_compress(compressor, rows.data(), rows.size(), packed.data(), packed.size()));
  libdeflate_free_compressor(compressor);
  std::string header = big_endian(kWidth) + big_endian(kHeight);
  header += static_cast<char>(bits);
  header += static_cast<char>(colour_type);
  header.append(3, '\0');
  std::string png("\x89PNG\r\n\x1a\n", 8);
  png += chunk("IHDR", header);
  if (colour_type == 3) png += chunk("PLTE", std::string(std::size_t{3} << bits, '\x55'));
  return png + chunk("IDAT", packed) + chunk("IEND", "");
}

TEST(IdPng, ReadsSamplesAndPaletteIndicesOfAnyWidth) {
  for (const int bits : {1, 2, 4, 8}) {
    for (const int colour_type : {0, 3}) {
      const cv::Mat1w image = ids(bits);
      const cv::Mat1w read = decode_id_png(png_of(image, bits, colour_type), kSize, "x");
      EXPECT_EQ(cv::norm(read, image, cv::NORM_INF), 0.0) << bits << " bits, " << colour_type;
    }
  }
  EXPECT_EQ(cv::norm(decode_id_png(encode_png(ids(16)), kSize, "x"), ids(16), cv::NORM_INF), 0.0);
}

TEST(IdPng, ReadsWhatOpenCvWrites) {
  cv::Mat narrow;
  ids(8).convertTo(narrow, CV_8U);
  std::vector<uchar> bytes;
  cv::imencode(".png", narrow, bytes);
  const cv::Mat1w read = decode_id_png(std::string(bytes.begin(), bytes.end()), kSize, "x");
  EXPECT_EQ(cv::norm(read, ids(8), cv::NORM_INF), 0.0);
}

TEST(IdPng, RefusesColourOtherSizesAndDamage) {
  const std::string good = png_of(ids(4), 4, 3);
  const auto decode = [](const std::string& bytes, cv::Size size) {
    (void)decode_id_png(bytes, size, "x.png");
  };
  const std::string colour = encode_png(cv::Mat3b(kSize));
  expect_error("x.png: image is not grey or palette", [&] { decode(colour, kSize); });
  expect_error("x.png: image is 13 x 5", [&] { decode(good, {kWidth, kHeight + 1}); });
  for (std::size_t length = 0; length < good.size(); ++length)
    expect_error("x.png", [&] { decode(good.substr(0, length), kSize); });
  for (std::size_t at = 0; at < good.size(); ++at) {
    std::string bad = good;
    bad[at] = static_cast<char>(bad[at] ^ 0x10);
    expect_error("x.png", [&] { decode(bad, kSize); });
  }
}

}  // namespace
}  // namespace mapscore::eval
