// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#include "sim/faults/depth_geometry.hpp"
#include "sim/faults/depth_noise.hpp"
#include "tests/sim/faults/depth_planes.hpp"

#include <gtest/gtest.h>

#include <algorithm>

namespace mapscore::sim {
namespace {

using mapscore::testing::kCamera;
using mapscore::testing::Moments;
using mapscore::testing::plate_before_wall;
using mapscore::testing::radians;
using mapscore::testing::same_pixels;
using mapscore::testing::TiltedPlane;

TEST(Grazing, LossIsARamp) {
  EXPECT_EQ(grazing_loss({}, radians(69.9)), 0.0);
  EXPECT_NEAR(grazing_loss({}, radians(77.5)), 0.5, 1e-12);
  EXPECT_EQ(grazing_loss({}, radians(86)), 1.0);
}

/// Tilt in degrees, dose.
class Grazing : public ::testing::TestWithParam<std::tuple<double, double>> {};

TEST_P(Grazing, DropsItsShare) {
  const auto [tilt_deg, dose] = GetParam();
  const TiltedPlane plane{1.5, radians(tilt_deg)};
  const cv::Mat1w depth = plane.image(kCamera);
  double expected = 0.0, lost = 0.0;
  for (int frame = 0; frame < 5; ++frame) {
    const cv::Mat1w kept = corrupt_depth(depth, kCamera, {.grazing = dose}, 2, frame);
    for (int v = 0; v < depth.rows; ++v) {
      for (int u = 300; u < 340; ++u) {
        expected += std::min(1.0, dose * grazing_loss({}, plane.incidence_rad(kCamera, u, v)));
        lost += kept(v, u) == 0;
      }
    }
  }
  EXPECT_GT(expected, 5000);
  EXPECT_NEAR(lost, expected, 0.02 * expected);
}

INSTANTIATE_TEST_SUITE_P(Planes, Grazing,
                         ::testing::Values(std::tuple{74.0, 1.0}, std::tuple{77.0, 1.0},
                                           std::tuple{80.0, 1.0}, std::tuple{77.0, 0.5},
                                           std::tuple{77.0, 3.0}));

TEST(Grazing, LeavesSteepPlanesAlone) {
  const cv::Mat1w depth = TiltedPlane{1.5, radians(50)}.image(kCamera);
  const cv::Mat1w kept = corrupt_depth(depth, kCamera, {.grazing = 1}, 2, 0);
  EXPECT_TRUE(same_pixels(kept.colRange(200, 440), depth.colRange(200, 440)));
}

int shadow_px(double near_m, double far_m, double baseline_m) {
  CameraModel camera = kCamera;
  camera.height_px = 4;
  const cv::Mat1w depth = plate_before_wall(camera, 300, 500, near_m, far_m);
  const cv::Mat1b shadow = projector_shadow(metres_of(depth), camera, baseline_m);
  const int width = cv::countNonZero(shadow.row(2));
  EXPECT_EQ(cv::countNonZero(shadow), width * camera.height_px);
  EXPECT_EQ(cv::countNonZero(shadow.row(2).colRange(300 - width, 300)), width)
      << "to the left of the plate";
  return width;
}

TEST(ProjectorShadow, IsAsWideAsTheDisparitySays) {
  for (const double baseline_m : {0.0375, 0.075, 0.15}) {
    double expected = 0.0, found = 0.0;
    for (double near_m = 0.7; near_m < 2.0; near_m += 0.05) {
      for (const double behind_m : {0.5, 1.0, 1.7, 3.1}) {
        const double width =
            kCamera.fx_px * baseline_m * (1.0 / near_m - 1.0 / (near_m + behind_m));
        const int px = shadow_px(near_m, near_m + behind_m, baseline_m);
        EXPECT_NEAR(px, width, 0.65) << near_m << " before " << behind_m;
        expected += width;
        found += px;
      }
    }
    EXPECT_NEAR(found, expected, 0.02 * expected);
  }
}

TEST(ProjectorShadow, OfAPoleStandsByItself) {
  // Disparities of 42.9 / 0.7 and 42.9 / 4 pixels: the shadow of 5 pixels lies 50.6 px to the left.
  const cv::Mat1w depth = plate_before_wall(kCamera, 300, 305, 0.7, 4.0);
  const cv::Mat1b shadow = projector_shadow(metres_of(depth), kCamera, 0.075);
  const double shift = kCamera.fx_px * 0.075 * (1.0 / 0.7 - 1.0 / 4.0);
  const int first = static_cast<int>(std::ceil(299.5 - shift));
  EXPECT_EQ(cv::countNonZero(shadow.row(0)), 5);
  EXPECT_EQ(cv::countNonZero(shadow.row(0).colRange(first, first + 5)), 5);
}

TEST(ProjectorShadow, DoesNotFallOnSmoothSurfaces) {
  for (const double tilt_deg : {0.0, 60.0, -60.0, 80.0}) {
    const cv::Mat1w depth = TiltedPlane{2.0, radians(tilt_deg)}.image(kCamera);
    const cv::Mat1b shadow = projector_shadow(metres_of(depth), kCamera, 0.075);
    EXPECT_EQ(cv::countNonZero(shadow.colRange(250, 390)), 0) << tilt_deg;
  }
}

TEST(ProjectorShadow, TakesTheReturnAndNothingElse) {
  const cv::Mat1w depth = plate_before_wall(kCamera, 300, 500, 1.0, 3.0);
  const cv::Mat1w kept = corrupt_depth(depth, kCamera, {.shadow = 1}, 1, 0);
  cv::Mat1w expected = depth.clone();
  expected.setTo(0, projector_shadow(metres_of(depth), kCamera, 0.075));
  EXPECT_LT(cv::countNonZero(expected), 640 * 480);
  EXPECT_TRUE(same_pixels(kept, expected));
}

class FlyingPixels : public ::testing::TestWithParam<double> {};

TEST_P(FlyingPixels, AreTheirShareOfTheEdgeAndMixBothSides) {
  const double dose = GetParam(), share = std::min(1.0, 0.1 * dose);
  const CameraModel camera = CameraModel::from_hfov(64, 480, radians(6));
  const cv::Mat1w depth = plate_before_wall(camera, 20, 40, 1.0, 3.0);
  Moments mixes;
  double flying = 0.0, edge = 0.0;
  constexpr int kFrames = 150;
  for (int frame = 0; frame < kFrames; ++frame) {
    const cv::Mat1w noisy = corrupt_depth(depth, camera, {.flying = dose}, 6, frame);
    for (const int u : {19, 20, 39, 40}) {
      edge += depth.rows;
      for (int v = 0; v < depth.rows; ++v) {
        if (noisy(v, u) == depth(v, u)) continue;
        ++flying;
        mixes.add((noisy(v, u) - 5000) / 10000.0);
      }
    }
    cv::Mat1w elsewhere = noisy.clone();
    for (const int u : {19, 20, 39, 40}) depth.col(u).copyTo(elsewhere.col(u));
    ASSERT_TRUE(same_pixels(elsewhere, depth));
  }
  EXPECT_NEAR(flying / edge, share, 0.02 * share);
  EXPECT_NEAR(mixes.mean(), 0.5, 0.01);
  EXPECT_NEAR(mixes.sd(), 1.0 / std::sqrt(12.0), 0.02 / std::sqrt(12.0));
}

INSTANTIATE_TEST_SUITE_P(Doses, FlyingPixels, ::testing::Values(1.0, 3.0, 20.0));

TEST(FlyingPixels, NeedAnEdge) {
  const cv::Mat1w depth = TiltedPlane{2.0, radians(60)}.image(kCamera);
  const cv::Mat1w noisy = corrupt_depth(depth, kCamera, {.flying = 10}, 6, 0);
  EXPECT_TRUE(same_pixels(noisy.colRange(250, 390), depth.colRange(250, 390)));
}

}  // namespace
}  // namespace mapscore::sim
