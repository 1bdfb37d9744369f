// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#include "sim/faults/depth_noise.hpp"

#include "core/error.hpp"
#include "sim/faults/depth_geometry.hpp"
#include "tests/sim/faults/depth_planes.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <limits>
#include <set>
#include <tuple>
#include <vector>

namespace mapscore::sim {
namespace {

using mapscore::testing::kCamera;
using mapscore::testing::Moments;
using mapscore::testing::plate_before_wall;
using mapscore::testing::radians;
using mapscore::testing::same_pixels;
using mapscore::testing::TiltedPlane;

cv::Mat1w scene() {
  return plate_before_wall(kCamera, 200, 400, 1.2, 3.0);
}

TEST(DepthNoise, DosesOfZeroReturnTheVeryPixels) {
  const cv::Mat1w depth = scene();
  EXPECT_EQ(corrupt_depth(depth, kCamera, {}, 1, 0).data, depth.data);
  EXPECT_EQ(corrupt_depth(depth, kCamera, DepthDose::of(DepthPreset::ideal), 1, 0).data,
            depth.data);
}

TEST(DepthNoise, LeavesItsInputAlone) {
  const cv::Mat1w depth = scene();
  const cv::Mat1w before = depth.clone();
  const cv::Mat1w noisy = corrupt_depth(depth, kCamera, DepthDose::of(DepthPreset::astra), 1, 0);
  EXPECT_TRUE(same_pixels(depth, before));
  EXPECT_FALSE(same_pixels(noisy, depth));
}

TEST(DepthNoise, IsAFunctionOfSeedAndFrame) {
  const DepthDose astra = DepthDose::of(DepthPreset::astra);
  const cv::Mat1w one = corrupt_depth(scene(), kCamera, astra, 1, 0);
  EXPECT_TRUE(same_pixels(one, corrupt_depth(scene(), kCamera, astra, 1, 0)));
  EXPECT_FALSE(same_pixels(one, corrupt_depth(scene(), kCamera, astra, 2, 0)));
  EXPECT_FALSE(same_pixels(one, corrupt_depth(scene(), kCamera, astra, 1, 1)));
}

TEST(DepthNoise, OneEffectLeavesTheDrawsOfTheOthersAlone) {
  // On a flat wall in range only axial noise changes a pixel, whatever else is on; but for the
  // angle of incidence that a pixel takes from the neighbour it shows.
  const cv::Mat1w wall = TiltedPlane{2.0, 0.0}.image(kCamera);
  const cv::Mat1w alone = corrupt_depth(wall, kCamera, {.axial = 1}, 7, 3);
  DepthDose all{.axial = 1, .grazing = 1, .shadow = 1, .flying = 1, .range = 1};
  EXPECT_TRUE(same_pixels(corrupt_depth(wall, kCamera, all, 7, 3), alone));
  all.lateral = 1;
  cv::Mat1w difference;
  cv::absdiff(corrupt_depth(wall, kCamera, all, 7, 3), alone, difference);
  EXPECT_LE(*std::max_element(difference.begin(), difference.end()), 1);
}

TEST(DepthNoise, DrawsScaleWithTheDose) {
  const cv::Mat1w wall = TiltedPlane{4.0, 0.0}.image(kCamera);
  const cv::Mat1w one = corrupt_depth(wall, kCamera, {.axial = 1}, 7, 3);
  const cv::Mat1w two = corrupt_depth(wall, kCamera, {.axial = 2}, 7, 3);
  for (int v = 0; v < wall.rows; ++v)
    for (int u = 0; u < wall.cols; ++u)
      ASSERT_NEAR(two(v, u) - wall(v, u), 2 * (one(v, u) - wall(v, u)), 2);
}

TEST(DepthNoise, PublishedFormsByHand) {
  EXPECT_NEAR(axial_sigma_m({}, 0.4, 0.0), 0.0012, 1e-12);
  EXPECT_NEAR(axial_sigma_m({}, 2.4, 0.0), 0.0088, 1e-12);
  EXPECT_NEAR(axial_sigma_m({}, 1.0, radians(45)), 0.0012 + 0.0019 * 0.36 + 0.0001, 1e-12);
  EXPECT_NEAR(axial_sigma_m({}, 4.0, radians(60)), 0.0012 + 0.0019 * 12.96 + 0.0002, 1e-12);
  EXPECT_NEAR(lateral_sigma_px({}, 0.0), 0.8, 1e-12);
  EXPECT_NEAR(lateral_sigma_px({}, radians(60)), 0.87, 1e-12);
  EXPECT_EQ(axial_sigma_m({}, 1.0, radians(89)), axial_sigma_m({}, 1.0, radians(85)));
}

/// z, tilt in degrees, dose.
class AxialNoise : public ::testing::TestWithParam<std::tuple<double, double, double>> {};

TEST_P(AxialNoise, HasThePublishedSpread) {
  const auto [z_m, tilt_deg, dose] = GetParam();
  const TiltedPlane plane{z_m, radians(tilt_deg)};
  const cv::Mat1w depth = plane.image(kCamera);
  Moments relative;
  for (int frame = 0; frame < 3; ++frame) {
    const cv::Mat1w noisy = corrupt_depth(depth, kCamera, {.axial = dose}, 11, frame);
    for (int v = 0; v < depth.rows; ++v) {
      for (int u = 280; u < 360; ++u) {
        const double z = depth(v, u) / kDepthUnitsPerMetre;
        const double sigma = dose * axial_sigma_m({}, z, plane.incidence_rad(kCamera, u, v));
        relative.add((noisy(v, u) / kDepthUnitsPerMetre - z) / sigma);
      }
    }
  }
  EXPECT_NEAR(relative.mean(), 0.0, 0.015);
  EXPECT_NEAR(relative.sd(), 1.0, 0.02);
}

INSTANTIATE_TEST_SUITE_P(Planes, AxialNoise,
                         ::testing::Values(std::tuple{0.7, 0.0, 1.0}, std::tuple{1.5, 0.0, 1.0},
                                           std::tuple{3.0, 0.0, 1.0}, std::tuple{7.5, 0.0, 1.0},
                                           std::tuple{3.0, 0.0, 0.5}, std::tuple{2.0, 30.0, 1.0},
                                           std::tuple{1.0, 60.0, 1.0}, std::tuple{2.0, 60.0, 2.0},
                                           std::tuple{1.0, 75.0, 1.0}, std::tuple{2.0, 80.0, 1.0}));

class LateralNoise : public ::testing::TestWithParam<double> {};

TEST_P(LateralNoise, BlursAnEdgeByThePublishedSpread) {
  const double dose = GetParam(), sigma_px = dose * 0.8;
  const CameraModel camera = CameraModel::from_hfov(64, 480, radians(6));
  const cv::Mat1w depth = plate_before_wall(camera, 32, 64, 1.0, 2.0);
  // Share of rows in which the pixel `beyond` the edge shows the other side.
  std::vector<double> crossed(8, 0.0);
  constexpr int kFrames = 60;
  for (int frame = 0; frame < kFrames; ++frame) {
    const cv::Mat1w noisy = corrupt_depth(depth, camera, {.lateral = dose}, 5, frame);
    for (int v = 0; v < depth.rows; ++v)
      for (int beyond = 0; beyond < 8; ++beyond)
        crossed[static_cast<std::size_t>(beyond)] +=
            (noisy(v, 31 - beyond) == 5000) + (noisy(v, 32 + beyond) == 10000);
  }
  double sum = 0.0, expected = 0.0;
  for (int beyond = 0; beyond < 8; ++beyond) {
    const double share = crossed[static_cast<std::size_t>(beyond)] / (2.0 * kFrames * depth.rows);
    const double normal = 0.5 * std::erfc((beyond + 0.5) / sigma_px / std::numbers::sqrt2);
    EXPECT_NEAR(share, normal, 0.006);
    sum += share;
    expected += normal;
  }
  EXPECT_NEAR(sum, expected, 0.02 * expected);
}

TEST_P(LateralNoise, DisplacesBothWaysByThePublishedSpread) {
  const double dose = GetParam(), sigma_px = dose * 0.8;
  // Depth grows by one unit a column, or a row, which tells the pixel that is shown.
  cv::Mat1w by_column(480, 640), by_row(480, 640);
  for (int v = 0; v < 480; ++v) {
    for (int u = 0; u < 640; ++u) by_column(v, u) = static_cast<std::uint16_t>(20000 + u);
    by_row.row(v).setTo(20000 + v);
  }
  Moments columns, rows;
  const cv::Mat1w of_columns = corrupt_depth(by_column, kCamera, {.lateral = dose}, 5, 0);
  const cv::Mat1w of_rows = corrupt_depth(by_row, kCamera, {.lateral = dose}, 5, 0);
  for (int v = 120; v < 360; ++v) {
    for (int u = 220; u < 420; ++u) {
      columns.add(of_columns(v, u) - by_column(v, u));
      rows.add(of_rows(v, u) - by_row(v, u));
    }
  }
  const double rounded_px = std::sqrt(sigma_px * sigma_px + 1.0 / 12.0);
  for (const Moments& moments : {columns, rows}) {
    EXPECT_NEAR(moments.mean(), 0.0, 0.02);
    EXPECT_NEAR(moments.sd(), rounded_px, 0.02 * rounded_px);
  }
}

INSTANTIATE_TEST_SUITE_P(Doses, LateralNoise, ::testing::Values(1.0, 1.5, 2.0));

TEST(Quantisation, StepsAreThoseOfTheDisparity) {
  const TiltedPlane ramp{1.5, radians(70)};
  const cv::Mat1w depth = ramp.image(kCamera);
  const DepthDose dose{.quantisation = 1};
  const cv::Mat1w steps = corrupt_depth(depth, kCamera, dose, 1, 0);
  const double fb_over_step = kCamera.fx_px * 0.075 / 0.125;
  Moments relative;
  for (int u = 0; u < depth.cols; ++u) {
    const double z = depth(0, u) / kDepthUnitsPerMetre;
    if (z < 2.0 || z > 8.0) continue;
    const double error = steps(0, u) / kDepthUnitsPerMetre - z;
    EXPECT_LE(std::abs(error), 0.5 * z * z / (fb_over_step - 0.5 * z) + 0.0002) << z;
    const double disparity = fb_over_step * kDepthUnitsPerMetre / steps(0, u);
    EXPECT_NEAR(disparity, std::round(disparity), 0.02) << z;
  }
  // Over all depths from 2 to 6 m the error is uniform in a step of z^2 / (f b) * 1/8 px.
  cv::Mat1w line(1, 20000);
  for (int u = 0; u < line.cols; ++u) line(0, u) = static_cast<std::uint16_t>(10000 + u);
  CameraModel wide = kCamera;
  wide.width_px = line.cols;
  wide.height_px = 1;
  const cv::Mat1w levels = corrupt_depth(line, wide, dose, 1, 0);
  std::set<int> distinct;
  for (int u = 0; u < line.cols; ++u) {
    const double z = line(0, u) / kDepthUnitsPerMetre;
    distinct.insert(levels(0, u));
    relative.add((levels(0, u) / kDepthUnitsPerMetre - z) / (z * z / fb_over_step));
  }
  EXPECT_NEAR(relative.sd(), 1.0 / std::sqrt(12.0), 0.02 / std::sqrt(12.0));
  const double expected = fb_over_step * (1.0 / 2.0 - 1.0 / 6.0);
  EXPECT_NEAR(static_cast<double>(distinct.size()), expected, 0.02 * expected);
}

TEST(Quantisation, StepGrowsWithTheDose) {
  const cv::Mat1w wall = TiltedPlane{3.0, 0.0}.image(kCamera);
  const double fb = kCamera.fx_px * 0.075;
  for (const double dose : {0.5, 1.0, 4.0}) {
    const cv::Mat1w steps = corrupt_depth(wall, kCamera, {.quantisation = dose}, 1, 0);
    const double step = 0.125 * dose;
    EXPECT_EQ(steps(0, 0), std::lround(5000 * fb / (step * std::round(fb / 3.0 / step))));
  }
}

TEST(Range, DropsWhatWasMeasuredOutOfIt) {
  cv::Mat1w depth = TiltedPlane{3.0, 0.0}.image(kCamera);
  depth.row(0).setTo(2999);
  depth.row(1).setTo(3000);
  depth.row(2).setTo(40000);
  depth.row(3).setTo(40001);
  const cv::Mat1w kept = corrupt_depth(depth, kCamera, {.range = 1}, 1, 0);
  EXPECT_EQ(cv::countNonZero(kept.row(0)), 0);
  EXPECT_EQ(cv::countNonZero(kept.row(3)), 0);
  depth.row(0).setTo(0);
  depth.row(3).setTo(0);
  EXPECT_TRUE(same_pixels(kept, depth));
}

TEST(Range, SharesTheNoiseAndIsDroppedAtItsDose) {
  const cv::Mat1w wall = TiltedPlane{4.0, 0.0}.image(kCamera);
  DepthDose kinect = DepthDose::of(DepthPreset::kinect_v1);
  kinect.quantisation = 0;
  const int all = 640 * 480;
  const auto lost = [&](double range) {
    kinect.range = range;
    return all - cv::countNonZero(corrupt_depth(wall, kCamera, kinect, 1, 0));
  };
  EXPECT_NEAR(lost(1.0), 0.5 * all, 0.02 * 0.5 * all) << "half of the noise lies beyond 4 m";
  EXPECT_NEAR(lost(0.4), 0.2 * all, 0.02 * 0.2 * all);
}

TEST(DepthGeometry, AnglesOfAPlane) {
  for (const double tilt_deg : {0.0, 40.0, 75.0, -60.0}) {
    const TiltedPlane plane{2.0, radians(tilt_deg)};
    const cv::Mat1w depth = plane.image(kCamera);
    const cv::Mat1f angles = incidence_angles(metres_of(depth), kCamera);
    for (int v = 0; v < depth.rows; v += 7)
      for (int u = 250; u < 390; u += 3)
        ASSERT_NEAR(angles(v, u), plane.incidence_rad(kCamera, u, v), radians(2.5))
            << tilt_deg << " at " << u << ", " << v;
  }
}

TEST(DepthGeometry, ALowStepIsNoSteepSurface) {
  const cv::Mat1w depth = plate_before_wall(kCamera, 200, 400, 2.0, 2.03);
  const cv::Mat1f angles = incidence_angles(metres_of(depth), kCamera);
  for (const int u : {198, 199, 200, 201, 398, 399, 400, 401})
    EXPECT_NEAR(angles(240, u), std::atan(std::abs(u - 319.5) / kCamera.fx_px), 1e-3) << u;
}

TEST(DepthGeometry, AnglesBesideAnEdgeAreThoseOfTheirOwnSide) {
  const cv::Mat1f angles = incidence_angles(metres_of(scene()), kCamera);
  for (const int u : {199, 200, 399, 400})
    EXPECT_NEAR(angles(240, u), std::atan(std::abs(u - 319.5) / kCamera.fx_px), 1e-3);
}

TEST(DepthDose, BadInputIsRefused) {
  const cv::Mat1w depth = scene();
  const double nan = std::numeric_limits<double>::quiet_NaN();
  for (const DepthDose& dose :
       {DepthDose{.axial = -1}, DepthDose{.lateral = nan}, DepthDose{.shadow = -0.1},
        DepthDose{.axial = 1, .baseline_m = 0}, DepthDose{.subpixel_px = -1},
        DepthDose{.range_min_m = 3, .range_max_m = 2},
        DepthDose{.grazing_from_deg = {60}, .grazing_to_deg = {60}}})
    EXPECT_THROW((void)corrupt_depth(depth, kCamera, dose, 1, 0), Error);
  CameraModel other = kCamera;
  other.width_px = 320;
  EXPECT_THROW((void)corrupt_depth(depth, other, {}, 1, 0), Error);
  try {
    check(DepthDose{.flying = -2});
    FAIL() << "a negative dose passed";
  } catch (const Error& error) {
    EXPECT_STREQ(error.what(),
                 "depth fault flying: -2 is out of range; give a number from 0, up to 100");
  }
}

TEST(DepthPresets, AreTheDevices) {
  EXPECT_TRUE(is_zero(DepthDose::of(DepthPreset::ideal)));
  const DepthDose astra = DepthDose::of(DepthPreset::astra);
  EXPECT_EQ(astra.range_min_m, 0.6);
  EXPECT_EQ(astra.range_max_m, 8.0);
  const DepthDose kinect = DepthDose::of(DepthPreset::kinect_v1);
  EXPECT_EQ(kinect.range_min_m, 0.8);
  EXPECT_EQ(kinect.range_max_m, 4.0);
  for (const DepthDose& dose : {astra, kinect})
    for (const double one : {dose.axial, dose.lateral, dose.quantisation, dose.grazing, dose.shadow,
                             dose.flying, dose.range})
      EXPECT_EQ(one, 1.0);
}

}  // namespace
}  // namespace mapscore::sim
