// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#include "tests/sim/render/rendered_frames.hpp"
#include "tests/sim/world/shape_distance.hpp"

#include <mujoco/mujoco.h>

#include <algorithm>
#include <cmath>
#include <string>

// Surfaces that are not a geom of MuJoCo's own: fields of a plugin, flexes and skins.

namespace mapscore::sim {
namespace {

using Eigen::Vector3d;
using testing::load_text;
using testing::mjcf;

constexpr double kRadius_m = 0.3, kHoleRadius_m = 0.12;

/// A ball with a spherical bite at (radius, 0, 0); negative inside.
mjtNum bitten_ball(const mjtNum p[3]) {
  return std::max(std::hypot(p[0], p[1], p[2]) - kRadius_m,
                  kHoleRadius_m - std::hypot(p[0] - kRadius_m, p[1], p[2]));
}

/// Tells MuJoCo of the field `test.bitten_ball`; for the rest of the process.
void register_bitten_ball() {
  mjpPlugin plugin;
  mjp_defaultPlugin(&plugin);
  plugin.name = "test.bitten_ball";
  plugin.capabilityflags = mjPLUGIN_SDF;
  plugin.nstate = [](const mjModel*, int) { return 0; };
  plugin.init = [](const mjModel*, mjData*, int) { return 0; };
  plugin.reset = [](const mjModel*, mjtNum*, void*, int) {};
  plugin.compute = [](const mjModel*, mjData*, int, int) {};
  plugin.sdf_distance = [](const mjtNum p[3], const mjData*, int) { return bitten_ball(p); };
  plugin.sdf_staticdistance = [](const mjtNum p[3], const mjtNum*) { return bitten_ball(p); };
  plugin.sdf_gradient = [](mjtNum gradient[3], const mjtNum p[3], const mjData*, int) {
    std::copy(p, p + 3, gradient);
  };
  plugin.sdf_attribute = [](mjtNum*, const char**, const char**) {};
  plugin.sdf_aabb = [](mjtNum aabb[6], const mjtNum*) {
    std::fill(aabb, aabb + 3, 0.0);
    std::fill(aabb + 3, aabb + 6, 1.1 * kRadius_m);
  };
  mjp_registerPlugin(&plugin);
}

TEST(DrawnShapesDepth, OfAPluginsFieldLiesOnItsMesh) {
  register_bitten_ball();
  const World world = load_text(
      "<mujoco><extension><plugin plugin='test.bitten_ball'><instance name='field'/></plugin>"
      "</extension><asset><mesh name='m'><plugin instance='field'/></mesh></asset><worldbody>"
      "<body name='a_1' pos='1.6 .1 1.1' euler='20 -30 200'><geom type='sdf' mesh='m'>"
      "<plugin instance='field'/></geom></body></worldbody></mujoco>");
  ASSERT_EQ(world.shapes().size(), 1u);
  const Shape& shape = world.shapes()[0];
  ASSERT_EQ(shape.kind, ShapeKind::mesh);
  ASSERT_GT(shape.triangles.size(), 1000u);
  // MuJoCo's marching cubes: 0.66 m in some 100 cells follow the field to less than one of them.
  const Pose T_body_shape = Pose(Eigen::Translation3d(1.6, 0.1, 1.1)).inverse();
  double farthest = 0;
  for (const Triangle& t : shape.triangles) {
    for (const Vector3d& corner : t) {
      const double radius = (T_body_shape * shape.T_world_shape * corner).norm();
      farthest = std::max(farthest, radius);
      EXPECT_LT(std::abs(bitten_ball(corner.data())), 0.007);
    }
  }
  EXPECT_NEAR(farthest, kRadius_m, 0.007);

  Renderer renderer(world, false);
  const Frame frame = testing::frame_at(renderer, Pose::Identity());
  const Calibration& calibration = world.calibration();
  const Pose T_shape_depth = shape.T_world_shape.inverse() * calibration.T_base_depth;
  int samples = 0;
  double worst = 0, deepest = kRadius_m;
  for (int v = 0; v < frame.depth.rows; v += 7) {
    for (int u = 0; u < frame.depth.cols; u += 7) {
      if (frame.depth_label(v, u) != 1) continue;
      const double z = frame.depth(v, u) / static_cast<double>(kDepthUnitsPerMetre);
      const Vector3d p = T_shape_depth * calibration.depth.back_project(u, v, z);
      worst = std::max(worst, testing::distance_to_surface(shape, p));
      deepest = std::min(deepest, p.norm());
      ++samples;
    }
  }
  EXPECT_GT(samples, 150);
  EXPECT_LT(worst, 0.0002);
  EXPECT_LT(deepest, kRadius_m - 0.05);  // the bite was seen
}

TEST(DrawnShapesDepth, IsNotTouchedByFlexesAndSkins) {
  // Both would stand between the camera and the wall.
  const std::string wall =
      "<body name='wall_1' pos='4 0 1'><geom type='box' size='.1 3 2'/></body>";
  const World bare = load_text(mjcf(wall));
  const World flex = load_text(
      mjcf(wall + "<body name='cloth_1' pos='2 0 1' euler='0 90 0'><flexcomp type='grid' "
                  "count='5 5 1' spacing='.3 .3 .3' dim='2' name='cloth' rgba='1 0 0 1'>"
                  "<contact selfcollide='none'/><edge equality='true'/></flexcomp></body>"));
  const World skin =
      load_text(mjcf(wall,
                     "<asset><skin name='s' rgba='1 0 0 1' vertex='2 -1 0  2 1 0  2 0 2' "
                     "face='0 1 2 0 2 1'><bone body='wall_1' bindpos='4 0 1' bindquat='1 0 0 0' "
                     "vertid='0 1 2' vertweight='1 1 1'/></skin></asset>"));
  const auto frame_of = [](const World& world) {
    Renderer renderer(world, false);
    return testing::frame_at(renderer, Pose::Identity());
  };
  const Frame expected = frame_of(bare);
  ASSERT_EQ(expected.depth_label(240, 320), 1);
  ASSERT_EQ(flex.model().nflex, 1);
  ASSERT_EQ(skin.model().nskin, 1);
  for (const World* world : {&flex, &skin}) {
    const Frame frame = frame_of(*world);
    EXPECT_EQ(testing::different_pixels(frame.depth, expected.depth), 0);
    EXPECT_EQ(testing::different_pixels(frame.depth_label, expected.depth_label), 0);
    EXPECT_EQ(testing::different_pixels(frame.label, expected.label), 0);
    ASSERT_EQ(world->shapes().size(), 1u);
    EXPECT_EQ(world->shapes()[0].instance, expected.depth_label(240, 320));
  }
}

TEST(DrawnShapesDepth, OfARoundShapeHasNotTheScaleOfTheScenesMeshes) {
  const std::string ball =
      "<body name='a_1' pos='1.8 0 1.2'><geom type='sphere' size='.3'/></body>";
  const auto frame = [&](const std::string& head) {
    const World world = load_text(mjcf(ball, head));
    Renderer renderer(world, false);
    return testing::frame_at(renderer, Pose::Identity());
  };
  const Frame plain = frame(""), scaled = frame("<default><mesh scale='.5 .5 .5'/></default>");
  EXPECT_GT(cv::countNonZero(plain.depth_label), 500);
  EXPECT_EQ(cv::countNonZero(plain.depth != scaled.depth), 0);
}

}  // namespace
}  // namespace mapscore::sim
