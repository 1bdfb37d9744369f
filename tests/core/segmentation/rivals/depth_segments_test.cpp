// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#include "core/segmentation/rivals/depth_segments.hpp"

#include "core/error.hpp"
#include "tests/core/segmentation/rivals/mask_scene.hpp"

#include <gtest/gtest.h>

namespace mapscore {
namespace {

using mapscore::testing::MaskScene;

const DepthSegments kCovers{.normal_window_px = 5, .min_segment_px = 20};
const DepthSegments kVotes{.rule = SegmentRule::votes, .normal_window_px = 5, .min_segment_px = 20};

/// A box of 12 x 10 pixels half a metre before the wall; its mask is moved `right_px`.
MaskScene box_before_wall(int right_px) {
  MaskScene scene;
  scene.depth(cv::Rect(12, 10, 12, 10)) = 7500;
  scene.label(cv::Rect(12 + right_px, 10, 12, 10)) = 1;
  return scene;
}

TEST(DepthSegments, ACoveredSegmentIsTheMasksAsAWhole) {
  for (const int right_px : {0, 1, 2})  // covers 1, 0.92, 0.83 of it
    EXPECT_EQ(box_before_wall(right_px).segment_by(kCovers).points,
              MaskScene(box_before_wall(0)).points({{12, 10, 12, 10}}))
        << right_px;
  const Segment none = box_before_wall(3).segment_by(kCovers);  // 0.75
  EXPECT_TRUE(none.points.empty());
  EXPECT_EQ(none.skipped, SkipReason::no_points);
}

TEST(DepthSegments, AVotingSegmentKeepsItsPixelsOfTheMask) {
  const MaskScene scene = box_before_wall(5);  // 7 of 12 columns
  EXPECT_EQ(scene.segment_by(kVotes).points, scene.points({{17, 10, 7, 10}}));
  EXPECT_TRUE(box_before_wall(6).segment_by(kVotes).points.empty()) << "half is not more than half";
}

TEST(DepthSegments, TheShareCanBeAnother) {
  DepthSegments kind = kCovers;
  kind.share = 0.7;
  EXPECT_EQ(box_before_wall(3).segment_by(kind).points,
            box_before_wall(3).points({{12, 10, 12, 10}}));
  EXPECT_EQ(DepthSegments{}.least_share(), 0.8);
  EXPECT_EQ((DepthSegments{.rule = SegmentRule::votes}.least_share()), 0.5);
}

TEST(DepthSegments, TheMaskThatCoversMostHasTheSegment) {
  MaskScene scene = box_before_wall(0);
  std::vector<Detection> overlapping = scene.detections();
  scene.label.setTo(0);
  scene.label(cv::Rect(13, 9, 12, 11)) = 2;
  overlapping.push_back(scene.detections()[0]);
  const auto kept = [&](const DepthSegments& kind, std::size_t n) {
    return kind.segment(Sight(scene.pair, scene.depth, overlapping), 0.05, false)[n].points;
  };
  EXPECT_EQ(kept(kCovers, 0), scene.points({{12, 10, 12, 10}}));
  EXPECT_TRUE(kept(kCovers, 1).empty());
  std::swap(overlapping[0], overlapping[1]);
  EXPECT_EQ(kept(kCovers, 1), scene.points({{12, 10, 12, 10}}));
  EXPECT_EQ(kept(kVotes, 1), scene.points({{12, 10, 12, 10}})) << "masks may share pixels";
  EXPECT_EQ(kept(kVotes, 0), scene.points({{13, 10, 11, 10}}));
}

TEST(DepthSegments, WhatTheColourCameraDoesNotSeeIsInNoMask) {
  MaskScene scene = box_before_wall(0);
  scene.pair.T_color_depth.translation().x() = -0.3;  // the box hides wall that depth sees
  const int right_px = -20;                           // 100 px * 0.3 / 1.5 m
  scene.label.setTo(0);
  scene.label(cv::Rect(12, 10, 12, 10)) = 0;
  scene.depth.setTo(10000);
  scene.depth(cv::Rect(26, 10, 12, 10)) = 7500;
  scene.label(cv::Rect(26 + right_px, 10, 12, 10)) = 1;
  // Wall pixels move by 15 px, so some of them project into the mask, behind the box.
  EXPECT_EQ(scene.segment_by(kVotes).points, scene.points({{26, 10, 12, 10}}));
  DepthSegments any = kVotes;
  any.share = 0;
  EXPECT_EQ(scene.segment_by(any).points, scene.points({{26, 10, 12, 10}}));
}

TEST(DepthSegments, CutByTheImagesEdge) {
  MaskScene scene;
  scene.depth(cv::Rect(30, 0, 10, 12)) = 7500;
  scene.label(cv::Rect(30, 0, 10, 12)) = 1;
  EXPECT_EQ(scene.segment_by(kCovers).points, scene.points({{30, 0, 10, 12}}));
  EXPECT_EQ(scene.segment_by(kVotes).points, scene.points({{30, 0, 10, 12}}));
  // Only what the colour image has in view counts: here half of the box.
  scene.label.setTo(0);
  scene.pair.color.cx_px += 5;
  scene.label(cv::Rect(35, 0, 5, 12)) = 1;
  EXPECT_EQ(scene.segment_by(kCovers).points, scene.points({{30, 0, 10, 12}}));
  EXPECT_EQ(scene.segment_by(kVotes).points, scene.points({{30, 0, 5, 12}}));
}

TEST(DepthSegments, NoDepthAndNoMaskYieldNothing) {
  MaskScene scene = box_before_wall(0);
  scene.depth.setTo(0);
  EXPECT_EQ(scene.segment_by(kCovers).skipped, SkipReason::no_points);
  EXPECT_EQ(scene.segment_by(kVotes).skipped, SkipReason::no_points);
  EXPECT_TRUE(kCovers.segment(Sight(scene.pair, scene.depth, {}), 0.05, true).empty());
}

TEST(DepthSegments, AnEvenWindowIsRefused) {
  EXPECT_THROW((void)box_before_wall(0).segment_by(DepthSegments{.normal_window_px = 4}), Error);
  EXPECT_THROW((void)box_before_wall(0).segment_by(DepthSegments{.share = 1.5}), Error);
}

}  // namespace
}  // namespace mapscore
