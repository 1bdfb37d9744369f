// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#include "core/segmentation/edge_aligned/edge_aligned.hpp"

#include "core/error.hpp"
#include "core/segmentation/edge_aligned/outline_alignment.hpp"
#include "core/segmentation/edge_aligned/outline_shifts.hpp"
#include "core/segmentation/segmentation.hpp"
#include "plate_scene.hpp"

#include <gtest/gtest.h>
#include <opencv2/imgproc.hpp>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <numbers>
#include <optional>
#include <vector>

namespace mapscore {
namespace {

using namespace mapscore::testing;

/// One plate off the middle, and a thin one beside it.
PlateScene plain_scene() {
  return PlateScene({{-0.35, 0.15, -0.3, 0.25, 1.5, 1}, {0.4, 0.45, -0.4, 0.3, 1.8, 2}});
}

void expect_recovered(const PlateScene& scene, const Calibration& believed,
                      const std::vector<Detection>& detections) {
  const cv::Mat1w labels = label_depth(detections, scene.depth(), believed, {});
  const Agreement found = agreement(labels, detections, scene.depth_label());
  EXPECT_GE(found.precision, 0.995);
  EXPECT_GE(found.recall, 0.98);
}

struct Error6 {
  Eigen::Vector3d shift_m, turn_deg;
};
void PrintTo(const Error6& error, std::ostream* out) {
  *out << "shift " << error.shift_m.transpose() << " m, turn " << error.turn_deg.transpose()
       << " deg";
}

class EdgeAlignedErrors : public ::testing::TestWithParam<Error6> {};

TEST_P(EdgeAlignedErrors, AreUndone) {
  const PlateScene scene = plain_scene();
  const Error6 error = GetParam();
  const Calibration believed =
      scene.misregistered(error.shift_m, error.turn_deg * std::numbers::pi / 180);
  expect_recovered(scene, believed, scene.detections());
}

INSTANTIATE_TEST_SUITE_P(
    EdgeAligned, EdgeAlignedErrors,
    ::testing::Values(Error6{{0, 0, 0}, {0, 0, 0}}, Error6{{0.02, 0, 0}, {0, 0, 0}},
                      Error6{{-0.03, 0.04, 0}, {0, 0, 0}}, Error6{{0, 0, 0}, {1, 0, 0}},
                      Error6{{0, 0, 0}, {-1.5, 2, 0}}, Error6{{0.01, 0, 0}, {0, -1, 0}}));

/// Plates towards the image's corners, which turn and grow about its middle.
PlateScene wide_scene() {
  return PlateScene({{-0.75, -0.45, -0.5, -0.25, 1.6, 1},
                     {0.4, 0.7, -0.45, -0.2, 1.5, 2},
                     {-0.7, -0.4, 0.2, 0.5, 1.7, 3},
                     {0.3, 0.6, 0.25, 0.45, 1.5, 4}});
}

OutlineAlignment fit_of(const PlateScene& scene, const Calibration& believed) {
  return align_outlines(find_depth_edges(scene.depth(), believed),
                        outline_field(scene.detections(), 320, 240, 68), believed, 40)
      .mended;
}

double roll_deg(const OutlineAlignment& fit) {
  return std::atan2(fit.rotation(1, 0), fit.rotation(0, 0)) * 180 / std::numbers::pi;
}

TEST(EdgeAligned, RollAndFocalLengthAreMendedWhereOutlinesLieFarApart) {
  const PlateScene scene = wide_scene();
  for (const double error_deg : {-5.0, 0.0, 3.0, 5.0})
    for (const double ratio : {0.95, 1.0, 1.05}) {
      SCOPED_TRACE(std::to_string(error_deg) + " degrees, focal length times " +
                   std::to_string(ratio));
      Calibration believed =
          scene.misregistered({0, 0, 0}, {0, 0, error_deg * std::numbers::pi / 180});
      believed.color.fx_px *= ratio, believed.color.fy_px *= ratio;
      const OutlineAlignment fit = fit_of(scene, believed);
      EXPECT_NEAR(roll_deg(fit), -error_deg, 0.15);
      EXPECT_NEAR(fit.focal * ratio, 1.0, 0.004);
      const Calibration mended = fit.corrected(believed);
      EXPECT_NEAR(mended.color.fx_px / scene.truth().color.fx_px, 1.0, 0.004);
      expect_recovered(scene, believed, scene.detections());
    }
}

/// Turned or grown about the image's middle, a small plate lies as if shifted.
TEST(EdgeAligned, RollAndFocalLengthStayAsBelievedWhereOneSmallObjectIsSeen) {
  const PlateScene scene({{0.35, 0.5, 0.1, 0.25, 1.5, 1}});
  const Calibration believed = scene.misregistered({0.02, 0, 0}, {0, 0, 0.03});
  const OutlineAlignment fit = fit_of(scene, believed);
  EXPECT_GT(fit.score, 0.6F);
  EXPECT_EQ(fit.focal, 1.0F);
  EXPECT_NEAR(roll_deg(fit), 0, 0.05);
  expect_recovered(scene, believed, scene.detections());
}

class EdgeAlignedBoundaries : public ::testing::TestWithParam<int> {};

TEST_P(EdgeAlignedBoundaries, GoBackToTheEdges) {
  const PlateScene scene({{-0.35, 0.15, -0.3, 0.25, 1.5, 1}});
  cv::Mat1w label = scene.label();
  const int px = GetParam();
  const cv::Mat disc =
      cv::getStructuringElement(cv::MORPH_ELLIPSE, {2 * std::abs(px) + 1, 2 * std::abs(px) + 1});
  if (px > 0) cv::dilate(label, label, disc);
  if (px < 0) cv::erode(label, label, disc);
  expect_recovered(scene, scene.truth(), scene.detections(label));
  expect_recovered(scene, scene.misregistered({0.02, 0.01, 0}, {0, 0, 0}), scene.detections(label));
}

INSTANTIATE_TEST_SUITE_P(EdgeAligned, EdgeAlignedBoundaries, ::testing::Values(-4, -2, 2, 4));

/// Four bars about a hole through which the wall is seen.
TEST(EdgeAligned, HoleAtTheCentreStaysOpen) {
  const PlateScene scene({{-0.3, -0.15, -0.3, 0.3, 1.5, 1},
                          {0.15, 0.3, -0.3, 0.3, 1.5, 1},
                          {-0.15, 0.15, -0.3, -0.15, 1.5, 1},
                          {-0.15, 0.15, 0.15, 0.3, 1.5, 1}});
  ASSERT_EQ(scene.depth_label()(120, 160), 0);
  expect_recovered(scene, scene.misregistered({0.03, 0, 0}, {0, 0, 0}), scene.detections());
}

/// The floor recedes by more than one part in fifty from row to row: it is no reason to think that
/// the colour camera does not see it.
TEST(EdgeAligned, GrazingFloorDoesNotHideItself) {
  const PlateScene scene({{-0.3, -0.1, 0.1, 0.35, 4.0, 1}, {0.0, 0.2, 0.05, 0.35, 4.0, 2}}, 0.35,
                         6.0);
  const std::vector<Detection> detections = scene.detections();
  const cv::Mat1w labels = label_depth(detections, scene.depth(), scene.truth(), {});
  const Agreement found = agreement(labels, detections, scene.depth_label());
  EXPECT_GE(found.precision, 0.99);
  EXPECT_GE(found.recall, 0.85);  // rows at the floor are left out
}

/// A screen let into the wall, without a step; a post stands before its right end for the colour
/// camera alone.
TEST(EdgeAligned, WhatIsHiddenIsNotGuessedFarAcrossASurface) {
  const PlateScene scene({{-0.8, 0.3, -0.6, 0.5, kWall_m - 1e-6, 1}, {0.08, 0.5, -2, 2, 0.65, 0}});
  const std::vector<Detection> detections = scene.detections();
  const cv::Mat1w labels = label_depth(detections, scene.depth(), scene.truth(), {});
  const Agreement found = agreement(labels, detections, scene.depth_label());
  EXPECT_GE(found.precision, 0.99);
  EXPECT_GE(found.recall, 0.8);
}

/// Bars of 2 pixels.
TEST(EdgeAligned, ThinPartsStay) {
  const PlateScene scene({{-0.3, -0.286, -0.3, 0.3, 1.8, 1},
                          {-0.1, -0.086, -0.3, 0.3, 1.8, 2},
                          {0.1, 0.4, -0.3, 0.3, 1.8, 3}});
  expect_recovered(scene, scene.truth(), scene.detections());
}

/// Slats with slits that the grown masks have filled.
TEST(EdgeAligned, SlitsThatMasksFilledOpenAgain) {
  const PlateScene scene({{-0.3, 0.3, -0.3, -0.1, 1.5, 1},
                          {-0.3, 0.3, -0.078, 0.05, 1.5, 1},
                          {-0.3, 0.3, 0.072, 0.3, 1.5, 1}});
  cv::Mat1w label = scene.label();
  cv::dilate(label, label, cv::getStructuringElement(cv::MORPH_ELLIPSE, {7, 7}));
  expect_recovered(scene, scene.truth(), scene.detections(label));
}

TEST(EdgeAligned, TouchingInstancesKeepTheirOwn) {
  const PlateScene scene({{-0.4, 0.0, -0.3, 0.3, 1.5, 1}, {0.0, 0.4, -0.2, 0.35, 1.4, 2}});
  expect_recovered(scene, scene.misregistered({0, 0.02, 0}, {0, 0, 0}), scene.detections());
}

TEST(EdgeAligned, MaskAtTheImagesEdge) {
  const PlateScene scene({{-2.0, -0.2, -0.3, 2.0, 1.5, 1}});
  expect_recovered(scene, scene.misregistered({0.02, 0, 0}, {0, 0, 0}), scene.detections());
}

TEST(EdgeAligned, WholeImageIsOneObject) {
  const PlateScene scene({{-5, 5, -5, 5, 1.5, 1}});
  const cv::Mat1w labels = label_depth(scene.detections(), scene.depth(), scene.truth(), {});
  EXPECT_EQ(cv::countNonZero(labels), 320 * 240);
}

TEST(OutlineShifts, AreSoughtOnlyWhereTheAlignmentExplainsEnough) {
  const PlateScene scene = plain_scene();
  const Calibration off = scene.misregistered({0.01, 0, 0}, {0, 0, 0});
  const DepthEdges edges = find_depth_edges(scene.depth(), off);
  const OutlineField field = outline_field(scene.detections(), 320, 240, 60);
  OutlineAlignment alignment;
  alignment.sharpness = 0.5F;
  alignment.score = 0.3F;
  EXPECT_FALSE(find_outline_shifts(edges, field, alignment, off).nodes.empty());
  alignment.score = 0.2F;
  EXPECT_TRUE(find_outline_shifts(edges, field, alignment, off).nodes.empty());
  alignment.score = 0.3F;
  alignment.sharpness = 0.9F;
  EXPECT_TRUE(find_outline_shifts(edges, field, alignment, off).nodes.empty());
}

/// As a limb does under a time offset.
TEST(OutlineShifts, FollowAnObjectThatMoved) {
  const PlateScene scene({{-0.3, 0.1, -0.3, 0.3, 1.5, 1}});
  cv::Mat1w moved(240, 320, std::uint16_t{0});
  scene.label()(cv::Rect(0, 0, 311, 240)).copyTo(moved(cv::Rect(9, 0, 311, 240)));
  OutlineAlignment alignment;
  alignment.sharpness = 0.5F;
  alignment.score = 0.3F;
  const OutlineShifts shifts = find_outline_shifts(
      find_depth_edges(scene.depth(), scene.truth()),
      outline_field(scene.detections(moved), 320, 240, 60), alignment, scene.truth());
  ASSERT_FALSE(shifts.nodes.empty());
  const cv::Rect object = cv::boundingRect(moved > 0);
  const cv::Vec2f shift = shifts.at(static_cast<float>(object.x + object.width / 2),
                                    static_cast<float>(object.y + object.height / 2));
  EXPECT_NEAR(shift[0], 9.0F, 0.5F);
  EXPECT_NEAR(shift[1], 0.0F, 0.5F);
}

/// A calibration that is known is not changed, and the masks' size is found as well as otherwise.
TEST(EdgeAligned, FitsTheMasksSizeAlone) {
  const PlateScene scene = plain_scene();
  for (const int grown_px : {-2, 0, 3}) {
    const cv::Mat1b square(2 * std::abs(grown_px) + 1, 2 * std::abs(grown_px) + 1, std::uint8_t{1});
    cv::Mat1w label;
    grown_px > 0 ? cv::dilate(scene.label(), label, square)
                 : cv::erode(scene.label(), label, square);
    const std::vector<Detection> detections = scene.detections(label);
    const OutlineField field = outline_field(detections, 320, 240, 60);
    const OutlineAlignment alignment =
        fit_mask_size(find_depth_edges(scene.depth(), scene.truth()), field, scene.truth());
    EXPECT_TRUE(alignment.rotation.isIdentity(0) && alignment.translation.isZero(0));
    EXPECT_NEAR(alignment.offset_px, -grown_px, 0.6) << grown_px;
    const Agreement found =
        agreement(label_depth(detections, scene.depth(), scene.truth(), {.fit = OutlineFit::masks}),
                  detections, scene.depth_label());
    EXPECT_GE(found.precision, 0.995) << grown_px;
    EXPECT_GE(found.recall, 0.98) << grown_px;
  }
}

TEST(EdgeAligned, AKnownCalibrationIsBelieved) {
  const PlateScene scene = plain_scene();
  const Calibration off = scene.misregistered({0.03, 0, 0}, {0, 0.03, 0});
  const OutlineField field = outline_field(scene.detections(), 320, 240, 60);
  const OutlineAlignment alignment =
      fit_mask_size(find_depth_edges(scene.depth(), off), field, off);
  EXPECT_TRUE(alignment.rotation.isIdentity(0) && alignment.translation.isZero(0));
}

TEST(EdgeAligned, ADoubtfulCalibrationIsMendedInEachFrame) {
  const PlateScene scene = plain_scene();
  // Farther than local shifts reach.
  Calibration off = scene.misregistered({0.03, 0, 0}, {0, 0.06, 0});
  const auto labels = [&](OutlineFit fit) {
    return label_depth(scene.detections(), scene.depth(), off, {.fit = fit});
  };
  const cv::Mat1w mended = labels(OutlineFit::calibration);
  EXPECT_GT(cv::countNonZero(labels(OutlineFit::masks) != mended), 100);
  off.is_doubtful = true;
  EXPECT_EQ(cv::countNonZero(labels(OutlineFit::masks) != mended), 0);
}

TEST(EdgeAligned, NothingToSegment) {
  const PlateScene scene = plain_scene();
  EXPECT_EQ(cv::countNonZero(label_depth({}, scene.depth(), scene.truth(), {})), 0);
  const cv::Mat1w no_depth(240, 320, std::uint16_t{0});
  const std::vector<Segment> segments =
      segment(Sight(scene.truth(), no_depth, scene.detections()), EdgeAligned{}, 0.05, true);
  ASSERT_EQ(segments.size(), 2U);
  for (const Segment& segment : segments) {
    EXPECT_EQ(segment.skipped, SkipReason::no_points);
    EXPECT_TRUE(segment.points.empty());
  }
}

TEST(EdgeAligned, SegmentsHoldPointsBoxAndVoxelsInTheirOrder) {
  const PlateScene scene = plain_scene();
  const std::vector<Segment> segments =
      segment(Sight(scene.truth(), scene.depth(), scene.detections()), EdgeAligned{}, 0.05, true);
  ASSERT_EQ(segments.size(), 2U);
  EXPECT_EQ(segments[0].instance, 1);
  EXPECT_EQ(segments[1].instance, 2);
  EXPECT_NEAR(segments[0].box.min().x(), -0.35, 0.01);
  EXPECT_NEAR(segments[0].box.max().x(), 0.15, 0.01);
  EXPECT_NEAR(segments[1].box.max().z(), 1.8, 1e-6);
  EXPECT_FALSE(segments[1].voxel_centres.empty());
}

TEST(EdgeAligned, SameInputSameLabels) {
  const PlateScene scene = plain_scene();
  const Calibration believed = scene.misregistered({0.02, 0.01, 0}, {0.01, 0, 0});
  const cv::Mat1w first = label_depth(scene.detections(), scene.depth(), believed, {});
  const cv::Mat1w second = label_depth(scene.detections(), scene.depth(), believed, {});
  EXPECT_EQ(cv::countNonZero(first != second), 0);
}

TEST(EdgeAligned, RefusesImagesOfAnotherSizeAndBadNumbers) {
  const PlateScene scene = plain_scene();
  EXPECT_THROW((void)label_depth({}, cv::Mat1w(10, 10, std::uint16_t{0}), scene.truth(), {}),
               Error);
  EXPECT_THROW((void)label_depth({}, scene.depth(), scene.truth(), {.search_px = -1}), Error);
  EXPECT_THROW((void)label_depth({}, scene.depth(), scene.truth(), {.reach_px = 0}), Error);
}

}  // namespace
}  // namespace mapscore
