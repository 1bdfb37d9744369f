// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#include "tests/sim/render/rendered_frames.hpp"
#include "tests/sim/world/shape_distance.hpp"

#include <set>

namespace mapscore::sim {
namespace {

using testing::kStart;
using testing::load_text;
using testing::mjcf;
using testing::shapes_room;

Eigen::Vector3d eye_of_depth(const World& world, const Pose& T_world_base) {
  return (T_world_base * world.calibration().T_base_depth).translation();
}

/// Depth pixel in world coordinates.
Eigen::Vector3d world_point(const World& world, const Pose& T_world_base, int u, int v, double z) {
  const Calibration& calibration = world.calibration();
  return T_world_base * calibration.T_base_depth * calibration.depth.back_project(u, v, z);
}

TEST(RenderDepth, OfATiltedWallFollowsTheClosedForm) {
  // A large wall whose face runs from 1.6 m to beyond 6 m in front of the camera.
  const World world = load_text(mjcf(
      "<body name='wall_1' pos='4 0 1' euler='0 20 55'><geom type='box' size='.1 9 6'/></body>"));
  Renderer renderer(world, false);
  const cv::Mat1f depth = renderer.render_metric_depth(kStart);
  const Shape& wall = world.shapes().at(0);
  const Eigen::Vector3d normal = -wall.T_world_shape.linear().col(0);
  const Eigen::Vector3d on_face = wall.T_world_shape * Eigen::Vector3d(-wall.size.x(), 0, 0);
  const Eigen::Vector3d eye = eye_of_depth(world, kStart);
  double worst = 0, nearest = 100, farthest = 0;
  for (int v = 0; v < depth.rows; ++v) {
    for (int u = 0; u < depth.cols; ++u) {
      const Eigen::Vector3d ray = world_point(world, kStart, u, v, 1.0) - eye;
      const double exact = normal.dot(on_face - eye) / normal.dot(ray);
      if (exact <= 0 || exact > 6) continue;
      nearest = std::min(nearest, exact);
      farthest = std::max(farthest, exact);
      worst = std::max(worst, std::abs(depth(v, u) - exact));
    }
  }
  EXPECT_LT(nearest, 1.7);
  EXPECT_GT(farthest, 5.9);
  EXPECT_LT(worst, 0.00005);
}

TEST(RenderDepth, OfAFloorThatRunsUnderTheRobotFollowsTheClosedForm) {
  const World world = load_text(mjcf("<geom type='plane' size='20 20 1'/>"));
  Renderer renderer(world, false);
  const cv::Mat1f depth = renderer.render_metric_depth(kStart);
  const double height = eye_of_depth(world, kStart).z();
  const CameraModel& camera = world.calibration().depth;
  double worst = 0;
  int seen = 0;
  for (int v = 0; v < depth.rows; ++v) {
    const double exact = height * camera.fy_px / (v - camera.cy_px);
    if (exact <= 0 || exact > 6) continue;
    for (int u = 0; u < depth.cols; ++u, ++seen) {
      worst = std::max(worst, std::abs(depth(v, u) - exact));
    }
  }
  EXPECT_GT(seen, 50000);
  EXPECT_LT(worst, 0.00005);
}

TEST(RenderDepth, LiesOnTheSurfacesOfTheTruth) {
  // Boxes, round shapes, mesh, height field and plane: what is drawn is what the truth counts.
  const World world = shapes_room();
  Renderer renderer(world, false);
  std::set<ShapeKind> kinds;
  double worst = 0;
  for (const double yaw : {-0.5, 0.0, 0.5}) {
    const Pose T_world_base = planar_pose(0.1, 0, yaw);
    const Frame frame = testing::frame_at(renderer, T_world_base);
    const cv::Mat1f depth = renderer.render_metric_depth(T_world_base);
    for (int v = 0; v < depth.rows; v += 3) {
      for (int u = 0; u < depth.cols; u += 3) {
        if (frame.depth(v, u) == 0) continue;
        const Eigen::Vector3d p = world_point(world, T_world_base, u, v, depth(v, u));
        double nearest = 1;
        ShapeKind kind = ShapeKind::plane;
        for (const Shape& shape : world.shapes()) {
          if (shape.instance != frame.depth_label(v, u)) continue;
          const double d = testing::distance_to_surface(shape, shape.T_world_shape.inverse() * p);
          if (d < nearest) kind = shape.kind;
          nearest = std::min(nearest, d);
        }
        kinds.insert(kind);
        worst = std::max(worst, nearest);
      }
    }
  }
  EXPECT_EQ(kinds.size(), 7u);  // every kind was seen
  EXPECT_LT(worst, 0.00055);
}

TEST(RenderDepth, IsStoredWithinItsRangeOnly) {
  CameraOverrides cameras;
  cameras.range_min_m = 1.5;
  cameras.range_max_m = 3.0;
  const auto stored_at = [&](const std::string& x) {
    const World world = load_text(
        mjcf("<body name='wall_1' pos='" + x + " 0 1'><geom type='box' size='.05 4 4'/></body>"),
        {}, cameras);
    Renderer renderer(world, false);
    const Frame frame = testing::frame_at(renderer, Pose::Identity());
    return std::pair(frame.depth(240, 320), frame.depth_label(240, 320));
  };
  // the camera stands at x = 0.05, the wall's face 0.05 before its centre
  EXPECT_EQ(stored_at("1.5"), std::pair(std::uint16_t{0}, std::uint16_t{0}));
  EXPECT_EQ(stored_at("1.6"), std::pair(std::uint16_t{7500}, std::uint16_t{1}));
  EXPECT_EQ(stored_at("2.1001"),
            std::pair(std::uint16_t{10001}, std::uint16_t{1}));  // to the nearest
  EXPECT_EQ(stored_at("3.1"), std::pair(std::uint16_t{15000}, std::uint16_t{1}));
  EXPECT_EQ(stored_at("3.2"), std::pair(std::uint16_t{0}, std::uint16_t{0}));
}

}  // namespace
}  // namespace mapscore::sim
