// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#include "core/segmentation/edge_aligned/edge_matching.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace mapscore {
namespace {

constexpr double kCoarse = 0.05;  // a step straight on counts as 0.955 px

/// Two masks: columns 10 to 29, and from `gap` columns later on up to 49.
OutlineField two_masks(int gap) {
  std::vector<Detection> detections(2);
  const int begin[]{10, 30 + gap}, end[]{30, 50};
  for (std::size_t n = 0; n < 2; ++n) {
    detections[n].box = {begin[n], 5, end[n] - 1, 34};
    detections[n].mask = cv::Mat1b(30, end[n] - begin[n], std::uint8_t{255});
  }
  return outline_field(detections, 60, 40, 60);
}

EdgeMatch match(const OutlineField& field, float u, float outward, float offset_px = 0,
                float against = 0.7F) {
  return match_edge(field, {u, 20.3F, outward, 0, 1}, {offset_px, 2, against});
}

TEST(EdgeMatching, APartOfAWeightIsItsExponential) {
  for (double x = -4.5; x <= 0; x += 0.01) {
    const double part = static_cast<double>(exp_of_part(static_cast<float>(x)));
    EXPECT_NEAR(part, std::exp(x), 2e-5 * std::exp(x)) << x;
  }
}

TEST(EdgeMatching, AnImageOfOneRowHasNoMatches) {
  std::vector<Detection> one(1);
  one[0].box = {2, 0, 5, 0};
  one[0].mask = cv::Mat1b(1, 4, std::uint8_t{255});
  EXPECT_EQ(match_edge(outline_field(one, 10, 1, 20), {1.5F, 0, -1, 0, 1}, {0, 2}).weight, 0);
}

/// An edge on the border of two masks ends one of them: it counts fully, whichever way it faces.
TEST(EdgeMatching, AnEdgeOnABorderOfTwoMasksCountsFully) {
  const OutlineField field = two_masks(0);
  ASSERT_NE(border_of(field.distance(20, 29)), kNoBorder);
  for (const float outward : {1.0F, -1.0F}) {
    const EdgeMatch on = match(field, 29.5F, outward);
    EXPECT_NEAR(on.weight, 1, 1e-4);
    EXPECT_NEAR(on.residual, 0, 1e-4);
    EXPECT_NEAR(on.facing, 1, 1e-4);
    EXPECT_TRUE(on.at_border);
  }
}

/// Left and right of the border the distance goes on: how far beyond the object that ends there.
TEST(EdgeMatching, DistanceIsThatFromTheNearerObjectOnBothSides) {
  const OutlineField field = two_masks(0);
  for (const float beyond : {-3.2F, -1.1F, -0.4F, 0.3F, 1.2F, 3.1F}) {
    const EdgeMatch right = match(field, 29.5F + beyond, 1);
    EXPECT_NEAR(right.residual, beyond, kCoarse * std::abs(beyond) + 0.01) << beyond;
    EXPECT_NEAR(right.slope_u, 1, kCoarse) << beyond;
    EXPECT_NEAR(right.weight, std::exp(-beyond * beyond / 8), kCoarse) << beyond;
    const EdgeMatch left = match(field, 29.5F - beyond, -1);
    EXPECT_NEAR(left.residual, beyond, kCoarse * std::abs(beyond) + 0.01) << beyond;
    EXPECT_NEAR(left.slope_u, -1, kCoarse) << beyond;
  }
}

/// Masks that are too large or too small share their border all the same.
TEST(EdgeMatching, ABorderOfTwoMasksDoesNotMoveWithTheirSize) {
  const OutlineField field = two_masks(0);
  for (const float offset_px : {-3.0F, 2.0F}) {
    EXPECT_NEAR(match(field, 29.5F, 1, offset_px).residual, 0, 1e-4);
    EXPECT_NEAR(match(field, 49.5F, 1, offset_px).residual, -offset_px, kCoarse);
    EXPECT_FALSE(match(field, 49.5F, 1, offset_px).at_border);
  }
}

/// Objects that touch have masks with a groove between where both are too small.
TEST(EdgeMatching, TheMiddleOfAGrooveIsABorder) {
  const OutlineField field = two_masks(4);
  for (const float outward : {1.0F, -1.0F}) {
    const EdgeMatch on = match(field, 31.5F, outward);
    EXPECT_NEAR(on.weight, 1, 1e-4);
    EXPECT_NEAR(on.residual, 0, 1e-4);
    EXPECT_TRUE(on.at_border);
  }
  EXPECT_FALSE(match(two_masks(6), 32.5F, 1).at_border);
}

/// Beside an outline that is no border, what faces against it counts as the caller has it.
TEST(EdgeMatching, AgainstAnOutlineCountsLess) {
  const OutlineField field = two_masks(6);
  ASSERT_TRUE(std::ranges::none_of(field.distance, border_of));
  EXPECT_NEAR(match(field, 29.5F, 1).weight, 1, kCoarse);
  EXPECT_NEAR(match(field, 29.5F, -1).weight, 0.7, kCoarse);
  EXPECT_EQ(match(field, 29.5F, -1, 0, 0).weight, 0);
  EXPECT_EQ(match(field, 20.0F, 1).weight, 0) << "too far";
}

}  // namespace
}  // namespace mapscore
