// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#include "tests/support/tiny_recording.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace mapscore::testing {
namespace {

TEST(TinyRecording, DepthOfAPlaneSquareToTheViewIsItsDistance) {
  Shape plane;
  plane.kind = ShapeKind::plane;
  plane.instance = 3;
  plane.T_world_shape.translation().z() = 2.0;
  plane.size = {0.5, 10.0, 0.0};
  const CameraModel camera = CameraModel::from_hfov(9, 5, 1.5);
  const RayCast seen = ray_cast({plane}, camera, Pose::Identity(), 0.6, 8.0);
  for (int u = 0; u < 9; ++u) {
    const bool inside = std::abs(camera.back_project(u, 2, 2.0).x()) <= 0.5;
    EXPECT_EQ(seen.depth(2, u), inside ? 10000 : 0) << u;
    EXPECT_EQ(seen.label(2, u), inside ? 3 : 0) << u;
  }
}

TEST(TinyRecording, TheNearestSurfaceHidesTheOthersAndRangeLimitsAreIncluded) {
  Shape near_box, far_box;
  near_box.instance = 1;
  near_box.size = far_box.size = {1, 1, 0.25};
  near_box.T_world_shape.translation().z() = 1.25;  // its front at z = 1
  far_box.instance = 2;
  far_box.T_world_shape.translation().z() = 3.25;
  const CameraModel camera = CameraModel::from_hfov(1, 1, 1.0);
  const auto look = [&](double low, double high) {
    return ray_cast({far_box, near_box}, camera, Pose::Identity(), low, high);
  };
  EXPECT_EQ(look(1.0, 8.0).label(0, 0), 1);
  EXPECT_EQ(look(1.0, 8.0).depth(0, 0), 5000);
  EXPECT_EQ(look(0.5, 1.0).depth(0, 0), 5000);
  EXPECT_EQ(look(1.1, 8.0).depth(0, 0), 0);  // what is too near still hides what is behind it
  EXPECT_EQ(look(1.1, 8.0).label(0, 0), 1);
}

TEST(TinyRecording, EveryFrameSeesCrateWallAndNothing) {
  for (const Frame& frame : tiny_frames())
    for (const int instance : {0, 1, 2}) {
      EXPECT_GT(cv::countNonZero(frame.label == instance), 30) << frame.index;
      EXPECT_GT(cv::countNonZero(frame.depth_label == instance), 30) << frame.index;
    }
}

TEST(TinyRecording, DepthSamplesLieOnTheShapeTheyAreLabelledWith) {
  const Calibration calibration = tiny_info().calibration;
  const std::vector<Shape> shapes = tiny_shapes();
  for (const Frame& frame : tiny_frames()) {
    const Pose T_world_depth = frame.T_world_base * calibration.T_base_depth;
    for (int v = 0; v < frame.depth.rows; ++v)
      for (int u = 0; u < frame.depth.cols; ++u) {
        if (frame.depth(v, u) == 0) continue;
        const double z_m = frame.depth(v, u) / kDepthUnitsPerMetre;
        const Eigen::Vector3d p_world = T_world_depth * calibration.depth.back_project(u, v, z_m);
        const Shape& shape = shapes.at(frame.depth_label(v, u) - 1u);
        const Eigen::Vector3d p = shape.T_world_shape.inverse() * p_world;
        const double off = shape.kind == ShapeKind::plane
                               ? std::abs(p.z())
                               : std::abs((p.cwiseAbs() - shape.size).maxCoeff());
        EXPECT_LT(off, 1.5e-4);  // half a depth unit, slanted
      }
  }
}

}  // namespace
}  // namespace mapscore::testing
