// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#include "files/png.hpp"

#include "core/random_stream.hpp"
#include "tests/support/expect_error.hpp"

#include <gtest/gtest.h>
#include <opencv2/imgcodecs.hpp>

#include <cstdio>
#include <vector>

namespace mapscore::eval {
namespace {

using mapscore::testing::expect_error;

constexpr int kWidth = 37, kHeight = 21;  // odd on purpose
const cv::Size kSize(kWidth, kHeight);

/// Ramps with a little noise: every PNG filter gets something to do.
cv::Mat1w grey_image() {
  RandomStream random(1, "png");
  cv::Mat1w image(kSize);
  for (int v = 0; v < kHeight; ++v)
    for (int u = 0; u < kWidth; ++u)
      image(v, u) = static_cast<std::uint16_t>(900 * v + 300 * u + 40 * random.uniform());
  return image;
}

cv::Mat3b color_image() {
  RandomStream random(2, "png");
  cv::Mat3b image(kSize);
  for (int v = 0; v < kHeight; ++v)
    for (int u = 0; u < kWidth; ++u)
      image(v, u) =
          cv::Vec3b(static_cast<uchar>(5 * u), static_cast<uchar>(9 * v + 4 * random.uniform()),
                    static_cast<uchar>(u * v));
  return image;
}

bool same(const cv::Mat& a, const cv::Mat& b) {
  return a.type() == b.type() && a.size() == b.size() && cv::norm(a, b, cv::NORM_INF) == 0.0;
}

std::string by_opencv(const cv::Mat& image, int filter_strategy) {
  std::vector<uchar> bytes;
  cv::imencode(".png", image, bytes,
               {cv::IMWRITE_PNG_COMPRESSION, 9, cv::IMWRITE_PNG_STRATEGY, filter_strategy});
  return {bytes.begin(), bytes.end()};
}

cv::Mat opened_by_opencv(const std::string& png) {
  return cv::imdecode(std::vector<uchar>(png.begin(), png.end()), cv::IMREAD_UNCHANGED);
}

TEST(Png, ReturnsThePixelsItWasGiven) {
  EXPECT_TRUE(same(decode_grey16_png(encode_png(grey_image()), kSize, "x"), grey_image()));
  EXPECT_TRUE(same(decode_color_png(encode_png(color_image()), kSize, "x"), color_image()));
}

TEST(Png, IsReadByOpenCv) {
  EXPECT_TRUE(same(opened_by_opencv(encode_png(grey_image())), grey_image()));
  EXPECT_TRUE(same(opened_by_opencv(encode_png(color_image())), color_image()));
}

TEST(Png, ReadsWhatOpenCvWrites) {
  for (const int strategy : {cv::IMWRITE_PNG_STRATEGY_DEFAULT, cv::IMWRITE_PNG_STRATEGY_RLE}) {
    EXPECT_TRUE(
        same(decode_grey16_png(by_opencv(grey_image(), strategy), kSize, "x"), grey_image()));
    EXPECT_TRUE(
        same(decode_color_png(by_opencv(color_image(), strategy), kSize, "x"), color_image()));
  }
}

TEST(Png, GivesTheSameBytesForTheSameImage) {
  EXPECT_EQ(encode_png(color_image()), encode_png(color_image()));
  const cv::Mat1w part =
      grey_image()(cv::Rect(3, 2, 11, 7));  // rows that are not adjacent in memory
  EXPECT_EQ(encode_png(part), encode_png(cv::Mat1w(part.clone())));
}

TEST(Png, RefusesEveryTruncation) {
  const std::string png = encode_png(grey_image());
  for (std::size_t length = 0; length < png.size(); ++length)
    EXPECT_THROW((void)decode_grey16_png(png.substr(0, length), kSize, "x"), Error) << length;
  expect_error("cut off", [&] { (void)decode_grey16_png(png.substr(0, 60), kSize, "x"); });
  expect_error("after the end", [&] { (void)decode_grey16_png(png + "x", kSize, "x"); });
}

TEST(Png, RefusesEveryFlippedBitAndPrintsNothing) {
  const std::string png = encode_png(grey_image());
  ::testing::internal::CaptureStderr();
  for (std::size_t bit = 0; bit < 8 * png.size(); ++bit) {
    std::string broken = png;
    broken[bit / 8] = static_cast<char>(broken[bit / 8] ^ (1 << bit % 8));
    EXPECT_THROW((void)decode_grey16_png(broken, kSize, "x"), Error) << bit;
  }
  EXPECT_EQ(::testing::internal::GetCapturedStderr(), "");
}

TEST(Png, RefusesWrongSizeAndType) {
  const std::string grey = encode_png(grey_image());
  expect_error("x.png: image is 37 x 21, recording.yaml says 21 x 37", [&] {
    (void)decode_grey16_png(grey, {21, 37}, "x.png");
  });
  expect_error("x.png: image is not 8-bit RGB",
               [&] { (void)decode_color_png(grey, kSize, "x.png"); });
  expect_error("not 16-bit grey",
               [&] { (void)decode_grey16_png(encode_png(color_image()), kSize, "x"); });
  const std::string byte_grey = by_opencv(cv::Mat1b(kSize, uchar{3}), cv::IMWRITE_PNG_STRATEGY_RLE);
  expect_error("not 16-bit grey", [&] { (void)decode_grey16_png(byte_grey, kSize, "x"); });
  expect_error("not a PNG", [&] { (void)decode_grey16_png("GIF89a, or so", kSize, "x"); });
}

/// The head of a PNG that claims this size.
std::string head_of(int width, int height) {
  std::string png = encode_png(cv::Mat1w(1, 1, std::uint16_t{0}));
  for (int n = 0; n < 4; ++n) {
    png[16 + n] = static_cast<char>(width >> (24 - 8 * n));
    png[20 + n] = static_cast<char>(height >> (24 - 8 * n));
  }
  return png;
}

TEST(Png, SizesOfMoreThan16MillionPixelsAreRefusedByTheHeader) {
  EXPECT_EQ(png_size(head_of(4096, 4096), "x"), cv::Size(4096, 4096));
  EXPECT_EQ(png_size(head_of(16384, 1024), "x"), cv::Size(16384, 1024));
  expect_error(
      "x.png: 4096 x 4097 pixels are more than 16777216, as of 4096 x 4096; make the "
      "images smaller",
      [] { (void)png_size(head_of(4096, 4097), "x.png"); });
  expect_error("16384 x 16384 pixels", [] { (void)png_size(head_of(16384, 16384), "x.png"); });
  expect_error("no size of 1 to 16384", [] { (void)png_size(head_of(16385, 1), "x.png"); });
}

}  // namespace
}  // namespace mapscore::eval
