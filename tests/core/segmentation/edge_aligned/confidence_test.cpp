// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#include "tests/core/segmentation/edge_aligned/plate_scene.hpp"

#include <gtest/gtest.h>

namespace mapscore {
namespace {

using testing::PlateScene;

double confidence(const PlateScene& masks, const cv::Mat1w& depth) {
  const Calibration off = masks.misregistered({0.02, 0, 0}, {0, 0, 0});
  return label_surfaces(Sight(off, depth, masks.detections()), {}).confidence.value();
}

/// That its numbers are those of real frames is measured, not tested: docs/segmentation.md.
TEST(EdgeAlignedConfidence, IsHighWhereStepsShowTheOutlinesAlone) {
  const PlateScene things({{-0.6, -0.1, -0.4, 0.3, 1.4, 1}, {0.2, 0.7, -0.3, 0.4, 2.0, 2}});
  const PlateScene wall({});
  EXPECT_GT(confidence(things, things.depth()), 0.95);
  // Pictures on a wall: depth shows nothing of them.
  EXPECT_LT(confidence(things, wall.depth()), 0.4);
  // One small thing, where the other steps have no masks.
  const PlateScene cup({{-0.02, 0.02, -0.02, 0.02, 2.0, 1}});
  EXPECT_LT(confidence(cup, things.depth()), 0.5);
  EXPECT_LT(confidence(cup, cup.depth()), confidence(things, things.depth()));
}

TEST(EdgeAlignedConfidence, IsNoneOfACalibrationThatIsKnown) {
  const PlateScene scene({{-0.6, -0.1, -0.4, 0.3, 1.4, 1}});
  const Sight sight(scene.truth(), scene.depth(), scene.detections());
  EXPECT_FALSE(label_surfaces(sight, {.fit = OutlineFit::masks}).confidence);
  for (const Segment& segment : EdgeAligned{}.segment(sight, 0.05, false))
    EXPECT_EQ(segment.confidence, label_surfaces(sight, {}).confidence);
}

}  // namespace
}  // namespace mapscore
