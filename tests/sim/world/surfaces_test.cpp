// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#include "core/error.hpp"
#include "tests/sim/world/scene_files.hpp"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

namespace mapscore::sim {
namespace {

using Eigen::Vector3d;
using testing::load_text;
using testing::mjcf;

const char* const kTetra = "0 0 0  1 0 0  0 1 0  0 0 1";

/// The only shape of a world with one body at (1, 2, 3) that has one geom.
Shape only_shape(const std::string& geom, const std::string& assets) {
  const World world = load_text(
      mjcf("<body name='a_1' pos='1 2 3'>" + geom + "</body>", "<asset>" + assets + "</asset>"));
  EXPECT_EQ(world.shapes().size(), 1u);
  return world.shapes().at(0);
}

std::vector<Triangle> world_triangles(const Shape& shape) {
  std::vector<Triangle> triangles = shape.triangles;
  for (Triangle& t : triangles)
    for (Vector3d& corner : t) corner = shape.T_world_shape * corner;
  return triangles;
}

/// Of a closed surface; positive when it faces outwards.
double volume(const std::vector<Triangle>& triangles) {
  double sum = 0;
  for (const auto& [a, b, c] : triangles) sum += a.dot(b.cross(c)) / 6;
  return sum;
}

/// True when each of the points is a corner and each corner one of the points, to 1 um.
bool corners_are(const std::vector<Triangle>& triangles, const std::vector<Vector3d>& points) {
  std::vector<bool> found(points.size(), false);
  for (const Triangle& t : triangles) {
    for (const Vector3d& corner : t) {
      const auto at = std::find_if(points.begin(), points.end(),
                                   [&](const Vector3d& p) { return (p - corner).norm() < 1e-6; });
      if (at == points.end()) return false;
      found[static_cast<std::size_t>(at - points.begin())] = true;
    }
  }
  return std::all_of(found.begin(), found.end(), [](bool f) { return f; });
}

TEST(Surfaces, OfMeshesStandWhereTheirFilesPutThem) {
  // The compiler moves every mesh to its centre of mass and main axes; the surface must not notice.
  const Shape shape = only_shape("<geom type='mesh' mesh='t' pos='.5 0 0' euler='0 0 90'/>",
                                 std::string("<mesh name='t' vertex='") + kTetra + "'/>");
  EXPECT_TRUE(
      corners_are(world_triangles(shape), {{1.5, 2, 3}, {1.5, 3, 3}, {0.5, 2, 3}, {1.5, 2, 4}}));
  EXPECT_NEAR(volume(world_triangles(shape)), 1.0 / 6, 1e-6);
}

TEST(Surfaces, OfScaledAndMirroredMeshesStayClosedAndFaceOutwards) {
  struct Case {
    const char* scale;
    Vector3d factors;
  };
  for (const Case& c : {Case{".5 2 3", {0.5, 2, 3}}, Case{"-1 2 1", {-1, 2, 1}},
                        Case{"-1 -1 .001", {-1, -1, 0.001}}, Case{"-2 -1 -3", {-2, -1, -3}}}) {
    SCOPED_TRACE(c.scale);
    const Shape shape =
        only_shape("<geom type='mesh' mesh='t'/>",
                   std::string("<mesh name='t' scale='") + c.scale + "' vertex='" + kTetra + "'/>");
    std::vector<Vector3d> corners;
    for (const Vector3d& p :
         {Vector3d(0, 0, 0), Vector3d(1, 0, 0), Vector3d(0, 1, 0), Vector3d(0, 0, 1)})
      corners.push_back(Vector3d(1, 2, 3) + p.cwiseProduct(c.factors));
    EXPECT_TRUE(corners_are(world_triangles(shape), corners));
    EXPECT_NEAR(volume(world_triangles(shape)), std::abs(c.factors.prod()) / 6, 1e-6);
  }
}

TEST(Surfaces, OfMeshesWithAReferenceFrame) {
  // refpos is taken off the vertices: the mesh's corner at (1, 2, 3) becomes its origin.
  const Shape shape =
      only_shape("<geom type='mesh' mesh='t'/>",
                 "<mesh name='t' refpos='1 2 3' vertex='1 2 3  2 2 3  1 3 3  1 2 4'/>");
  EXPECT_TRUE(corners_are(world_triangles(shape), {{1, 2, 3}, {2, 2, 3}, {1, 3, 3}, {1, 2, 4}}));
}

TEST(Surfaces, OfSignedDistanceFieldsAreTheirMeshes) {
  const std::string mesh =
      std::string(
          "<mesh name='other' vertex='0 0 0  2 0 0  0 2 0  0 0 2'/><mesh name='t' vertex='") +
      kTetra + "'/>";
  const Shape field = only_shape("<geom type='sdf' mesh='t'/>", mesh);
  const Shape plain = only_shape("<geom type='mesh' mesh='t'/>", mesh);
  EXPECT_EQ(field.kind, ShapeKind::mesh);
  EXPECT_TRUE(corners_are(world_triangles(field), {{1, 2, 3}, {2, 2, 3}, {1, 3, 3}, {1, 2, 4}}));
  EXPECT_EQ(field.triangles, plain.triangles);
}

TEST(Surfaces, OfSignedDistanceFieldsNeedTheirPlugin) {
  try {
    (void)load_text(
        "<mujoco><extension><plugin plugin='mujoco.sdf.torus'><instance name='t'/></plugin>"
        "</extension><asset><mesh name='t'><plugin instance='t'/></mesh></asset><worldbody>"
        "<geom type='sdf' mesh='t'><plugin instance='t'/></geom></worldbody></mujoco>");
    FAIL();
  } catch (const Error& error) {
    const std::string message = error.what();
    EXPECT_NE(message.find("mujoco.sdf.torus"), std::string::npos) << message;
    EXPECT_EQ(message.find('\n'), std::string::npos) << message;
  }
}

TEST(Surfaces, OfPrimitivesFittedToMeshesAreThePrimitives) {
  const std::string mesh =
      "<mesh name='t' vertex='0 0 0  1 0 0  0 1 0  1 1 0  0 0 1  1 0 1  0 1 1 "
      " 1 1 1'/>";  // the unit cube
  const Shape box = only_shape("<geom type='box' mesh='t'/>", mesh);
  EXPECT_EQ(box.kind, ShapeKind::box);
  EXPECT_LT((box.size - Vector3d::Constant(0.5)).norm(), 1e-6);
  EXPECT_LT((box.T_world_shape.translation() - Vector3d(1.5, 2.5, 3.5)).norm(), 1e-6);
  const Shape ball = only_shape("<geom type='sphere' mesh='t'/>", mesh);
  EXPECT_EQ(ball.kind, ShapeKind::sphere);
  EXPECT_TRUE(ball.triangles.empty());
}

TEST(Surfaces, OfPlanesWithoutEndAlongOneAxisAreCutAlongItAlone) {
  const World world =
      load_text(mjcf("<geom type='plane' size='2 0 1' pos='1 0 0'/>"
                     "<body name='a_1' pos='3 1 .5'><geom type='box' size='.5 2 .5'/></body>"));
  const Shape& ground = world.shapes().at(0);
  EXPECT_LT((ground.size - Vector3d(2, 2, 0)).norm(), 1e-9);
  EXPECT_LT((ground.T_world_shape.translation() - Vector3d(1, 1, 0)).norm(), 1e-9);
}

TEST(Surfaces, OfHeightFieldsHaveATopFourSidesAndABase) {
  const Shape field = only_shape("<geom type='hfield' hfield='h'/>",
                                 "<hfield name='h' nrow='2' ncol='3' size='2 1 .5 .1' "
                                 "elevation='0 1 0  0 1 0'/>");
  // A roof of 2 x 1 cells over a slab of 0.1 m: 4 triangles on top, 2 for each of the 6 pieces of
  // sides, 2 below. Elevation runs from 0 to 0.5 at the ridge x = 0.
  EXPECT_EQ(field.triangles.size(), 4u + 12u + 2u);
  EXPECT_NEAR(volume(world_triangles(field)), 4 * 2 * (0.1 + 0.25), 1e-6);
  int ridge = 0;
  for (const Triangle& t : field.triangles)
    for (const Vector3d& p : t) ridge += std::abs(p.x()) < 1e-9 && std::abs(p.z() - 0.5) < 1e-6;
  EXPECT_GT(ridge, 0);
}

TEST(Surfaces, LeaveOutFlexesAndSkins) {
  // Neither is a geom: neither is rendered, and neither is truth.
  const World world = load_text(mjcf(
      "<body name='a_1'><geom type='box' size='.1 .1 .1'/></body>"
      "<body name='cloth_1' pos='1 0 1'><flexcomp type='grid' count='3 3 1' spacing='.1 .1 .1' "
      "dim='2' name='cloth' rgba='1 0 0 1'><contact selfcollide='none'/>"
      "<edge equality='true'/></flexcomp></body>",
      "<asset><skin name='s' vertex='0 0 0  1 0 0  0 1 0' face='0 1 2'>"
      "<bone body='a_1' bindpos='0 0 0' bindquat='1 0 0 0' vertid='0 1 2' vertweight='1 1 1'/>"
      "</skin></asset>"));
  ASSERT_EQ(world.shapes().size(), 1u);
  EXPECT_EQ(world.shapes()[0].kind, ShapeKind::box);
}

}  // namespace
}  // namespace mapscore::sim
