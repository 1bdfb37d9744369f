// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#include "core/error.hpp"
#include "tests/sim/render/rendered_frames.hpp"

namespace mapscore::sim {
namespace {

using testing::expect_same;
using testing::kStart;
using testing::load_text;
using testing::mjcf;
using testing::shapes_room;

TEST(RenderPicture, ShowsCubesAndHidesClasses) {
  const World world =
      load_text(mjcf("<body name='floor_1'><geom type='box' pos='0 0 -.1' size='2 2 .1' rgba='.2 "
                     ".2 .2 1'/></body>"));
  Renderer renderer(world, false);
  View view;
  view.eye_m = {0, -3, 3};
  view.width_px = 160;
  view.height_px = 120;
  Cube cube;
  cube.centre_world = {0, 0, 0.1};
  cube.edge_m = 0.5;
  cube.colour = {255, 0, 0};
  const cv::Mat3b empty = renderer.picture(view);
  const cv::Mat3b with_cube = renderer.picture(view, {&cube, 1});
  ASSERT_EQ(with_cube.size(), cv::Size(160, 120));
  EXPECT_GT(with_cube(58, 80)[2], 3 * with_cube(58, 80)[0]);
  EXPECT_EQ(empty(58, 80)[2], empty(58, 80)[0]);
  EXPECT_LT(empty(58, 80)[2], 200);
  view.hidden_classes = {"floor"};
  EXPECT_EQ(renderer.picture(view)(58, 80), cv::Vec3b(255, 255, 255));
  view.hidden_classes = {"flour"};
  EXPECT_THROW((void)renderer.picture(view), Error);
}

TEST(RenderPicture, GhostScenesArePale) {
  const World world =
      load_text(mjcf("<body name='floor_1'><geom type='box' pos='0 0 -.1' size='2 2 .1' rgba='.2 "
                     ".2 .2 1'/></body>"));
  Renderer renderer(world, false);
  View view;
  view.eye_m = {0, -3, 3};
  view.width_px = view.height_px = 64;
  const int plain = renderer.picture(view)(32, 32)[0];
  view.ghost_scene = true;
  EXPECT_GT(renderer.picture(view)(32, 32)[0], plain + 60);
}

TEST(RenderPicture, LooksStraightDown) {
  const World world =
      load_text(mjcf("<body name='box_1' pos='0 1 0'><geom type='box' size='.2 .2 .1'/></body>"));
  Renderer renderer(world, false);
  View view;
  view.eye_m = {0, 0, 5};
  view.width_px = view.height_px = 64;
  const cv::Mat3b picture = renderer.picture(view);
  EXPECT_LT(picture(15, 32)[0], 255);  // y of the world is up in the picture
  EXPECT_EQ(picture(48, 32)[0], 255);
  view.target_m = view.eye_m;
  EXPECT_THROW((void)renderer.picture(view), Error);
}

TEST(RenderPicture, DoesNotDisturbTheFramesAfterIt) {
  const World world = shapes_room();
  Renderer renderer(world, false);
  const Frame before = renderer.render(0, 0, kStart);
  View view;
  view.width_px = 900;
  view.height_px = 700;
  (void)renderer.picture(view);
  expect_same(before, renderer.render(0, 0, kStart));
}

}  // namespace
}  // namespace mapscore::sim
