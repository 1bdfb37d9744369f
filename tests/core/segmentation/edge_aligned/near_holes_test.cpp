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
  return cv::countNonZero(near_holes(inverse, 0.6)) > 0;
}

TEST(NearHoles, StandOnTheLowerBorder) {
  const cv::Rect before_the_robot(30, 20, 20, 40);
  const cv::Mat1b near = near_holes(wall_with(before_the_robot), 0.6);
  ASSERT_EQ(near.size(), cv::Size(40, 30));
  const cv::Rect middle(17, 12, 6, 18);  // cells, without 2 inside of the hole's edges
  EXPECT_EQ(cv::countNonZero(near), middle.area());
  EXPECT_EQ(cv::countNonZero(near(middle) == kNearHole), middle.area());
}

TEST(NearHoles, AreOpenWhereNothingMayLieBeyondAFloor) {
  cv::Mat1f inverse = wall_with({40, 0, 40, 60});
  const cv::Mat1b open = near_holes(inverse, 0.6);
  EXPECT_EQ(cv::countNonZero(open == kOpenHole), cv::countNonZero(open));
  EXPECT_GT(cv::countNonZero(open), 0);
  inverse.col(39).setTo(1.0F / 0.7F);
  EXPECT_GT(cv::countNonZero(near_holes(inverse, 0.6) == kNearHole), 0) << "beside something near";
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
  EXPECT_FALSE(any_near(wall_with({30, 20, 9, 40})));
  EXPECT_TRUE(any_near(wall_with({30, 20, 10, 40})));
}

/// The last column and the last row of such an image are cells as well.
TEST(NearHoles, AreFoundInImagesOfOddSize) {
  cv::Mat1f inverse(61, 81, 1.0F / 3.0F);
  inverse(cv::Rect(60, 30, 21, 31)).setTo(0.0F);
  const cv::Mat1b near = near_holes(inverse, 0.6);
  ASSERT_EQ(near.size(), cv::Size(41, 31));
  EXPECT_EQ(near(30, 40), kNearHole);
  inverse(60, 80) = 1.0F / 3.0F;
  EXPECT_EQ(near_holes(inverse, 0.6)(30, 40), 0);
}

}  // namespace
}  // namespace mapscore
