// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#include "sim/faults/label_noise.hpp"

#include "core/error.hpp"
#include "tests/sim/faults/depth_planes.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <limits>
#include <numbers>

namespace mapscore::sim {
namespace {

using mapscore::testing::same_pixels;

/// Class 1 is detected, class 2 (the wall, instance 1) is not; instances from 2 on are of class 1.
ClassTable table_of(int objects) {
  ClassTable table;
  table.classes.push_back({1, "cup", {}, true});
  table.classes.push_back({2, "wall", {}, false});
  table.instances.push_back({1, "wall_1", 2});
  for (int i = 0; i < objects; ++i)
    table.instances.push_back({static_cast<InstanceId>(2 + i), "cup", 1});
  return table;
}

cv::Mat1w wall(int width, int height) {
  return cv::Mat1w(height, width, std::uint16_t{1});
}

int pixels_of(const cv::Mat1w& label, int id) {
  return cv::countNonZero(label == id);
}

TEST(LabelNoise, DosesOfZeroReturnTheVeryPixelsAndVerdicts) {
  cv::Mat1w label = wall(64, 48);
  label(cv::Rect(10, 10, 20, 20)) = 2;
  const ClassTable table = table_of(1);
  EXPECT_EQ(corrupt_labels(label, table, {}, 1, 0).data, label.data);
  const auto detections = corrupt_detections(label, table, {}, 1, 0);
  ASSERT_EQ(detections.size(), 1u);
  EXPECT_EQ(detections[0].class_id, 1);
  EXPECT_EQ(detections[0].score, 1.0);
  EXPECT_EQ(detections[0].box, (PixelBox{10, 10, 29, 29}));
}

TEST(LabelNoise, BoundaryGrowsAndShrinksByItsPixels) {
  cv::Mat1w label = wall(200, 150);
  label(cv::Rect(50, 40, 100, 60)) = 2;
  const ClassTable table = table_of(1);
  for (const double k : {1.0, 3.0, 8.0}) {
    const cv::Mat1w grown = corrupt_labels(label, table, {.boundary_px = k}, 1, 0);
    const double expected = 2 * k * (100 + 60) + std::numbers::pi * k * k;
    EXPECT_NEAR(pixels_of(grown, 2) - 6000, expected, 0.02 * expected) << k;
    EXPECT_EQ(cv::countNonZero(grown.row(70) == 2), 100 + 2 * k);
    EXPECT_EQ(pixels_of(grown, 1) + pixels_of(grown, 2), 200 * 150);
    const cv::Mat1w shrunk = corrupt_labels(label, table, {.boundary_px = -k}, 1, 0);
    EXPECT_EQ(pixels_of(shrunk, 2), (100 - 2 * k) * (60 - 2 * k)) << k;
    EXPECT_EQ(pixels_of(shrunk, 1), pixels_of(label, 1)) << "the wall does not fill in";
  }
}

TEST(LabelNoise, BeyondTheImageAMaskGoesOn) {
  cv::Mat1w label = wall(60, 40);
  label(cv::Rect(0, 0, 20, 40)) = 2;
  const cv::Mat1w shrunk = corrupt_labels(label, table_of(1), {.boundary_px = -3}, 1, 0);
  EXPECT_EQ(pixels_of(shrunk, 2), 17 * 40);
  label = std::uint16_t{2};
  EXPECT_EQ(pixels_of(corrupt_labels(label, table_of(1), {.boundary_px = -3}, 1, 0), 2), 60 * 40);
}

TEST(LabelNoise, TouchingMasksKeepTheirBorderAndANarrowGapGoesToTheNearest) {
  cv::Mat1w label = wall(100, 20);
  label(cv::Rect(10, 0, 20, 20)) = 3;
  label(cv::Rect(30, 0, 20, 20)) = 2;
  label(cv::Rect(55, 0, 20, 20)) = 4;  // five columns of wall between 2 and 4
  const cv::Mat1w grown = corrupt_labels(label, table_of(3), {.boundary_px = 4}, 1, 0);
  EXPECT_EQ(grown(5, 29), 3);
  EXPECT_EQ(grown(5, 30), 2);
  EXPECT_EQ(grown(5, 51), 2);
  EXPECT_EQ(grown(5, 52), 2) << "as near to both: the lower id";
  EXPECT_EQ(grown(5, 53), 4);
  EXPECT_EQ(grown(5, 78), 4);
  EXPECT_EQ(grown(5, 79), 1);
}

/// Standard deviation in pixels.
class Ragged : public ::testing::TestWithParam<double> {};

TEST_P(Ragged, BoundaryLiesWhereANormalDrawPutsIt) {
  const double sigma_px = GetParam();
  cv::Mat1w label = wall(60, 480);
  label.colRange(30, 60) = 2;
  const ClassTable table = table_of(1);
  std::vector<double> crossed(10, 0.0);
  constexpr int kFrames = 700;
  for (int frame = 0; frame < kFrames; ++frame) {
    const cv::Mat1w ragged = corrupt_labels(label, table, {.ragged_px = sigma_px}, 3, frame);
    for (int beyond = 0; beyond < 10; ++beyond)
      crossed[static_cast<std::size_t>(beyond)] += cv::countNonZero(ragged.col(29 - beyond) == 2) +
                                                   cv::countNonZero(ragged.col(30 + beyond) != 2);
  }
  double sum = 0.0, expected = 0.0;
  for (int beyond = 0; beyond < 10; ++beyond) {
    const double share = crossed[static_cast<std::size_t>(beyond)] / (2.0 * kFrames * 480);
    const double normal = 0.5 * std::erfc((beyond + 0.5) / sigma_px / std::numbers::sqrt2);
    EXPECT_NEAR(share, normal, 0.01) << beyond;
    sum += share;
    expected += normal;
  }
  EXPECT_NEAR(sum, expected, 0.02 * expected);
}

INSTANTIATE_TEST_SUITE_P(Doses, Ragged, ::testing::Values(1.0, 1.5, 2.5));

TEST(LabelNoise, RaggedBoundariesAreSmooth) {
  cv::Mat1w label = wall(60, 480);
  label.colRange(30, 60) = 2;
  double changes = 0.0, off = 0.0;
  for (int frame = 0; frame < 20; ++frame) {
    const cv::Mat1w ragged = corrupt_labels(label, table_of(1), {.ragged_px = 3}, 3, frame);
    for (int v = 1; v < 480; ++v) {
      off += ragged(v, 29) == 2;
      changes += (ragged(v, 29) == 2) != (ragged(v - 1, 29) == 2);
    }
  }
  // Rows that were drawn by themselves would change as often as 2 p (1 - p).
  const double p = off / (20 * 479);
  EXPECT_LT(changes / (20 * 479), 0.5 * 2 * p * (1 - p));
}

/// 64 squares of 10 x 10 px.
cv::Mat1w squares() {
  cv::Mat1w label = wall(200, 200);
  for (int i = 0; i < 64; ++i)
    label(cv::Rect(5 + 24 * (i % 8), 5 + 24 * (i / 8), 10, 10)) = static_cast<std::uint16_t>(2 + i);
  return label;
}

TEST(LabelNoise, MissChanceByHand) {
  EXPECT_NEAR(miss_chance({.miss = 0.8}, 1024), 0.4, 1e-12);
  EXPECT_NEAR(miss_chance({.miss = 3}, 1024), 0.5, 1e-12);
  EXPECT_LT(miss_chance({.miss = 1}, 100000), 0.011);
  EXPECT_NEAR(miss_chance({.miss = 1}, 1), 1.0, 0.001);
}

TEST(LabelNoise, MissesItsShareAndMoreOfTheSmall) {
  const cv::Mat1w label = squares();
  const ClassTable table = table_of(64);
  for (const double area_px : {25.0, 100.0, 400.0}) {
    const LabelDose dose{.miss = 0.9, .miss_area_px = area_px};
    const double expected = 0.9 * area_px / (area_px + 100);
    double missed = 0.0;
    constexpr int kFrames = 1500;
    for (int frame = 0; frame < kFrames; ++frame) {
      const auto detections = corrupt_detections(label, table, dose, 8, frame);
      missed += 64.0 - static_cast<double>(detections.size());
    }
    EXPECT_NEAR(missed / (64.0 * kFrames), expected, 0.02 * expected) << area_px;
  }
}

TEST(LabelNoise, HolesTakeTheirShareOfTheMask) {
  cv::Mat1w label(480, 640, std::uint16_t{2});
  for (const double share : {0.02, 0.1, 0.5}) {
    double left = 0.0;
    constexpr int kFrames = 12;
    for (int frame = 0; frame < kFrames; ++frame)
      left += pixels_of(corrupt_labels(label, table_of(1), {.holes = share}, 4, frame), 2);
    const double holes = 1.0 - left / (kFrames * 640.0 * 480.0);
    EXPECT_NEAR(holes, share, 0.02 * share);
  }
}

TEST(LabelNoise, IslandsTakeTheirShareOfTheSurroundings) {
  cv::Mat1w label = wall(640, 480);
  label(cv::Rect(100, 100, 440, 280)) = 2;
  const double share = 0.1;
  double islands = 0.0, ring = 0.0;
  for (int frame = 0; frame < 60; ++frame) {
    const cv::Mat1w noisy = corrupt_labels(label, table_of(1), {.islands = share}, 4, frame);
    EXPECT_EQ(pixels_of(noisy(cv::Rect(100, 100, 440, 280)), 2), 440 * 280);
    // Straight parts: distances of half a pixel and whole ones, from 5 to 20.
    for (const cv::Rect& band : {cv::Rect(105, 85, 430, 10), cv::Rect(105, 385, 430, 10)}) {
      ring += band.area();
      islands += pixels_of(noisy(band), 2);
    }
    EXPECT_EQ(pixels_of(noisy.rowRange(0, 79), 2), 0);
    EXPECT_EQ(pixels_of(noisy(cv::Rect(100, 96, 440, 4)), 2), 0);
  }
  EXPECT_NEAR(islands / ring, share, 0.02 * share);
}

TEST(LabelNoise, AMissedInstanceLeavesItsPixelsToOthers) {
  cv::Mat1w label = wall(60, 20);
  label(cv::Rect(10, 0, 10, 20)) = 2;
  label(cv::Rect(20, 0, 5, 20)) = 3;
  const LabelDose dose{.boundary_px = 3, .miss = 1, .miss_area_px = 150};
  bool seen = false;
  for (int frame = 0; frame < 50; ++frame) {
    const cv::Mat1w noisy = corrupt_labels(label, table_of(2), dose, 1, frame);
    if (pixels_of(noisy, 2) == 0 || pixels_of(noisy, 3) > 0) continue;
    seen = true;
    EXPECT_EQ(noisy(5, 22), 2);
    EXPECT_EQ(noisy(5, 23), 0);
  }
  EXPECT_TRUE(seen);
}

TEST(LabelNoise, OneEffectOrInstanceLeavesTheDrawsOfTheOthersAlone) {
  cv::Mat1w label = wall(300, 100);
  label(cv::Rect(20, 20, 60, 60)) = 2;
  label(cv::Rect(200, 20, 60, 60)) = 3;
  cv::Mat1w without = label.clone();
  without.setTo(1, label == 2);
  const ClassTable table = table_of(2);
  const LabelDose ragged{.ragged_px = 2, .holes = 0.05, .islands = 0.05};
  const cv::Mat1w both = corrupt_labels(label, table, ragged, 5, 1);
  const cv::Mat1w alone = corrupt_labels(without, table, ragged, 5, 1);
  EXPECT_TRUE(same_pixels(both.colRange(150, 300), alone.colRange(150, 300)));
  LabelDose missing = ragged;
  missing.miss = 0.7;
  for (int frame = 0; frame < 5; ++frame) {
    const cv::Mat1w kept = corrupt_labels(label, table, ragged, 5, frame);
    const cv::Mat1w fewer = corrupt_labels(label, table, missing, 5, frame);
    if (pixels_of(fewer, 3) == 0) continue;
    EXPECT_TRUE(same_pixels(kept.colRange(150, 300), fewer.colRange(150, 300)));
  }
  // Holes only take from what is there without them.
  const cv::Mat1w whole = corrupt_labels(label, table, {.ragged_px = 2}, 5, 1);
  const cv::Mat1w pierced = corrupt_labels(label, table, {.ragged_px = 2, .holes = 0.05}, 5, 1);
  EXPECT_TRUE(cv::countNonZero((pierced != whole) & (pierced != 0)) == 0);
  EXPECT_LT(pixels_of(pierced, 2), pixels_of(whole, 2));
}

TEST(LabelNoise, IsAFunctionOfSeedAndFrameAndLeavesItsInputAlone) {
  const cv::Mat1w label = squares(), before = label.clone();
  const ClassTable table = table_of(64);
  const LabelDose dose = LabelDose::of(LabelPreset::typical);
  const cv::Mat1w one = corrupt_labels(label, table, dose, 1, 0);
  EXPECT_TRUE(same_pixels(label, before));
  EXPECT_TRUE(same_pixels(one, corrupt_labels(label, table, dose, 1, 0)));
  EXPECT_FALSE(same_pixels(one, corrupt_labels(label, table, dose, 2, 0)));
  EXPECT_FALSE(same_pixels(one, corrupt_labels(label, table, dose, 1, 1)));
}

TEST(LabelDose, BadInputIsRefused) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const cv::Mat1w label = wall(20, 20);
  for (const LabelDose& dose :
       {LabelDose{.boundary_px = 1001}, LabelDose{.boundary_px = nan}, LabelDose{.ragged_px = -1},
        LabelDose{.miss = -0.1}, LabelDose{.holes = nan}, LabelDose{.ragged_length_px = 0},
        LabelDose{.score_mean = 1.5}, LabelDose{.score_concentration = 0},
        LabelDose{.confusion_matrix = {{0.5, 0.4}, {0, 1}}},
        LabelDose{.confusion_matrix = {{1, 0}}}, LabelDose{.confusion_matrix = {{-1, 2}, {0, 1}}},
        LabelDose{.confusion = 0.1, .confusion_matrix = {{1}}}})
    EXPECT_THROW((void)corrupt_labels(label, table_of(1), dose, 1, 0), Error);
  try {
    (void)corrupt_labels(label, table_of(1), {.islands = -1}, 1, 0);
    FAIL() << "a negative dose passed";
  } catch (const Error& error) {
    EXPECT_STREQ(error.what(),
                 "label fault islands: -1 is out of range; give a number from 0, up to 1");
  }
}

}  // namespace
}  // namespace mapscore::sim
