// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#include "core/segmentation/registered_cloud.hpp"

#include "core/error.hpp"
#include "core/random_stream.hpp"
#include "plain_registration.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace mapscore {
namespace {

constexpr int kNone = RegisteredCloud::kNone;

/// Two equal cameras of 8 x 6 pixels, f = 10, at one place; range 0.1 to 10 m.
Calibration small_pair() {
  Calibration pair;
  pair.color = pair.depth = CameraModel{8, 6, 10, 10, 3.5, 2.5};
  pair.range_min_m = 0.1;
  pair.range_max_m = 10;
  return pair;
}

cv::Mat1w flat(const CameraModel& camera, double z_m) {
  return cv::Mat1w(camera.height_px, camera.width_px,
                   static_cast<std::uint16_t>(std::lround(z_m * kDepthUnitsPerMetre)));
}

bool equal_sources(const cv::Mat1i& a, const cv::Mat1i& b) {
  return a.size() == b.size() && cv::countNonZero(a != b) == 0;
}

TEST(RegisteredCloud, EqualCamerasSeeTheSamePixels) {
  const Calibration pair = small_pair();
  const RegisteredCloud cloud = register_depth(flat(pair.depth, 2.0), pair);
  for (int v = 0; v < 6; ++v)
    for (int u = 0; u < 8; ++u) EXPECT_EQ(cloud.source(u, v), 8 * v + u);
}

TEST(RegisteredCloud, PointKeepsTheDepthCamerasCoordinates) {
  Calibration pair = small_pair();
  pair.T_color_depth.translation().x() = 0.4;  // at 2 m: two columns to the right
  const RegisteredCloud cloud = register_depth(flat(pair.depth, 2.0), pair);
  EXPECT_EQ(cloud.source(5, 1), 8 * 1 + 3);
  EXPECT_EQ(cloud.point(cloud.source(5, 1)), pair.depth.back_project(3, 1, 2.0));
}

TEST(RegisteredCloud, ShiftOfACamera_MovesAParallelPlaneByFTimesShiftOverZ) {
  Calibration pair = small_pair();
  pair.T_color_depth.translation() = Eigen::Vector3d(0.4, -0.2, 0.0);
  const RegisteredCloud cloud = register_depth(flat(pair.depth, 2.0), pair);
  for (int v = 0; v < 6; ++v)
    for (int u = 0; u < 8; ++u)
      EXPECT_EQ(cloud.source(u, v), u < 2 || v > 4 ? kNone : 8 * (v + 1) + u - 2) << u << ' ' << v;
}

TEST(RegisteredCloud, NearSurfaceOccludesTheFarOneAndUncoversAGap) {
  Calibration pair = small_pair();
  pair.T_color_depth.translation().x() = 0.4;  // four columns at 1 m, one at 4 m
  cv::Mat1w depth = flat(pair.depth, 4.0);
  depth(cv::Rect(1, 0, 2, 6)) = 5000;  // near columns 1 and 2 arrive in 5 and 6
  const RegisteredCloud cloud = register_depth(depth, pair);
  const int expected[8] = {kNone, 0, kNone, kNone, 3, 1, 2, 6};
  for (int u = 0; u < 8; ++u) EXPECT_EQ(cloud.source(u, 0), expected[u]) << u;
}

TEST(RegisteredCloud, CloseSurfaceLeavesNoPinholes) {
  Calibration pair = small_pair();
  pair.color.fx_px = pair.color.fy_px = 20;  // a depth pixel covers two by two colour pixels
  const RegisteredCloud cloud = register_depth(flat(pair.depth, 1.0), pair);
  EXPECT_EQ(cv::countNonZero(cloud.sources() == kNone), 0);
}

TEST(RegisteredCloud, CoverIsClosedAndTiesGoToTheLowerRowThenColumn) {
  Calibration pair = small_pair();
  pair.color.cx_px += 0.5;  // every projection falls half-way between two columns
  pair.color.cy_px += 0.5;
  const RegisteredCloud cloud = register_depth(flat(pair.depth, 2.0), pair);
  EXPECT_EQ(cloud.source(0, 0), 0);          // covered by depth pixel (0, 0) alone
  EXPECT_EQ(cloud.source(1, 0), 0);          // by (0, 0) and (1, 0): lower column
  EXPECT_EQ(cloud.source(4, 3), 8 * 2 + 3);  // by four: lower row, then lower column
}

TEST(RegisteredCloud, NearerOfTwoWinsWhateverTheirOrder) {
  Calibration pair = small_pair();
  pair.color.cx_px += 0.5;
  cv::Mat1w depth = flat(pair.depth, 2.0);
  depth(2, 4) = 9999;
  EXPECT_EQ(register_depth(depth, pair).source(4, 2), 8 * 2 + 4);
  depth(2, 4) = 10001;
  EXPECT_EQ(register_depth(depth, pair).source(4, 2), 8 * 2 + 3);
}

TEST(RegisteredCloud, RangeIncludesItsLimitsAndZeroIsNoDepth) {
  Calibration pair = small_pair();
  pair.range_min_m = 0.6;
  pair.range_max_m = 8.0;
  cv::Mat1w depth(6, 8, std::uint16_t{0});
  depth(0, 0) = 2999;
  depth(0, 1) = 3000;
  depth(0, 2) = 40000;
  depth(0, 3) = 40001;
  const RegisteredCloud cloud = register_depth(depth, pair);
  EXPECT_EQ(cloud.source(0, 0), kNone);
  EXPECT_EQ(cloud.source(1, 0), 1);
  EXPECT_EQ(cloud.source(2, 0), 2);
  EXPECT_EQ(cloud.source(3, 0), kNone);
  EXPECT_EQ(cv::countNonZero(cloud.sources() != kNone), 2);
}

TEST(RegisteredCloud, PointsBehindTheColourCameraAreNotSeen) {
  Calibration pair = small_pair();
  pair.T_color_depth.translation().z() = -2.0;
  EXPECT_EQ(cv::countNonZero(register_depth(flat(pair.depth, 1.0), pair).sources() != kNone), 0);
  EXPECT_EQ(cv::countNonZero(register_depth(flat(pair.depth, 2.0), pair).sources() != kNone), 0);
}

TEST(RegisteredCloud, RefusesImagesOfAnotherSize) {
  const Calibration pair = small_pair();
  EXPECT_THROW((void)register_depth(cv::Mat1w(5, 8), pair), Error);
  EXPECT_THROW((void)register_depth(flat(pair.depth, 1.0), pair, cv::Mat1b(6, 7)), Error);
}

/// Random scenes: steps in depth, holes, cameras apart, turned and of other focal length.
class RandomRegistration : public ::testing::TestWithParam<int> {
 protected:
  RandomRegistration() : stream_(7, "registration test", {static_cast<std::uint64_t>(GetParam())}) {
    const double zoom = GetParam() >= 30 ? 6 : 1;  // a depth pixel covers many colour pixels
    pair_.color = CameraModel{50,
                              40,
                              zoom * (45 + 30 * stream_.uniform()),
                              zoom * (45 + 30 * stream_.uniform()),
                              24.5 + stream_.normal(),
                              19.5 + stream_.normal()};
    pair_.depth = CameraModel{48, 36, 50, 52, 23.5, 17.5};
    const bool turned = GetParam() % 2 == 1;
    Vector6 xi;
    for (int i = 0; i < 6; ++i) xi[i] = i < 3 || turned ? 0.05 * stream_.normal() : 0.0;
    pair_.T_color_depth = exp_pose(xi);
    pair_.range_min_m = 0.2;
    depth_.create(36, 48);
    for (int v = 0; v < 36; ++v)
      for (int u = 0; u < 48; ++u)
        depth_(v, u) = static_cast<std::uint16_t>(
            stream_.uniform() < 0.1 ? 0
                                    : (u / 9 + v / 7) % 3 * 4000 + 800 + 40 * stream_.uniform());
  }

