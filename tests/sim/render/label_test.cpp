// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#include "tests/sim/render/rendered_frames.hpp"

#include <opencv2/imgproc.hpp>

#include <set>

namespace mapscore::sim {
namespace {

using testing::different_pixels;
using testing::kStart;
using testing::load_text;
using testing::mjcf;
using testing::shapes_room;

/// Whether the ray from the eye meets the box shape.
bool ray_meets_box(const Shape& box, const Eigen::Vector3d& eye, const Eigen::Vector3d& ray) {
  const Pose T_box_world = box.T_world_shape.inverse();
  const Eigen::Vector3d o = T_box_world * eye, d = T_box_world.linear() * ray;
  double enter = 0, leave = 1e9;
  for (int axis = 0; axis < 3; ++axis) {
    const double a = (-box.size[axis] - o[axis]) / d[axis],
                 b = (box.size[axis] - o[axis]) / d[axis];
    enter = std::max(enter, std::min(a, b));
    leave = std::min(leave, std::max(a, b));
  }
  return enter < leave;
}

TEST(RenderLabels, CoverTheProjectionOfABox) {
  const World world =
      load_text(mjcf("<body name='box_1' pos='2.5 .3 1.2' euler='20 30 40'><geom type='box' "
                     "size='.3 .2 .4'/></body>"));
  Renderer renderer(world, false);
  const Frame frame = testing::frame_at(renderer, kStart);
  const Calibration& calibration = world.calibration();
  const auto mask_from = [&](const CameraModel& camera, const Pose& T_world_camera) {
    cv::Mat1b mask(camera.height_px, camera.width_px);
    for (int v = 0; v < mask.rows; ++v) {
      for (int u = 0; u < mask.cols; ++u) {
        const Eigen::Vector3d ray = T_world_camera.linear() * camera.back_project(u, v, 1.0);
        mask(v, u) =
            ray_meets_box(world.shapes().at(0), T_world_camera.translation(), ray) ? 255 : 0;
      }
    }
    return mask;
  };
  const Pose T_world_depth = kStart * calibration.T_base_depth;
  const Pose T_world_color = T_world_depth * calibration.T_color_depth.inverse();
  const cv::Mat1b by_color = mask_from(calibration.color, T_world_color);
  const cv::Mat1b by_depth = mask_from(calibration.depth, T_world_depth);
  ASSERT_GT(cv::countNonZero(by_color), 5000);
  // Pixel centres that lie on the outline to within float precision may fall either way.
  EXPECT_LE(different_pixels(by_color, frame.label == 1), 3);
  EXPECT_LE(different_pixels(by_depth, frame.depth_label == 1), 3);
  EXPECT_GT(different_pixels(by_color, frame.depth_label == 1), 500);  // the cameras differ
}

TEST(RenderLabels, HoldExistingInstancesOnly) {
  const World world = shapes_room();
  Renderer renderer(world, false);
  const Frame frame = testing::frame_at(renderer, Pose::Identity());
  const std::set<std::uint16_t> seen(frame.label.begin(), frame.label.end());
  EXPECT_GT(seen.size(), 5u);
  EXPECT_LT(*seen.rbegin(), world.classes().instances.size());
}

TEST(RenderLabels, StandUprightAndNotMirrored) {
  const World world = load_text(mjcf(
      "<body name='left_1' pos='3 .8 1.15'><geom type='box' size='.1 .1 .1'/></body>"
      "<body name='top_1' pos='3 0 1.9'><geom type='box' size='.1 .1 .1' rgba='1 0 0 1'/></body>"));
  Renderer renderer(world, false);
  const Frame frame = testing::frame_at(renderer, Pose::Identity());
  const cv::Moments left = cv::moments(frame.label == 1, true),
                    top = cv::moments(frame.label == 2, true);
  EXPECT_LT(left.m10 / left.m00, 220);
  EXPECT_NEAR(left.m01 / left.m00, 239.5, 1.0);
  EXPECT_LT(top.m01 / top.m00, 140);
  const cv::Vec3b red = frame.color(static_cast<int>(top.m01 / top.m00), 320);
  EXPECT_GT(red[2], 2 * red[0]);  // BGR
}

TEST(RenderLabels, DepthPixelsRegisterOntoTheSameObject) {
  const World world = shapes_room();
  Renderer renderer(world, false);
  const Frame frame = testing::frame_at(renderer, Pose::Identity());
  const Calibration& calibration = world.calibration();
  int same = 0, all = 0;
  for (int v = 0; v < frame.depth.rows; ++v) {
    for (int u = 0; u < frame.depth.cols; ++u) {
      if (frame.depth(v, u) == 0) continue;
      const double z = frame.depth(v, u) / kDepthUnitsPerMetre;
      const Eigen::Vector2d pixel = calibration.color.project(
          calibration.T_color_depth * calibration.depth.back_project(u, v, z));
      const cv::Point at(static_cast<int>(std::lround(pixel.x())),
                         static_cast<int>(std::lround(pixel.y())));
      if (at.x < 0 || at.y < 0 || at.x >= 640 || at.y >= 480) continue;
      ++all;
      same += frame.label(at) == frame.depth_label(v, u);
    }
  }
  EXPECT_GT(all, 200000);
  EXPECT_GT(same, 0.97 * all);  // the rest is parallax at outlines
}

}  // namespace
}  // namespace mapscore::sim
