// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#include "core/segmentation/edge_aligned/pixel_votes.hpp"

#include "plate_scene.hpp"

#include <gtest/gtest.h>
#include <opencv2/core.hpp>

#include <vector>

namespace mapscore {
namespace {

using namespace mapscore::testing;

PixelVotes votes_on(const PlateScene& scene) {
  const std::vector<Detection> detections = scene.detections();
  const DepthEdges edges = find_depth_edges(scene.depth(), scene.truth());
  const CameraModel& color = scene.truth().color;
  const MaskField masks =
      open_grooves(outline_field(detections, color.width_px, color.height_px, 60));
  return pixel_votes(edges, masks, {}, {}, scene.truth(), detections.size());
}

/// Cameras side by side see the same of a board above a nearer one: nothing hides its last rows.
TEST(PixelVotes, OfRowsAboveANearerObjectCountWhereCamerasStandSideBySide) {
  const PlateScene scene({{-0.5, 0.5, -0.4, 0.5, 2.0, 1}, {-0.5, 0.5, 0.1, 0.5, 1.2, 2}});
  const cv::Mat1w truth = scene.depth_label();
  const PixelVotes votes = votes_on(scene);
  int above = 0, without = 0;
  for (int v = 0; v + 2 < truth.rows; ++v)
    for (int u = 120; u < 200; ++u)
      if (truth(v, u) == 1 && truth(v + 2, u) == 2) ++above, without += votes.owner(v, u) == 0;
  ASSERT_EQ(above, 2 * 80);
  EXPECT_EQ(without, 0);
}

/// A post hides what lies beside it for the depth camera, and does so through the gaps that depth
/// pixels leave in a finer colour image.
TEST(PixelVotes, OfWhatIsHiddenAreNoneHoweverFineTheColourImageIs) {
  const PlateScene scene({{-0.8, 0.5, -0.6, 0.5, 1.5, 1}, {0.0, 0.1, -2, 2, 0.7, 2}});
  for (const int times : {1, 2, 3, 5}) {
    const PlateScene finer = scene.with_finer_color(times);
    const PixelVotes votes = votes_on(finer);
    const cv::Mat1w truth = finer.depth_label();
    EXPECT_GT(cv::countNonZero((truth == 1) & (votes.owner == 0)), 1000) << times;
    EXPECT_EQ(cv::countNonZero((truth == 1) & (votes.owner == 2)), 0) << times;
  }
}

}  // namespace
}  // namespace mapscore
