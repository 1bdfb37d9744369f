// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#include "core/error.hpp"
#include "tests/sim/render/rendered_frames.hpp"

#include <cmath>
#include <vector>

namespace mapscore::sim {
namespace {

using testing::different_pixels;
using testing::shapes_room;

View small_view(const Eigen::Vector3d& eye_m, const Eigen::Vector3d& target_m) {
  View view;
  view.eye_m = eye_m;
  view.target_m = target_m;
  view.width_px = 320;
  view.height_px = 240;
  view.ghost_scene = true;
  return view;
}

/// Where something was drawn, or partly: the pale scene is never as white as the background.
cv::Mat1b drawn(const cv::Mat3b& picture) {
  cv::Mat1b background;
  cv::inRange(picture, cv::Scalar::all(255), cv::Scalar::all(255), background);
  return ~background;
}

ClassTable one_class() {
  ClassTable table;
  table.classes.push_back({1, "thing", {255, 0, 0}, true});
  table.instances.push_back({1, "thing_1", 1});
  return table;
}

Shape mesh_of(std::vector<Triangle> triangles) {
  Shape mesh;
  mesh.kind = ShapeKind::mesh;
  mesh.instance = 1;
  mesh.triangles = std::move(triangles);
  return mesh;
}

cv::Mat3b picture_of(std::vector<Shape> shapes, const View& view) {
  const World world = World::of_shapes(std::move(shapes), one_class());
  return Renderer(world, false).picture(view);
}

/// Facing up, in the square |x|, |y| <= 0.5.
const Triangle kUp{Eigen::Vector3d(-.5, -.5, 0), Eigen::Vector3d(.5, -.5, 0),
                   Eigen::Vector3d(0, .5, 0)};

// Every kind by itself, so that nothing hides behind another; the egg's, can's, pill's and ball's
// facets, the wedge's and hill's triangles, boxes, and the plane that was cut to the rest.
TEST(ShapePicture, HasTheOutlinesOfTheSceneThatTheShapesCameFrom) {
  const World scene = shapes_room();
  const World shapes = World::of_shapes(scene.shapes(), scene.classes());
  Renderer of_scene(scene, false), of_shapes(shapes, false);
  for (const SemanticClass& shown : scene.classes().classes) {
    View view = small_view({-1, -3, 4}, {2.5, 0.3, 0.7});
    for (const SemanticClass& c : scene.classes().classes)
      if (c.id != shown.id) view.hidden_classes.push_back(c.name);
    const cv::Mat1b a = drawn(of_scene.picture(view)), b = drawn(of_shapes.picture(view));
    EXPECT_GT(cv::countNonZero(a), 30) << shown.name;
    EXPECT_LE(different_pixels(a, b), 2) << shown.name;
  }
}

TEST(ShapePicture, RepeatsBitForBit) {
  const World scene = shapes_room();
  const View view = small_view({-1, -3, 4}, {2.5, 0.3, 0.7});
  const auto draw = [&] {
    const World world = World::of_shapes(scene.shapes(), scene.classes());
    return Renderer(world, false).picture(view);
  };
  EXPECT_EQ(different_pixels(draw(), draw()), 0);
}

TEST(ShapePicture, ShowsTrianglesFromTheirFrontAlone) {
  const View above = small_view({0, 0, 3}, {0, 0, 0}), below = small_view({0, 0, -3}, {0, 0, 0});
  EXPECT_GT(cv::countNonZero(drawn(picture_of({mesh_of({kUp})}, above))), 500);
  EXPECT_EQ(cv::countNonZero(drawn(picture_of({mesh_of({kUp})}, below))), 0);
  Shape plane;
  plane.kind = ShapeKind::plane;
  plane.size = {0.5, 0.5, 0};
  EXPECT_GT(cv::countNonZero(drawn(picture_of({plane}, above))), 1000);
  EXPECT_EQ(cv::countNonZero(drawn(picture_of({plane}, below))), 0);
}

TEST(ShapePicture, LeavesOutWhatHasNoArea) {
  const Triangle line{Eigen::Vector3d(0, 0, 0), Eigen::Vector3d(1, 0, 0), Eigen::Vector3d(2, 0, 0)};
  const View view = small_view({0, 0, 3}, {0, 0, 0});
  EXPECT_EQ(cv::countNonZero(drawn(picture_of({}, view))), 0);
  EXPECT_EQ(cv::countNonZero(drawn(picture_of({mesh_of({line})}, view))), 0);
  const World world = World::of_shapes({mesh_of({line}), mesh_of({line, kUp})}, one_class());
  EXPECT_EQ(world.shapes().size(), 1u);
  EXPECT_GT(cv::countNonZero(drawn(Renderer(world, false).picture(view))), 500);
}

TEST(ShapePicture, TakesManyTriangles) {
  constexpr int kCells = 150;
  const auto corner = [](int i, int j) {
    const double x = 4.0 * i / kCells - 2.0, y = 4.0 * j / kCells - 2.0;
    return Eigen::Vector3d(x, y, 0.2 * std::sin(3 * x) * std::cos(3 * y));
  };
  std::vector<Triangle> hills;
  for (int i = 0; i < kCells; ++i)
    for (int j = 0; j < kCells; ++j) {
      hills.push_back({corner(i, j), corner(i + 1, j), corner(i + 1, j + 1)});
      hills.push_back({corner(i, j), corner(i + 1, j + 1), corner(i, j + 1)});
    }
  const cv::Mat3b picture = picture_of({mesh_of(hills)}, small_view({0, 0, 3}, {0, 0, 0}));
  EXPECT_EQ(cv::countNonZero(drawn(picture)), 320 * 240) << "no hole between triangles";
}

/// A room of 4 m x 4 m and 2.5 m with a floor and a ceiling, and a table 0.7 m high.
std::vector<Shape> room() {
  std::vector<Shape> shapes(3);
  shapes[0].size = {2, 2, 0.05};
  shapes[0].T_world_shape.translation() = Eigen::Vector3d(0, 0, -0.05);
  shapes[1].size = {2, 2, 0.05};
  shapes[1].T_world_shape.translation() = Eigen::Vector3d(0, 0, 2.55);
  shapes[2].size = {0.6, 0.6, 0.35};
  shapes[2].T_world_shape.translation() = Eigen::Vector3d(0, 0, 0.35);
  shapes[2].instance = 1;
  return shapes;
}

TEST(ShapePicture, OpensTheCeilingToAnEyeAboveIt) {
  View view = small_view({0.1, 0, 8}, {0, 0, 1});
  const auto reddish = [&] {
    const cv::Vec3b middle = picture_of(room(), view)(120, 160);
    return middle[2] > middle[0] + 5;
  };
  EXPECT_FALSE(reddish());
  view.open_ceiling = true;
  EXPECT_TRUE(reddish());
  view.eye_m = {0.1, 0, 0.9};  // within the room, looking up at it
  view.target_m = {0, 0, 2.5};
  EXPECT_EQ(cv::countNonZero(drawn(picture_of(room(), view))), 320 * 240);
}

TEST(ShapePicture, ReachesAsFarAsItsTarget) {
  Shape box;
  box.size = {20, 20, 1};
  EXPECT_GT(cv::countNonZero(drawn(picture_of({box}, small_view({0, 0, 400}, {0, 0, 0})))), 300);
}

}  // namespace
}  // namespace mapscore::sim
