// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#include "core/segmentation/edge_aligned/settled_depth.hpp"

#include "core/random_stream.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace mapscore {
namespace {

constexpr float kNoise = 0.002F;

/// A slanted plane with noise, its left half label 1, the right label 2.
struct Slant {
  DepthEdges edges;
  cv::Mat1w labels = cv::Mat1w(60, 80);

  /// `steepness`: how often as steep it is as it would be by default.
  static float truth(int v, int u, float steepness = 1.0F) {
    return 0.4F + steepness * (0.0003F * static_cast<float>(u) - 0.0002F * static_cast<float>(v));
  }

  explicit Slant(float noise, float steepness = 1.0F) {
    RandomStream random(7, "test", {});
    edges.noise = noise;
    edges.inverse_depth = cv::Mat1f(60, 80);
    for (int v = 0; v < 60; ++v)
      for (int u = 0; u < 80; ++u) {
        edges.inverse_depth(v, u) =
            truth(v, u, steepness) + noise * static_cast<float>(random.normal());
        labels(v, u) = u < 40 ? 1 : 2;
      }
  }
};

TEST(SettledDepth, AsksForNoise) {
  EXPECT_FALSE(is_noisy(Slant(0.0F).edges));
  EXPECT_FALSE(is_noisy(Slant(0.0002F).edges));
  EXPECT_TRUE(is_noisy(Slant(kNoise).edges));
}

TEST(SettledDepth, PlaneIsRestoredWithinATenthOfTheNoise) {
  Slant slant(kNoise);
  const cv::Mat1f settled = settle_on_surfaces(slant.edges, slant.labels);
  double inside = 0, all = 0;
  for (int v = 0; v < 60; ++v)
    for (int u = 0; u < 80; ++u) {
      const double error = settled(v, u) - Slant::truth(v, u);
      all += error * error;
      if (v >= 4 && v < 56 && u >= 4 && u < 36) inside += error * error;
    }
  EXPECT_EQ(cv::countNonZero(slant.labels), 60 * 80);
  EXPECT_LT(std::sqrt(inside / (52 * 32)), 0.1 * kNoise);
  EXPECT_LT(std::sqrt(all / (60 * 80)), 0.25 * kNoise);
}

TEST(SettledDepth, PixelsOnNoSurfaceAreDropped) {
  Slant slant(kNoise);
  for (const cv::Point& at : {cv::Point(20, 20), cv::Point(21, 20), cv::Point(0, 0)})
    slant.edges.inverse_depth(at) = 0.2F;
  const cv::Mat1f settled = settle_on_surfaces(slant.edges, slant.labels);
  EXPECT_EQ(cv::countNonZero(slant.labels), 60 * 80 - 3);
  EXPECT_EQ(slant.labels(20, 20), 0);
  EXPECT_EQ(slant.labels(20, 21), 0);
  EXPECT_EQ(slant.labels(0, 0), 0);
  EXPECT_EQ(settled(20, 21), 0.0F);
}

/// A table top seen at a slant: 1/z rises by two sigma from pixel to pixel.
TEST(SettledDepth, SteepSurfacesStay) {
  constexpr float kSteepness = 15.0F;
  constexpr float kNearer = 0.4F;  // far corners would be uncertain
  Slant slant(kNoise, kSteepness);
  slant.edges.inverse_depth += kNearer;
  slant.edges.inverse_depth(20, 20) = 0.2F;
  const cv::Mat1f settled = settle_on_surfaces(slant.edges, slant.labels);
  EXPECT_EQ(slant.labels(20, 20), 0) << "it flies";
  EXPECT_EQ(cv::countNonZero(slant.labels), 60 * 80 - 1);
  double squares = 0;
  for (int v = 4; v < 56; ++v)
    for (int u = 44; u < 76; ++u)
      squares += std::pow(settled(v, u) - kNearer - Slant::truth(v, u, kSteepness), 2);
  EXPECT_LT(std::sqrt(squares / (52 * 32)), 0.25 * kNoise);
}

TEST(SettledDepth, OtherLabelsDoNotTakePart) {
  Slant slant(kNoise);
  for (int v = 0; v < 60; ++v)
    for (int u = 40; u < 80; ++u) slant.edges.inverse_depth(v, u) += 3 * kNoise;
  cv::Mat1w left_labels = slant.labels.clone();
  left_labels(cv::Rect(40, 0, 40, 60)) = 0;
  const cv::Mat1f both = settle_on_surfaces(slant.edges, slant.labels);
  const cv::Mat1f left = settle_on_surfaces(slant.edges, left_labels);
  EXPECT_EQ(cv::countNonZero(both(cv::Rect(0, 0, 40, 60)) != left(cv::Rect(0, 0, 40, 60))), 0);
  EXPECT_EQ(cv::countNonZero(left(cv::Rect(40, 0, 40, 60))), 0);
}

/// At about 5 m a pixel is 5 cm off by chance. A plane at the middle of its window is known to a
/// ninth of that, at a label's corner, which fewer pixels tell and from one side, to half.
TEST(SettledDepth, PixelsOfUncertainDepthAreDropped) {
  Slant slant(kNoise);
  slant.edges.inverse_depth -= 0.2F;
  const cv::Mat1f settled = settle_on_surfaces(slant.edges, slant.labels);
  EXPECT_EQ(slant.labels(0, 0), 0);
  EXPECT_EQ(settled(0, 0), 0.0F);
  EXPECT_EQ(slant.labels(59, 79), 0);
  EXPECT_EQ(cv::countNonZero(slant.labels(cv::Rect(4, 4, 32, 52))), 32 * 52);
  EXPECT_EQ(cv::countNonZero(slant.labels), cv::countNonZero(settled));
}

/// At 4 m five sigma of 1/z are 16 cm. The first plane joins what lies that far apart, the second
/// tells it apart again.
TEST(SettledDepth, SurfacesFarAwayAreToldApart) {
  RandomStream random(8, "test", {});
  DepthEdges edges;
  edges.noise = kNoise;
  edges.inverse_depth = cv::Mat1f(60, 80);
  const auto truth = [](int u) { return u < 40 ? 0.25F : 0.25F + 5 * kNoise; };
  for (int v = 0; v < 60; ++v)
    for (int u = 0; u < 80; ++u)
      edges.inverse_depth(v, u) = truth(u) + kNoise * static_cast<float>(random.normal());
  cv::Mat1w labels(60, 80, std::uint16_t{1});
  const cv::Mat1f settled = settle_on_surfaces(edges, labels);
  int between = 0;
  for (int v = 0; v < 60; ++v)
    for (int u = 32; u < 48; ++u)
      between += settled(v, u) > 0 && std::abs(settled(v, u) - truth(u)) > kNoise;
  EXPECT_LT(between, 140);
}

/// A bar of 2 pixels, as a chair's leg; and a line of 1.
TEST(SettledDepth, ThinPartsStay) {
  Slant slant(kNoise);
  slant.labels = 0;
  slant.labels(cv::Rect(30, 10, 2, 40)) = 3;
  slant.labels(cv::Rect(50, 10, 1, 40)) = 4;
  const cv::Mat1f settled = settle_on_surfaces(slant.edges, slant.labels);
  EXPECT_EQ(cv::countNonZero(slant.labels), 3 * 40);
  for (int v = 10; v < 50; ++v) EXPECT_NEAR(settled(v, 30), Slant::truth(v, 30), 3 * kNoise);
}

}  // namespace
}  // namespace mapscore
