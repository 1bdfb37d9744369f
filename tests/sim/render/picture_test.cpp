// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#include "core/error.hpp"
#include "tests/sim/render/rendered_frames.hpp"

namespace mapscore::sim {
namespace {

using testing::different_pixels;
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

TEST(RenderPicture, ClassColoursReplaceMaterialsAndLights) {
  const std::string head =
      "<visual><headlight active='0'/></visual><asset><texture name='t' type='2d' "
      "builtin='checker' "
      "rgb1='0 1 0' rgb2='0 0 1' width='8' height='8'/><material name='m' texture='t'/></asset>";
  const World world = load_text(
      mjcf("<body name='cup_1'><geom type='box' pos='-1 0 -.1' size='.8 2 .1' material='m'/></body>"
           "<geom type='box' pos='1 0 -.1' size='.8 2 .1' rgba='0 1 0 1'/>",
           head),
      "classes: [{name: cup, colour: 'FF0000'}]\n");
  Renderer renderer(world, false);
  View view;
  view.eye_m = {0, -3, 3};
  view.width_px = view.height_px = 64;
  view.class_colours = true;
  const cv::Mat3b picture = renderer.picture(view);
  const cv::Vec3b cup = picture(32, 20), other = picture(32, 44);
  EXPECT_GT(cup[2], 120);
  EXPECT_EQ(cup[0] + cup[1], 0);
  EXPECT_EQ(other[0], other[1]);
  EXPECT_EQ(other[1], other[2]);
  EXPECT_GT(other[0], 80);
}

TEST(RenderPicture, GhostScenesDoNotDependOnTheScenesLights) {
  const std::string box =
      "<body name='floor_1'><geom type='box' pos='0 0 -.1' size='2 2 .1' rgba='.2 .2 .2 "
      "1'/></body>";
  View view;
  view.eye_m = {0, -3, 3};
  view.width_px = view.height_px = 64;
  view.ghost_scene = true;
  const auto draw = [&](const std::string& light) {
    const World world = load_text(mjcf(light + box));
    return Renderer(world, false).picture(view);
  };
  EXPECT_EQ(different_pixels(draw(""), draw("<light pos='0 0 3' diffuse='1 .2 .2'/>")), 0);
}

TEST(RenderPicture, GhostsOfTexturedThingsHaveTheTexturesMeanColour) {
  const auto draw = [](const std::string& rgb) {
    const World world = load_text(
        mjcf("<geom type='box' pos='0 0 -.1' size='2 2 .1' material='m'/>",
             "<asset><texture name='t' type='2d' builtin='flat' width='8' height='8' rgb1='" + rgb +
                 "'/><material name='m' texture='t'/></asset>"));
    View view;
    view.eye_m = {0, -3, 3};
    view.width_px = view.height_px = 64;
    view.ghost_scene = true;
    return Renderer(world, false).picture(view)(32, 32);
  };
  const cv::Vec3b red = draw("1 0 0"), blue = draw("0 0 1");
  EXPECT_GT(red[2], red[0] + 20);
  EXPECT_EQ(red, cv::Vec3b(blue[2], blue[1], blue[0]));
}

TEST(RenderPicture, TheTopOfACubeHasItsColourAndItsSidesAreLittleDarker) {
  const World world = load_text(mjcf("<body name='far_1' pos='0 0 -9'><geom size='.1'/></body>"));
  Renderer renderer(world, false, true);
  Cube cube;
  cube.centre_world = {0, 0, 0};
  cube.edge_m = 1;
  cube.colour = {40, 88, 156};
  View view;
  view.width_px = view.height_px = 64;
  view.ghost_scene = true;
  for (const auto& eye : {Eigen::Vector3d(0, 0, 3), Eigen::Vector3d(3, 0, 0),
                          Eigen::Vector3d(0, 3, 0), Eigen::Vector3d(0, 0, -3)}) {
    view.eye_m = eye;
    const cv::Vec3b middle = renderer.picture(view, {&cube, 1})(32, 32);
    const cv::Vec3b bgr(156, 88, 40);
    for (int c = 0; c < 3; ++c) {
      EXPECT_LE(middle[c], bgr[c] + 1) << eye.transpose();
      EXPECT_GE(middle[c], (eye.z() > 0 ? 0.97 : 0.8) * bgr[c] - 1) << eye.transpose();
    }
  }
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
  view.eye_m = {0, 0, -5};  // straight up
  const cv::Mat3b from_below = renderer.picture(view);
  EXPECT_LT(from_below(15, 32)[0], 255);
  EXPECT_EQ(from_below(48, 32)[0], 255);
  view.target_m = view.eye_m;
  EXPECT_THROW((void)renderer.picture(view), Error);
}

TEST(RenderPicture, IsUprightNextToStraightDown) {
  const World world =
      load_text(mjcf("<body name='box_1' pos='0 1 0'><geom type='box' size='.2 .2 .1'/></body>"));
  Renderer renderer(world, false);
  View view;
  view.width_px = view.height_px = 64;
  for (const double aside : {1e-3, 1e-6, 1e-9, 1e-12}) {
    view.eye_m = {0, -aside, 5};
    const cv::Mat3b picture = renderer.picture(view);
    EXPECT_LT(picture(15, 32)[0], 255) << aside;
    EXPECT_EQ(picture(48, 32)[0], 255) << aside;
  }
}

TEST(RenderPicture, DoesNotDisturbTheFramesAfterIt) {
  const World world = shapes_room();
  Renderer renderer(world, false);
  const Frame before = testing::frame_at(renderer, kStart);
  View view;
  view.width_px = 900;
  view.height_px = 700;
  (void)renderer.picture(view);
  expect_same(before, testing::frame_at(renderer, kStart));
}

}  // namespace
}  // namespace mapscore::sim
