// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#include "core/segmentation/erosion.hpp"

#include "core/error.hpp"
#include "core/random_stream.hpp"

#include <gtest/gtest.h>

#include <limits>

namespace mapscore {
namespace {

/// The detection that a mask of the image's size stands for; the mask has at least one pixel.
Detection detection_of(const cv::Mat1b& image_mask) {
  cv::Mat1w label(image_mask.size(), std::uint16_t{0});
  label.setTo(1, image_mask);
  ClassTable table;
  table.classes.push_back({1, "thing", {}, true});
  table.instances.push_back({1, "thing_1", 1});
  return detections_of(label, table).at(0);
}

/// The eroded mask, of the image's size.
cv::Mat1b eroded(const cv::Mat1b& image_mask, int radius_px) {
  const Detection detection = detection_of(image_mask);
  cv::Mat1b result(image_mask.size(), std::uint8_t{0});
  erode_mask(detection, radius_px, image_mask.cols, image_mask.rows)
      .copyTo(result(detection.box.rect()));
  return result;
}

/// The definition: no pixel of the image within the disc lies outside the mask.
cv::Mat1b eroded_plain(const cv::Mat1b& mask, int radius) {
  cv::Mat1b result = mask.clone();
  for (int v = 0; v < mask.rows; ++v)
    for (int u = 0; u < mask.cols; ++u)
      for (int y = 0; y < mask.rows; ++y)
        for (int x = 0; x < mask.cols; ++x)
          if (!mask(y, x) && (x - u) * (x - u) + (y - v) * (y - v) <= radius * radius)
            result(v, u) = 0;
  return result;
}

bool equal_masks(const cv::Mat1b& a, const cv::Mat1b& b) {
  return cv::countNonZero(a != b) == 0;
}

TEST(Erosion, RadiusZeroChangesNothing) {
  const cv::Mat1b mask = (cv::Mat1b(2, 3) << 255, 0, 255, 0, 255, 255);
  EXPECT_TRUE(equal_masks(eroded(mask, 0), mask));
}

TEST(Erosion, RadiusOneTakesTheFourNeighbours) {
  cv::Mat1b mask(7, 7, std::uint8_t{0});
  mask(cv::Rect(1, 1, 5, 5)) = 255;
  mask(1, 1) = 0;  // a missing corner costs (2, 1) and (1, 2), which go anyway, not (2, 2)
  cv::Mat1b expected(7, 7, std::uint8_t{0});
  expected(cv::Rect(2, 2, 3, 3)) = 255;
  EXPECT_TRUE(equal_masks(eroded(mask, 1), expected));
}

TEST(Erosion, DiscIsClosed) {
  cv::Mat1b mask(21, 21, std::uint8_t{255});
  mask(10, 10) = 0;
  const cv::Mat1b result = eroded(mask, 5);
  EXPECT_EQ(result(10, 15), 0);                       // 5, 0
  EXPECT_EQ(result(14, 13), 0);                       // 3, 4: on the circle
  EXPECT_EQ(result(14, 14), 255);                     // 4, 4: beyond it
  EXPECT_EQ(21 * 21 - cv::countNonZero(result), 81);  // lattice points of a disc of radius 5
}

TEST(Erosion, MaskGoesOnBeyondTheImagesEdge) {
  const cv::Mat1b whole(6, 8, std::uint8_t{255});
  EXPECT_TRUE(equal_masks(eroded(whole, 3), whole));
  cv::Mat1b left_half(6, 8, std::uint8_t{0});
  left_half(cv::Rect(0, 0, 4, 6)) = 255;
  cv::Mat1b expected(6, 8, std::uint8_t{0});
  expected(cv::Rect(0, 0, 2, 6)) = 255;
  EXPECT_TRUE(equal_masks(eroded(left_half, 2), expected));
}

TEST(Erosion, AnotherInstanceErodesAsBackgroundDoes) {
  cv::Mat1w label(5, 9, std::uint16_t{2});
  label(cv::Rect(0, 0, 4, 5)) = 1;
  ClassTable table;
  table.classes.push_back({1, "thing", {}, true});
  table.instances.push_back({1, "thing_1", 1});
  table.instances.push_back({2, "thing_2", 1});
  const Detection left = detections_of(label, table).at(0);
  EXPECT_EQ(cv::countNonZero(erode_mask(left, 1, 9, 5)), 15);  // columns 0 to 2 stay
}

TEST(Erosion, EqualsTheDefinitionOnRandomMasks) {
  RandomStream stream(3, "erosion test");
  for (int round = 0; round < 60; ++round) {
    cv::Mat1b mask(17, 23, std::uint8_t{255});
    const int holes = static_cast<int>(10 * stream.uniform());
    for (int hole = 0; hole < holes; ++hole)
      mask(static_cast<int>(17 * stream.uniform()), static_cast<int>(23 * stream.uniform())) = 0;
    if (round % 3 == 0) mask(cv::Rect(0, 0, 23, 4)) = 0;
    if (round % 4 == 0) mask(cv::Rect(15, 0, 8, 17)) = 0;
    for (const int radius : {1, 2, 3, 5, 30})
      ASSERT_TRUE(equal_masks(eroded(mask, radius), eroded_plain(mask, radius)))
          << "round " << round << ", radius " << radius;
  }
}

TEST(Erosion, RadiiBeyondTheImageAreItsDiagonal) {
  cv::Mat1b whole(30, 40, std::uint8_t{255}), corner = whole.clone();
  corner(0, 0) = 0;
  for (const int radius_px : {49, 50, 51, 100000, std::numeric_limits<int>::max()}) {
    EXPECT_TRUE(equal_masks(eroded(whole, radius_px), whole)) << "there the mask goes on";
    EXPECT_EQ(cv::countNonZero(eroded(corner, radius_px)), 0) << radius_px;
  }
  EXPECT_EQ(cv::countNonZero(eroded(corner, 48)), 2) << "at (39, 28) and (39, 29)";
  EXPECT_THROW((void)eroded(whole, -1), Error);
}

}  // namespace
}  // namespace mapscore
