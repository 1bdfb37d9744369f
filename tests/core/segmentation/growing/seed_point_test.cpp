// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#include "core/segmentation/growing/seed_point.hpp"

#include "core/segmentation/segmentation.hpp"

#include <gtest/gtest.h>

namespace mapscore {
namespace {

constexpr std::uint16_t kObject = 10000, kBehind = 15000;  // 2 m and 3 m

/// Equal cameras of 21 x 17 pixels that see a wall at 3 m; `label` is what the colour camera sees.
struct MaskedScene {
  Calibration pair;
  cv::Mat1w depth = cv::Mat1w(17, 21, kBehind);
  cv::Mat1w label = cv::Mat1w(17, 21, std::uint16_t{0});

  MaskedScene() { pair.color = pair.depth = CameraModel{21, 17, 400, 400, 10, 8}; }

  /// Part of the object, and the surface behind it where `value` says so.
  void mark(const cv::Rect& pixels, std::uint16_t value = kObject) {
    label(pixels) = 1;
    depth(pixels) = value;
  }
  void hole(const cv::Rect& pixels) {
    label(pixels) = 0;
    depth(pixels) = kBehind;
  }
  [[nodiscard]] Detection detection() const {
    ClassTable table;
    table.classes.push_back({1, "thing", {}, true});
    table.instances.push_back({1, "thing_1", 1});
    return detections_of(label, table).at(0);
  }
  [[nodiscard]] std::optional<Eigen::Vector3d> seed(SeedRule rule) const {
    return seed_point(detection(), register_depth(depth, pair), rule);
  }
  [[nodiscard]] Segment grown(SeedRule rule) const {
    return segment(detection(), register_depth(depth, pair), 0.05, RegionGrowing{.seed = rule},
                   false);
  }
  [[nodiscard]] Eigen::Vector3d point(int u, int v) const {
    return pair.depth.back_project(u, v, depth(v, u) / kDepthUnitsPerMetre);
  }
};

constexpr SeedRule kRobust[]{SeedRule::largest_piece, SeedRule::depth_mode};

TEST(SeedPoint, RobustRulesSurviveAHoleInTheMiddle) {
  MaskedScene ring;
  ring.mark({2, 2, 15, 13});
  ring.hole({7, 6, 5, 5});  // the box's middle, (9, 8), lies on the wall
  EXPECT_EQ(ring.grown(SeedRule::box_centre).skipped, SkipReason::seed_off_object);
  for (const SeedRule rule : kRobust) {
    EXPECT_EQ(ring.grown(rule).skipped, SkipReason::none);
    EXPECT_EQ(ring.grown(rule).points.size(), 15u * 13u - 25u);
  }
}

/// Legs, seat and back of a chair seen from the side: its box's middle lies between the legs.
TEST(SeedPoint, RobustRulesSurviveACentreOnTheBackground) {
  MaskedScene chair;
  chair.mark({2, 1, 2, 15});
  chair.mark({2, 6, 13, 2});
  chair.mark({13, 6, 2, 10});
  EXPECT_NE(chair.grown(SeedRule::box_centre).skipped, SkipReason::none);
  for (const SeedRule rule : kRobust) EXPECT_EQ(chair.grown(rule).points.size(), 30u + 22u + 16u);
}

TEST(SeedPoint, RobustRulesStartOnTheObjectWhereTheMaskLeaksInTheMiddle) {
  MaskedScene leak;
  leak.mark({2, 2, 15, 13});
  leak.depth(cv::Rect(8, 7, 3, 3)) = kBehind;  // seen through the object, and inside its mask
  EXPECT_DOUBLE_EQ(leak.seed(SeedRule::box_centre)->z(), 3.0);
  EXPECT_DOUBLE_EQ(leak.seed(SeedRule::mask_centroid)->z(), 3.0);
  EXPECT_DOUBLE_EQ(leak.seed(SeedRule::largest_piece)->z(), 2.0);
  EXPECT_DOUBLE_EQ(leak.seed(SeedRule::depth_mode)->z(), 2.0);
}

TEST(SeedPoint, LargestPieceTakesThePixelNearestToItsOwnCentroid) {
  MaskedScene scene;
  scene.mark({2, 2, 5, 5});               // 25 pixels, centre (4, 4)
  scene.mark({7, 2, 4, 5}, 11000);        // 20 pixels, 10 % farther: another piece
  scene.mark({14, 10, 3, 8 - 1}, 10000);  // 21 pixels, not connected in the mask
  EXPECT_EQ(scene.seed(SeedRule::largest_piece), scene.point(4, 4));
}

TEST(SeedPoint, PiecesJoinUpToTheStepAndOnlyBySides) {
  MaskedScene scene;
  scene.mark({2, 2, 3, 3}, 10000);
  scene.mark({5, 2, 3, 3}, 10299);  // not quite 3 % farther: the same piece
  EXPECT_EQ(scene.seed(SeedRule::largest_piece), scene.point(4, 3));  // centroid (4.5, 3)
  scene.depth(cv::Rect(5, 2, 3, 3)) = 10301;  // 9 pixels each: the first one
  EXPECT_EQ(scene.seed(SeedRule::largest_piece), scene.point(3, 3));
  scene.mark({8, 5, 1, 1}, 10301);  // touches the second by a corner alone
  EXPECT_EQ(scene.seed(SeedRule::largest_piece), scene.point(3, 3));
  scene.mark({5, 5, 1, 1}, 10301);  // 10 pixels
  EXPECT_DOUBLE_EQ(scene.seed(SeedRule::largest_piece)->z(), 2.0602);
}

/// A thick part of 9 x 9 and a thin one of 6 x 2 px: most of the axis' weight is the
/// former's.
TEST(SeedPoint, DepthModeTakesTheDeepestPixelOfTheWeightiestDepth) {
  MaskedScene scene;
  scene.mark({1, 1, 9, 9}, 10000);
  scene.mark({10, 4, 6, 2}, 14000);
  EXPECT_EQ(scene.seed(SeedRule::depth_mode), scene.point(5, 5));
  scene.depth(5, 5) = 0;  // no point there: the next one of the square's diagonals
  EXPECT_EQ(scene.seed(SeedRule::depth_mode), scene.point(4, 4));
}

TEST(SeedPoint, DepthModeOfAMaskThatFillsTheImageIsItsFirstPixel) {
  MaskedScene scene;
  scene.mark({0, 0, 21, 17});
  EXPECT_EQ(scene.seed(SeedRule::depth_mode), scene.point(0, 0));
}

TEST(SeedPoint, OnePixelIsItsOwnSeed) {
  MaskedScene scene;
  scene.mark({4, 3, 1, 1});
  for (const SeedRule rule : {SeedRule::box_centre, SeedRule::mask_centroid,
                              SeedRule::largest_piece, SeedRule::depth_mode})
    EXPECT_EQ(scene.seed(rule), scene.point(4, 3));
}

TEST(SeedPoint, NoDepthNoSeed) {
  MaskedScene scene;
  scene.mark({2, 2, 5, 5}, 0);
  for (const SeedRule rule : {SeedRule::box_centre, SeedRule::mask_centroid,
                              SeedRule::largest_piece, SeedRule::depth_mode})
    EXPECT_FALSE(scene.seed(rule));
}

}  // namespace
}  // namespace mapscore