  RandomStream stream_;
  Calibration pair_;
  cv::Mat1w depth_;
};

TEST_P(RandomRegistration, EqualsThePlainForm) {
  EXPECT_TRUE(equal_sources(register_depth(depth_, pair_).sources(),
                            testing::register_plain(depth_, pair_)));
}

TEST_P(RandomRegistration, MaskChangesNothingWherePixelsMatter) {
  cv::Mat1b wanted(40, 50, std::uint8_t{0});
  for (std::uint8_t& pixel : wanted) pixel = stream_.uniform() < 0.3 ? 255 : 0;
  const cv::Mat1i full = register_depth(depth_, pair_).sources();
  const cv::Mat1i masked = register_depth(depth_, pair_, wanted).sources();
  cv::Mat1i expected(40, 50, kNone);
  full.copyTo(expected, wanted);
  EXPECT_TRUE(equal_sources(masked, expected));
}

/// Wanted pixels that lie together, so that most depth pixels can be left out.
TEST_P(RandomRegistration, SmallMasksChangeNothingWherePixelsMatter) {
  const cv::Mat1i full = register_depth(depth_, pair_).sources();
  for (int n = 0; n < 50; ++n) {
    cv::Mat1b wanted(40, 50, std::uint8_t{0});
    for (int blob = 0; blob < 1 + n % 3; ++blob) {
      const auto below = [&](double size) { return static_cast<int>(size * stream_.uniform()); };
      const int u = below(50), v = below(40);
      wanted(cv::Rect(u, v, 1 + below(std::min(8, 49 - u)), 1 + below(std::min(12, 39 - v)))) = 1;
    }
    cv::Mat1i expected(40, 50, kNone);
    full.copyTo(expected, wanted);
    EXPECT_TRUE(equal_sources(register_depth(depth_, pair_, wanted).sources(), expected)) << n;
  }
}

TEST_P(RandomRegistration, NothingWantedGivesNothing) {
  const cv::Mat1b wanted(40, 50, std::uint8_t{0});
  EXPECT_EQ(cv::countNonZero(register_depth(depth_, pair_, wanted).sources() != kNone), 0);
}

INSTANTIATE_TEST_SUITE_P(Scenes, RandomRegistration, ::testing::Range(0, 40));

}  // namespace
}  // namespace mapscore
