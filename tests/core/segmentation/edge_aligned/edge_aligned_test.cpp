// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#include "core/segmentation/edge_aligned/edge_aligned.hpp"

#include "core/error.hpp"
#include "core/geometry/pose.hpp"
#include "core/segmentation/segmentation.hpp"

#include <gtest/gtest.h>
#include <opencv2/imgproc.hpp>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>
#include <vector>

namespace mapscore {
namespace {

cv::Mat1w label_depth(const std::vector<Detection>& detections, const cv::Mat1w& depth,
                      const Calibration& believed, const EdgeAligned& params) {
  return label_surfaces(Sight(believed, depth, detections), params).labels;
}

/// A rectangle at depth z, parallel to the image planes; metres in depth_optical.
struct Plate {
  double left, right, top, bottom, z;
  InstanceId instance;
};

constexpr double kWall_m = 3.0;

/// Plates before a wall, perhaps on a floor, seen by two cameras side by side.
class PlateScene {
 public:
  explicit PlateScene(std::vector<Plate> plates, double floor_y_m = 1e9, double wall_m = kWall_m)
      : plates_(std::move(plates)), floor_y_m_(floor_y_m), wall_m_(wall_m) {
    truth_.color = CameraModel::from_hfov(320, 240, 60 * std::numbers::pi / 180);
    truth_.depth = CameraModel::from_hfov(320, 240, 58.4 * std::numbers::pi / 180);
    truth_.T_color_depth.translation() = Eigen::Vector3d(-0.025, 0, 0);
    for (const Plate& plate : plates_) {
      const auto id = static_cast<std::size_t>(plate.instance);
      while (table_.instances.size() <= id)
        table_.instances.push_back({static_cast<InstanceId>(table_.instances.size()), "thing", 1});
    }
    table_.classes.push_back({1, "thing", {}, true});
  }

  [[nodiscard]] const Calibration& truth() const { return truth_; }
  /// Believed calibration with the error E on the left.
  [[nodiscard]] Calibration misregistered(const Eigen::Vector3d& shift_m,
                                          const Eigen::Vector3d& turn_rad) const {
    Calibration believed = truth_;
    Pose error = Pose::Identity();
    error.linear() = exp_rotation(turn_rad);
    error.translation() = shift_m;
    believed.T_color_depth = error * truth_.T_color_depth;
    return believed;
  }

  [[nodiscard]] cv::Mat1w depth() const {
    cv::Mat1w image(240, 320);
    for (int v = 0; v < 240; ++v)
      for (int u = 0; u < 320; ++u)
        image(v, u) = cv::saturate_cast<std::uint16_t>(kDepthUnitsPerMetre *
                                                       seen(truth_.depth, {0, 0, 0}, u, v).second);
    return image;
  }
  [[nodiscard]] cv::Mat1w depth_label() const { return label_of(truth_.depth, {0, 0, 0}); }
  [[nodiscard]] cv::Mat1w label() const { return label_of(truth_.color, {0.025, 0, 0}); }
  [[nodiscard]] std::vector<Detection> detections() const { return detections_of(label(), table_); }
  [[nodiscard]] std::vector<Detection> detections(const cv::Mat1w& label) const {
    return detections_of(label, table_);
  }

 private:
  [[nodiscard]] std::pair<InstanceId, double> seen(const CameraModel& camera,
                                                   const Eigen::Vector3d& eye, int u, int v) const {
    const double fall = camera.back_project(u, v, 1.0).y();
    const double floor_z = fall > 0 ? (floor_y_m_ - eye.y()) / fall : 1e9;
    std::pair<InstanceId, double> nearest{0, std::min(wall_m_, floor_z)};
    for (const Plate& plate : plates_) {
      const Eigen::Vector3d p = eye + camera.back_project(u, v, plate.z);
      if (plate.z < nearest.second && p.x() >= plate.left && p.x() <= plate.right &&
          p.y() >= plate.top && p.y() <= plate.bottom)
        nearest = {plate.instance, plate.z};
    }
    return nearest;
  }
  [[nodiscard]] cv::Mat1w label_of(const CameraModel& camera, const Eigen::Vector3d& eye) const {
    cv::Mat1w image(240, 320);
    for (int v = 0; v < 240; ++v)
      for (int u = 0; u < 320; ++u) image(v, u) = seen(camera, eye, u, v).first;
    return image;
  }

  std::vector<Plate> plates_;
  double floor_y_m_, wall_m_;
  Calibration truth_;
  ClassTable table_;
};

/// One plate off the middle, and a thin one beside it.
PlateScene plain_scene() {
  return PlateScene({{-0.35, 0.15, -0.3, 0.25, 1.5, 1}, {0.4, 0.45, -0.4, 0.3, 1.8, 2}});
}

struct Agreement {
  double precision, recall;
};

/// Of depth pixels, all instances together; each must get its own label.
Agreement agreement(const cv::Mat1w& labels, const std::vector<Detection>& detections,
                    const cv::Mat1w& truth) {
  double predicted = 0, right = 0, wanted = 0;
  for (int v = 0; v < truth.rows; ++v)
    for (int u = 0; u < truth.cols; ++u) {
      const int label = labels(v, u);
      const int instance =
          label == 0 ? 0 : detections[static_cast<std::size_t>(label - 1)].instance;
      predicted += instance != 0;
      wanted += truth(v, u) != 0;
      right += instance != 0 && instance == truth(v, u);
    }
  return {right / std::max(predicted, 1.0), right / std::max(wanted, 1.0)};
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

/// Wider than the parallax of anything in range, an object without steps cannot be out of the depth
/// camera's sight; a narrow one can.
TEST(EdgeAligned, FlushObjectsAreKeptIfTheyAreWide) {
  const PlateScene wide({{-0.5, 0.5, -0.5, 0.5, kWall_m - 1e-6, 1}});
  const cv::Mat1w kept = label_depth(wide.detections(), wide.depth(), wide.truth(), {});
  EXPECT_GE(agreement(kept, wide.detections(), wide.depth_label()).recall, 0.85);
  const PlateScene narrow({{-0.05, 0.05, -0.5, 0.5, kWall_m - 1e-6, 1}});
  const cv::Mat1w dropped = label_depth(narrow.detections(), narrow.depth(), narrow.truth(), {});
  EXPECT_EQ(cv::countNonZero(dropped), 0);
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
