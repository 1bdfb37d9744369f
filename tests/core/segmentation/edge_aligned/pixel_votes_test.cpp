// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#include "core/segmentation/edge_aligned/pixel_votes.hpp"

#include "plate_scene.hpp"

#include <gtest/gtest.h>
#include <opencv2/core.hpp>

#include <numbers>
#include <vector>

namespace mapscore {
namespace {

using namespace mapscore::testing;

/// By a calibration that is off by so much.
PixelVotes votes_on(const PlateScene& scene, const Eigen::Vector3d& off_m = {0, 0, 0}) {
  const std::vector<Detection> detections = scene.detections();
  const DepthEdges edges = find_depth_edges(scene.depth(), scene.truth());
  const CameraModel& color = scene.truth().color;
  const MaskField masks =
      open_grooves(outline_field(detections, color.width_px, color.height_px, 60));
  return pixel_votes(edges, masks, {}, {}, scene.misregistered(off_m, {0, 0, 0}),
                     detections.size());
}

CameraModel color_camera(int times) {
  return CameraModel::from_hfov(320 * times, 240 * times, 60 * std::numbers::pi / 180);
}

/// Of the pixels of object 1 that lie up to two `step`s before those of object 2, those without an
/// owner, in the middle of the image.
int without_owner(const PlateScene& scene, const cv::Point& step) {
  const cv::Mat1w truth = scene.depth_label(), owner = votes_on(scene).owner;
  int before = 0, without = 0;
  for (int v = 80; v < 160; ++v)
    for (int u = 120; u < 200; ++u)
      if (truth(v, u) == 1 && truth(cv::Point(u, v) + 2 * step) == 2)
        ++before, without += owner(v, u) == 0;
  EXPECT_EQ(before, 160);
  return without;
}

/// Cameras beside each other see the same of a board above a nearer one, and cameras above each
/// other of a board beside a nearer one: nothing hides its last pixels.
TEST(PixelVotes, BesideANearerObjectCountWhereTheBaselineRunsAlongItsRim) {
  const PlateScene above({{-0.5, 0.5, -0.6, 0.5, 2.0, 1}, {-0.9, 0.9, 0.05, 0.5, 1.2, 2}});
  const PlateScene aside({{-0.9, 0.9, -0.6, 0.6, 2.0, 1}, {0.05, 0.9, -0.6, 0.6, 1.2, 2}});
  EXPECT_EQ(without_owner(above, {0, 1}), 0);
  EXPECT_EQ(without_owner(aside.seen_by(color_camera(1), {0, 0.025, 0}), {1, 0}), 0);
  const PlateScene oblique = above.seen_by(color_camera(1), {0.02, 0.02, 0});
  EXPECT_GT(without_owner(oblique, {0, 1}), 60);
}

/// A post hides what lies beside it for the depth camera, also at its rim, and through the gaps
/// that depth pixels leave in a finer colour image; there the post may end within the last gap.
TEST(PixelVotes, OfWhatIsHiddenAreNone) {
  for (const int times : {1, 2, 3, 5})
    for (int n = 0; n < 8; ++n) {
      const double left = 0.0013 * n;
      const PlateScene scene({{-0.8, 0.5, -0.6, 0.5, 1.5, 1}, {left, left + 0.1, -2, 2, 0.7, 2}});
      const PlateScene finer = scene.seen_by(color_camera(times), {0.025, 0, 0});
      const cv::Mat1w truth = finer.depth_label(), owner = votes_on(finer).owner;
      EXPECT_GT(cv::countNonZero((truth == 1) & (owner == 0)), 1000) << times << ", " << left;
      const int column = times > 1 ? 240 : 0;
      EXPECT_LE(cv::countNonZero((truth == 1) & (owner == 2)), column) << times << ", " << left;
    }
}

/// Two thirds of a pixel are what a fit may well be off by.
TEST(PixelVotes, OfWhatIsHiddenAreNoneByAFitThatIsNearlyRight) {
  int seen_as_post = 0;
  for (int n = 0; n < 8; ++n)
    for (const double off_m : {-0.0016, 0.0016}) {
      const double left = 0.0013 * n;
      const PlateScene scene({{-0.8, 0.5, -0.6, 0.5, 1.5, 1}, {left, left + 0.1, -2, 2, 0.7, 2}});
      const cv::Mat1w owner = votes_on(scene, {off_m, 0, 0}).owner;
      seen_as_post += cv::countNonZero((scene.depth_label() == 1) & (owner == 2));
    }
  EXPECT_EQ(seen_as_post, 0);
}

/// Depth that is registered to the colour image: both cameras see the same, and nothing is hidden.
TEST(PixelVotes, OfRegisteredDepthAreTheMasksOwn) {
  const PlateScene scene({{-0.8, 0.5, -0.6, 0.5, 1.5, 1}, {0.0, 0.1, -2, 2, 0.7, 2}});
  const PlateScene registered = scene.seen_by(scene.truth().depth, {0, 0, 0});
  EXPECT_EQ(cv::countNonZero(votes_on(registered).owner != registered.label()), 0);
}

/// However far focal lengths lie apart, a surface is spread by a part of the image alone.
TEST(PixelVotes, AreGivenForAnyRatioOfFocalLengths) {
  const PlateScene scene({{-0.8, 0.5, -0.6, 0.5, 1.5, 1}});
  for (const double ratio : {1e-9, 1e-3, 1e3, 1e9}) {
    CameraModel color = scene.truth().color;
    color.fx_px *= ratio;
    const PlateScene odd = scene.seen_by(color, {0.025, 0, 0});
    EXPECT_EQ(votes_on(odd).owner.size(), scene.depth().size()) << ratio;
  }
}

}  // namespace
}  // namespace mapscore
