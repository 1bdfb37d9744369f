// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#include "core/segmentation/edge_aligned/near_holes.hpp"

#include <gtest/gtest.h>

namespace mapscore {
namespace {

/// A wall at 3 m, 80 x 60 pixels, with a hole in it.
cv::Mat1f wall_with(const cv::Rect& hole) {
  cv::Mat1f inverse(60, 80, 1.0F / 3.0F);
  inverse(hole).setTo(0.0F);
  return inverse;
}

bool any_near(const cv::Mat1f& inverse) {
  return cv::countNonZero(near_holes(inverse, 0.6, 0)) > 0;
}

TEST(NearHoles, StandOnTheLowerBorder) {
  const cv::Rect before_the_robot(30, 20, 20, 40);
  const cv::Mat1b near = near_holes(wall_with(before_the_robot), 0.6, 0);
  const cv::Rect middle(34, 24, 12, 36);  // without 4 pixels inside of the hole's edges
  EXPECT_EQ(cv::countNonZero(near), middle.area());
  EXPECT_EQ(cv::countNonZero(near(middle) == kNearHole), middle.area());
}

TEST(NearHoles, AreOpenWhereNothingMayLieBeyondAFloor) {
  cv::Mat1f inverse = wall_with({40, 0, 40, 60});
  const cv::Mat1b open = near_holes(inverse, 0.6, 0);
  EXPECT_EQ(cv::countNonZero(open == kOpenHole), cv::countNonZero(open));
  EXPECT_GT(cv::countNonZero(open), 0);
  inverse.col(39).setTo(1.0F / 0.7F);
  EXPECT_GT(cv::countNonZero(near_holes(inverse, 0.6, 0) == kNearHole), 0)
      << "beside something near";
}

TEST(NearHoles, NothingInRangeBesideTheEndOfAWall) {
  EXPECT_FALSE(any_near(wall_with({40, 0, 40, 30})));
  EXPECT_FALSE(any_near(wall_with({40, 0, 40, 59}))) << "floor below";
}

TEST(NearHoles, ASurfaceWithoutReturnIsNone) {
  EXPECT_FALSE(any_near(wall_with({30, 20, 20, 20})));
}

TEST(NearHoles, ATableThatRunsUnderTheCameraGoesOnInThem) {
  cv::Mat1f inverse = wall_with({30, 20, 20, 20});
  inverse.row(40).setTo(1.0F / 0.7F);
  EXPECT_TRUE(any_near(inverse));
  inverse.row(40).setTo(1.0F / 0.8F);
  EXPECT_FALSE(any_near(inverse));
}

TEST(NearHoles, NarrowOnesAreShadows) {
  EXPECT_FALSE(any_near(wall_with({30, 20, 8, 40})));
  EXPECT_TRUE(any_near(wall_with({30, 20, 9, 40})));
}

/// Something at 0.64 m hides a strip of the wall from a projector beside the camera.
TEST(NearHoles, AProjectorsShadowIsNone) {
  cv::Mat1f inverse = wall_with({20, 10, 30, 50});
  inverse(cv::Rect(50, 10, 30, 50)).setTo(1.0F / 0.64F);
  constexpr double kStep = 1 / 0.64 - 1 / 3.0;
  const auto near = [&](double longest_px) {
    return cv::countNonZero(near_holes(inverse, 0.6, (longest_px - 4) / kStep));
  };
  EXPECT_GT(cv::countNonZero(near_holes(inverse, 0.6, 0)), 500);
  EXPECT_GT(near(29.9), 500);
  EXPECT_EQ(near(30.1), 0);
  inverse(cv::Rect(0, 10, 20, 50)).setTo(0.0F);
  EXPECT_GT(near(80), 500) << "reaches the image's border";
}

}  // namespace
}  // namespace mapscore
