// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#include "core/segmentation/edge_aligned/edge_aligned.hpp"
#include "plate_scene.hpp"

#include <gtest/gtest.h>
#include <opencv2/imgproc.hpp>

#include <numbers>
#include <vector>

namespace mapscore {
namespace {

using namespace mapscore::testing;

constexpr double kNothing_m = 50.0;  // a wall out of range
constexpr double kNoFloor_m = 1e9;

/// Tiles of 10 cm that touch, 1.5 m away: most of their outlines have no step of depth.
PlateScene tiled_front(int columns, int rows, double floor_y_m, double wall_m) {
  std::vector<Plate> tiles;
  for (int row = 0; row < rows; ++row)
    for (int column = 0; column < columns; ++column) {
      const double left = 0.1 * column - 0.05 * columns, top = 0.1 * row - 0.05 * rows;
      tiles.push_back(
          {left, left + 0.1, top, top + 0.1, 1.5, static_cast<InstanceId>(tiles.size() + 1)});
    }
  return PlateScene(tiles, floor_y_m, wall_m);
}

Agreement found(const PlateScene& scene, const Calibration& believed) {
  const std::vector<Detection> detections = scene.detections();
  return agreement(label_depth(detections, scene.depth(), believed, {}), detections,
                   scene.depth_label());
}

/// Two masks decide the border between them, and leave nothing out.
TEST(EdgeAlignedContacts, FlushRowIsKeptWhole) {
  const PlateScene scene = tiled_front(3, 1, kNoFloor_m, kWall_m);
  const Agreement kept = found(scene, scene.truth());
  EXPECT_GE(kept.precision, 0.995);
  EXPECT_GE(kept.recall, 0.995);
}

/// A strip of 5 pixels between two fronts stays whole.
TEST(EdgeAlignedContacts, ThinFlushStripStays) {
  const PlateScene scene({{-0.3, 0.0, -0.3, 0.3, 1.5, 1},
                          {0.0, 0.027, -0.3, 0.3, 1.5, 2},
                          {0.027, 0.3, -0.3, 0.3, 1.5, 3}});
  const std::vector<Detection> detections = scene.detections();
  const cv::Mat1w labels = label_depth(detections, scene.depth(), scene.truth(), {});
  const cv::Mat1w truth = scene.depth_label();
  EXPECT_GE(cv::countNonZero((labels == 2) & (truth == 2)), 0.95 * cv::countNonZero(truth == 2));
  cv::Mat1b within_a_pixel;
  cv::dilate(truth == 2, within_a_pixel, cv::Mat1b(3, 3, std::uint8_t{1}));
  EXPECT_EQ(cv::countNonZero((labels == 2) & ~within_a_pixel), 0);
}

/// Strips of 2 px are not outvoted by the large masks on either side.
TEST(EdgeAlignedContacts, AStripOfTwoPixelsIsNotOutvoted) {
  const PlateScene scene({{-0.3, 0.0, -0.3, 0.3, 1.5, 1},
                          {0.0, 0.012, -0.3, 0.3, 1.5, 2},
                          {0.012, 0.3, -0.3, 0.3, 1.5, 3}});
  const cv::Mat1w truth = scene.depth_label();
  const int strip_px = cv::countNonZero(truth == 2);
  ASSERT_GT(strip_px, 150);
  const cv::Mat1w labels = label_depth(scene.detections(), scene.depth(), scene.truth(), {});
  EXPECT_GE(cv::countNonZero((labels == 2) & (truth == 2)), 0.7 * strip_px);
}

/// Where an object stands on a floor the surface turns, so nothing is left out.
TEST(EdgeAlignedContacts, AnObjectOnAFloorKeepsItsFoot) {
  const PlateScene scene({{-0.4, 0.3, -0.4, 0.35, 1.8, 1}}, 0.35, 6.0);
  const Agreement kept = found(scene, scene.truth());
  EXPECT_GE(kept.precision, 0.998);
  EXPECT_GE(kept.recall, 0.998);
}

/// A front that fills the picture but for the floor before it has no step of depth at all: its foot
/// alone tells how the masks lie.
TEST(EdgeAlignedContacts, AFootMendsTheCalibration) {
  const PlateScene scene({{-5.0, 5.0, -5.0, 0.35, 1.8, 1}}, 0.35, 6.0);
  for (const double turn_deg : {-1.5, 1.5}) {
    const Agreement mended =
        found(scene, scene.misregistered({0, 0, 0}, {turn_deg * std::numbers::pi / 180, 0, 0}));
    EXPECT_GE(mended.precision, 0.998) << turn_deg;
    EXPECT_GE(mended.recall, 0.998) << turn_deg;
  }
}

/// Masks that are too large all around still meet where their objects do.
TEST(EdgeAlignedContacts, ABorderOfTwoMasksStaysWhereBothAreTooLarge) {
  const PlateScene scene = tiled_front(3, 1, kNoFloor_m, kWall_m);
  const cv::Mat1w label = scene.label();
  cv::Mat1w grown;
  cv::dilate(label, grown, cv::Mat1b(5, 5, std::uint8_t{1}));
  label.copyTo(grown, label != 0);  // only over what no mask holds
  const std::vector<Detection> detections = scene.detections(grown);
  const Agreement kept = agreement(label_depth(detections, scene.depth(), scene.truth(), {}),
                                   detections, scene.depth_label());
  EXPECT_GE(kept.precision, 0.985);
  EXPECT_GE(kept.recall, 0.985);
}

/// Before a wall only its rim shows where the front is: an eighth of the outlines. Where four tiles
/// meet, none has half of the votes.
TEST(EdgeAlignedContacts, FewStepsOfALongOutlineMendTheCalibration) {
  const PlateScene scene = tiled_front(9, 8, kNoFloor_m, kWall_m);
  const Agreement kept = found(scene, scene.misregistered({0.04, 0, 0}, {0, 0, 0}));
  EXPECT_GE(kept.precision, 0.98);
  EXPECT_GE(kept.recall, 0.93);
}

/// Where nothing within range lies behind an object, its end is an edge too.
TEST(EdgeAlignedContacts, ObjectsBeforeNothingMendTheCalibration) {
  const PlateScene scene = tiled_front(3, 2, 0.5, kNothing_m);
  for (const double shift_m : {0.0, -0.04, 0.04}) {
    const Agreement kept = found(scene, scene.misregistered({shift_m, 0, 0}, {0, 0, 0}));
    EXPECT_GE(kept.precision, 0.98) << shift_m;
    EXPECT_GE(kept.recall, 0.96) << shift_m;
  }
}

/// A border with what has no mask is not known to the pixel: reach_px is left out there.
TEST(EdgeAlignedContacts, FlushWithTheWallARimIsLeftOut) {
  const PlateScene wide({{-0.5, 0.5, -0.5, 0.5, kWall_m - 1e-6, 1}});
  const Agreement kept = found(wide, wide.truth());
  EXPECT_EQ(kept.precision, 1.0);
  EXPECT_GE(kept.recall, 0.85);
  EXPECT_LT(kept.recall, 1.0);
}

/// Nothing shows that the depth camera could not see it.
TEST(EdgeAlignedContacts, NarrowFlushObjectIsNotDropped) {
  const PlateScene narrow({{-0.08, 0.08, -0.5, 0.5, kWall_m - 1e-6, 1}});
  const Agreement kept = found(narrow, narrow.truth());
  EXPECT_EQ(kept.precision, 1.0);
  EXPECT_GE(kept.recall, 0.5);
}

}  // namespace
}  // namespace mapscore
