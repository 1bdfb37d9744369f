// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#include "core/segmentation/segmentation.hpp"

#include "core/error.hpp"
#include "core/geometry/voxel.hpp"

#include <gtest/gtest.h>

namespace mapscore {
namespace {

/// Equal cameras of 9 x 7 pixels, f = 100, before a plane at 2 m: neighbouring points lie 2 cm
/// apart. `label` is what the colour camera sees.
/// The kinds that take one detection by itself.
using OneByOne = std::variant<Direct, Erosion, RegionGrowing>;

Segment segment_of_one(const OneByOne& kind, const Detection& detection,
                       const RegisteredCloud& cloud, double voxel_m, bool with_voxels) {
  return std::visit(
      [&](const auto& params) { return segment(detection, cloud, voxel_m, params, with_voxels); },
      kind);
}

struct Plane {
  Calibration pair;
  cv::Mat1w depth = cv::Mat1w(7, 9, std::uint16_t{10000});
  cv::Mat1w label = cv::Mat1w(7, 9, std::uint16_t{0});

  Plane() { pair.color = pair.depth = CameraModel{9, 7, 100, 100, 4, 3}; }

  [[nodiscard]] Detection detection() const {
    ClassTable table;
    table.classes.push_back({1, "thing", {}, true});
    table.instances.push_back({1, "thing_1", 1});
    return detections_of(label, table).at(0);
  }
  [[nodiscard]] Segment segment_by(const OneByOne& params, double voxel_m = 0.02) const {
    return segment_of_one(params, detection(), register_depth(depth, pair), voxel_m, true);
  }
  [[nodiscard]] Eigen::Vector3d point(int u, int v) const {
    return pair.depth.back_project(u, v, depth(v, u) / kDepthUnitsPerMetre);
  }
};

void expect_nothing(const Segment& segment, SkipReason reason) {
  EXPECT_EQ(segment.skipped, reason);
  EXPECT_TRUE(segment.points.empty());
  EXPECT_TRUE(segment.voxel_centres.empty());
  EXPECT_TRUE(segment.box.isEmpty());
}

TEST(Segmentation, DirectKeepsEveryPointOfTheMaskInRowMajorOrder) {
  Plane plane;
  plane.label(2, 3) = plane.label(2, 5) = plane.label(4, 1) = 1;
  plane.depth(2, 5) = 0;  // no depth: no point
  const Segment segment = plane.segment_by(Direct{});
  EXPECT_EQ(segment.points, (std::vector<Eigen::Vector3d>{plane.point(3, 2), plane.point(1, 4)}));
  EXPECT_EQ(segment.class_id, 1);
  EXPECT_EQ(segment.instance, 1);
  EXPECT_EQ(segment.skipped, SkipReason::none);
}

TEST(Segmentation, BoxBoundsTheKeptPoints) {
  Plane plane;
  plane.label(2, 3) = plane.label(4, 1) = 1;
  plane.depth(4, 1) = 12000;
  const Segment segment = plane.segment_by(Direct{});
  EXPECT_EQ(segment.box.min(), Eigen::Vector3d(plane.point(1, 4).x(), plane.point(3, 2).y(), 2.0));
  EXPECT_EQ(segment.box.max(), Eigen::Vector3d(plane.point(3, 2).x(), plane.point(1, 4).y(), 2.4));
}

TEST(Segmentation, DepthPixelThatCoversTwoColourPixelsCountsTwice) {
  Plane plane;
  plane.pair.color.fx_px *= 2;  // covers two columns
  plane.label(3, 4) = plane.label(3, 5) = 1;
  plane.depth.setTo(0);
  plane.depth(3, 4) = 10000;
  plane.pair.color.cx_px = 4.5;
  EXPECT_EQ(plane.segment_by(Direct{}).points,
            (std::vector<Eigen::Vector3d>{plane.point(4, 3), plane.point(4, 3)}));
}

TEST(Segmentation, VoxelsOfDirectLieOnTheSensorsLatticeOnceEachAndAscending) {
  Plane plane;
  plane.label(cv::Rect(2, 2, 5, 3)) = 1;
  const Segment segment = plane.segment_by(Direct{}, 0.1);
  // x in -0.04 .. 0.04, y in -0.02 .. 0.02, z = 2: two columns of voxels by two rows.
  const std::vector<Eigen::Vector3d> expected{
      centre_of({-1, -1, 20}, 0.1), centre_of({-1, 0, 20}, 0.1), centre_of({0, -1, 20}, 0.1),
      centre_of({0, 0, 20}, 0.1)};
  EXPECT_EQ(segment.voxel_centres, expected);
}

TEST(Segmentation, VoxelsAreLeftOutUnlessAskedFor) {
  Plane plane;
  plane.label(cv::Rect(2, 2, 5, 3)) = 1;
  const RegisteredCloud cloud = register_depth(plane.depth, plane.pair);
  for (const OneByOne& params : {OneByOne{Direct{}}, OneByOne{RegionGrowing{}}})
    EXPECT_TRUE(
        segment_of_one(params, plane.detection(), cloud, 0.05, false).voxel_centres.empty());
}

TEST(Segmentation, ErosionKeepsTheInsideOfTheMask) {
  Plane plane;
  plane.label(cv::Rect(2, 2, 5, 3)) = 1;
  const Segment segment = plane.segment_by(Erosion{1});
  EXPECT_EQ(segment.points, (std::vector<Eigen::Vector3d>{plane.point(3, 3), plane.point(4, 3),
                                                          plane.point(5, 3)}));
  EXPECT_EQ(plane.segment_by(Erosion{0}).points, plane.segment_by(Direct{}).points);
}

TEST(Segmentation, GrowingStartsAtTheMiddleOfTheBoxAndStopsAtAStep) {
  Plane plane;
  plane.label(cv::Rect(1, 3, 7, 1)) = 1;
  plane.depth(3, 6) = plane.depth(3, 7) = 15000;  // the mask leaks onto something a metre behind
  const Segment segment = plane.segment_by(RegionGrowing{.radius_factor = 0.5});
  ASSERT_EQ(segment.points.size(), 5u);
  EXPECT_EQ(segment.points.back(), plane.point(5, 3));
  ASSERT_EQ(segment.voxel_centres.size(), 5u);  // the pitch is the points' distance
  for (int n = 0; n < 5; ++n)
    EXPECT_TRUE(segment.voxel_centres[static_cast<std::size_t>(n)].isApprox(plane.point(n + 1, 3)));
}

TEST(Segmentation, MiddleOfAnEvenBoxIsRoundedDown) {
  Plane plane;
  plane.label(cv::Rect(2, 3, 4, 2)) = 1;  // columns 2 to 5, rows 3 and 4: (3, 3)
  plane.depth.setTo(15000);
  plane.depth(3, 3) = 10000;
  const Segment segment = plane.segment_by(RegionGrowing{});
  EXPECT_EQ(segment.points, std::vector<Eigen::Vector3d>{plane.point(3, 3)});
}

TEST(Segmentation, SeedMayLieOffTheMask) {
  Plane plane;
  plane.label(cv::Rect(2, 2, 5, 3)) = 1;
  plane.label(3, 4) = 0;  // a hole on the same plane: its point is the seed, but not kept
  const Segment segment = plane.segment_by(RegionGrowing{.radius_factor = 1.5});
  EXPECT_EQ(segment.points.size(), 14u);
  EXPECT_EQ(segment.skipped, SkipReason::none);
}

TEST(Segmentation, WantedPixelsAreEnoughForEveryMethod) {
  Plane plane;
  plane.label(cv::Rect(2, 2, 5, 3)) = 1;
  plane.label(3, 4) = 0;
  const Detection detection = plane.detection();
  const RegisteredCloud full = register_depth(plane.depth, plane.pair);
  const RegisteredCloud masked =
      register_depth(plane.depth, plane.pair, pixels_wanted({detection}, 9, 7));
  for (const OneByOne& params :
       {OneByOne{Direct{}}, OneByOne{Erosion{1}}, OneByOne{RegionGrowing{.radius_factor = 1.5}},
        OneByOne{RegionGrowing{.seed = SeedRule::mask_centroid}}})
    EXPECT_EQ(segment_of_one(params, detection, masked, 0.02, true).points,
              segment_of_one(params, detection, full, 0.02, true).points);
}

TEST(Segmentation, MaskCentroidTakesTheNearestMaskPixelWithAPoint) {
  Plane plane;
  plane.label(cv::Rect(2, 2, 5, 3)) = 1;  // centroid (4, 3)
  plane.label(3, 4) = 0;  // by symmetry still there; (3, 3), (5, 3) ... at distance 1
  plane.depth.setTo(15000);
  plane.depth(2, 4) = 10000;  // first of the four in row-major order
  plane.depth(3, 3) = 12000;
  const RegionGrowing centroid{.seed = SeedRule::mask_centroid};
  EXPECT_EQ(plane.segment_by(centroid).points, std::vector<Eigen::Vector3d>{plane.point(4, 2)});
  plane.depth(2, 4) = 0;  // no point there: next in order
  EXPECT_EQ(plane.segment_by(centroid).points, std::vector<Eigen::Vector3d>{plane.point(3, 3)});
}

TEST(Segmentation, SkippedSayWhy) {
  Plane plane;
  plane.label(cv::Rect(2, 2, 5, 3)) = 1;
  plane.label(3, 4) = 0;
  expect_nothing(plane.segment_by(Erosion{3}), SkipReason::eroded_away);
  plane.depth(3, 4) = 20000;  // the seed lies two metres behind the object
  expect_nothing(plane.segment_by(RegionGrowing{}), SkipReason::seed_off_object);
  plane.depth(3, 4) = 0;
  expect_nothing(plane.segment_by(RegionGrowing{}), SkipReason::no_seed_point);
  plane.depth.setTo(0);
  expect_nothing(plane.segment_by(Direct{}), SkipReason::no_points);
  expect_nothing(plane.segment_by(RegionGrowing{}), SkipReason::no_points);
}

TEST(Segmentation, RefusesMasksAndBoxesThatDoNotFit) {
  Plane plane;
  plane.label(cv::Rect(2, 2, 5, 3)) = 1;
  const RegisteredCloud cloud = register_depth(plane.depth, plane.pair);
  const Detection right = plane.detection();
  const auto expect_refused = [&](const Detection& wrong) {
    for (const OneByOne& params :
         {OneByOne{Direct{}}, OneByOne{Erosion{1}}, OneByOne{RegionGrowing{}}})
      EXPECT_THROW((void)segment_of_one(params, wrong, cloud, 0.05, false), Error);
  };
  Detection wrong = right;
  wrong.mask = cv::Mat1b(3, 4, std::uint8_t{255});  // the box is 5 x 3
  expect_refused(wrong);
  for (const int shift : {-3, 3}) {  // columns 2 to 6 of 9
    wrong = right;
    wrong.box.u_min += shift;
    wrong.box.u_max += shift;
    expect_refused(wrong);
    EXPECT_THROW((void)pixels_wanted({wrong}, 9, 7), Error);
  }
}

TEST(Segmentation, RefusesParametersOutOfRange) {
  Plane plane;
  plane.label(3, 4) = 1;
  EXPECT_THROW((void)plane.segment_by(Direct{}, 0.0), Error);
  EXPECT_THROW((void)plane.segment_by(Erosion{-1}), Error);
  EXPECT_THROW((void)plane.segment_by(RegionGrowing{.radius_factor = 0.0}), Error);
}

}  // namespace
}  // namespace mapscore
