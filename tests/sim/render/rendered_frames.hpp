// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#pragma once

#include "core/frame.hpp"
#include "sim/render/renderer.hpp"
#include "tests/sim/world/scene_files.hpp"

#include <gtest/gtest.h>
#include <opencv2/core.hpp>

namespace mapscore::sim::testing {

inline const Pose kStart = planar_pose(0.3, 0.1, 0.05);

/// One of every kind of surface; see tests/data/shapes_room.xml.
inline World shapes_room() {
  return World::load({data_file("shapes_room.xml"), std::nullopt, data_file("robot.xml")}, {});
}

/// Both cameras, each at an instant of its own.
inline Frame frame_at(Renderer& renderer, const StampedPose& color, const StampedPose& depth) {
  Frame frame;
  renderer.render_color(color, frame);
  renderer.render_depth(depth, frame);
  return frame;
}
inline Frame frame_at(Renderer& renderer, const Pose& T_world_base) {
  return frame_at(renderer, {0.0, T_world_base}, {0.0, T_world_base});
}

/// Pixels (channels of pixels, for colours) that differ.
inline int different_pixels(const cv::Mat& a, const cv::Mat& b) {
  cv::Mat difference;
  cv::absdiff(a, b, difference);
  return cv::countNonZero(difference.reshape(1));
}

inline void expect_same(const Frame& a, const Frame& b) {
  EXPECT_EQ(different_pixels(a.color, b.color), 0);
  EXPECT_EQ(different_pixels(a.label, b.label), 0);
  EXPECT_EQ(different_pixels(a.depth, b.depth), 0);
  EXPECT_EQ(different_pixels(a.depth_label, b.depth_label), 0);
}

}  // namespace mapscore::sim::testing
