// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#include "eval/truth/shapes/shape_tests.hpp"

#include "core/error.hpp"
#include "tests/eval/truth/surface_patches.hpp"
#include "tests/eval/truth/surface_witness.hpp"

#include <gtest/gtest.h>

#include <limits>

namespace mapscore::eval {
namespace {

using Eigen::Vector3d;

PreparedShape only_piece(const Shape& shape) {
  auto pieces = prepare({shape}, Pose::Identity());
  EXPECT_EQ(pieces.size(), 1u);
  return pieces.front();
}

Shape shape_at(ShapeKind kind, const Vector3d& size, const Vector3d& centre = Vector3d::Zero()) {
  Shape shape;
  shape.kind = kind;
  shape.size = size;
  shape.T_world_shape.translation() = centre;
  return shape;
}

Box cube(double x, double y, double z, double edge) {
  return {Vector3d(x, y, z), Vector3d(x + edge, y + edge, z + edge)};
}

TEST(ShapeTests, ContactOfFacesCountsForClosedBoxesOnly) {
  const auto solid = only_piece(shape_at(ShapeKind::box, {1, 1, 1}));
  const Box outside = cube(1, 0, 0, 0.5);
  EXPECT_TRUE(meets_solid(solid, outside));
  EXPECT_TRUE(meets_surface(solid, outside));
  EXPECT_FALSE(open_meets_surface(solid, outside));
  const Box inside = cube(0.5, 0, 0, 0.5);
  EXPECT_TRUE(meets_surface(solid, inside));
  EXPECT_FALSE(inside_open(solid, inside));
  EXPECT_FALSE(open_meets_surface(solid, inside));
  const Box across = cube(0.75, 0, 0, 0.5);
  EXPECT_TRUE(open_meets_surface(solid, across));
  EXPECT_FALSE(meets_solid(solid, cube(1 + 1e-9, 0, 0, 0.5)));
  EXPECT_TRUE(inside_open(solid, cube(0.5 - 1e-9, 0, 0, 0.5)));
}

TEST(ShapeTests, RoundFormsAtContact) {
  for (const auto& shape :
       {shape_at(ShapeKind::sphere, {0.5, 0, 0}), shape_at(ShapeKind::ellipsoid, {0.5, 0.3, 0.2}),
        shape_at(ShapeKind::cylinder, {0.5, 0.4, 0}),
        shape_at(ShapeKind::capsule, {0.5, 0.4, 0})}) {
    SCOPED_TRACE(name_of(shape.kind));
    const auto solid = only_piece(shape);
    EXPECT_TRUE(meets_surface(solid, cube(0.5, -0.1, -0.1, 0.2)));
    EXPECT_FALSE(open_meets_surface(solid, cube(0.5, -0.1, -0.1, 0.2)));
    EXPECT_FALSE(meets_surface(solid, cube(0.5 + 1e-9, -0.1, -0.1, 0.2)));
    EXPECT_TRUE(open_meets_surface(solid, cube(0.5 - 1e-6, -0.1, -0.1, 0.2)));
    EXPECT_TRUE(inside_open(solid, cube(-0.05, -0.05, -0.05, 0.1)));
    EXPECT_FALSE(meets_surface(solid, cube(-0.05, -0.05, -0.05, 0.1)));
    EXPECT_TRUE(meets_solid(solid, cube(-0.05, -0.05, -0.05, 0.1)));
  }
}

TEST(ShapeTests, CylinderIsCutByItsEndsBeforeItIsProjected) {
  // Tilted by 45 degrees about y, the box's far edge is within the radius but beyond the end.
  Shape shape = shape_at(ShapeKind::cylinder, {0.1, 0.5, 0});
  shape.T_world_shape.linear() =
      Eigen::AngleAxisd(std::numbers::pi / 4, Vector3d::UnitY()).toRotationMatrix();
  const auto solid = only_piece(shape);
  const double end = 0.5 / std::numbers::sqrt2, rim = 0.1 / std::numbers::sqrt2;
  EXPECT_TRUE(meets_solid(solid, cube(end - rim, -0.05, end + rim, 0.2)));
  EXPECT_FALSE(meets_solid(solid, cube(end - rim + 0.01, -0.05, end + rim, 0.2)));
}

TEST(ShapeTests, PlanesAndTrianglesHaveNoInside) {
  const auto plane = only_piece(shape_at(ShapeKind::plane, {1, 1, 0}));
  EXPECT_TRUE(meets_surface(plane, cube(0, 0, 0, 0.1)));
  EXPECT_FALSE(open_meets_surface(plane, cube(0, 0, 0, 0.1)));
  EXPECT_TRUE(open_meets_surface(plane, cube(0, 0, -0.05, 0.1)));
  EXPECT_FALSE(meets_solid(plane, cube(0, 0, -0.05, 0.1)));
  EXPECT_FALSE(inside_open(plane, cube(0, 0, -0.05, 0.1)));
}

TEST(ShapeTests, DegenerateTrianglesActAsSegmentsAndPoints) {
  Shape mesh;
  mesh.kind = ShapeKind::mesh;
  mesh.triangles = {{Vector3d(0, 0, 0), Vector3d(1, 1, 0), Vector3d(0.5, 0.5, 0)},
                    {Vector3d(2, 2, 2), Vector3d(2, 2, 2), Vector3d(2, 2, 2)}};
  const auto pieces = prepare({mesh}, Pose::Identity());
  ASSERT_EQ(pieces.size(), 2u);
  EXPECT_TRUE(meets_surface(pieces[0], cube(0.7, 0.7, -0.1, 0.2)));
  EXPECT_FALSE(meets_surface(pieces[0], cube(0.7, 0.2, -0.1, 0.2)));
  EXPECT_TRUE(meets_surface(pieces[1], cube(1.9, 1.9, 1.9, 0.2)));
  EXPECT_FALSE(meets_surface(pieces[1], cube(1.9, 1.9, 2.1, 0.2)));
}

// Every answer against sampled surfaces: a sample within the box is a meeting; a box that the test
// calls met has a point of the surface within 1e-8; one that it calls missed has none.
TEST(ShapeTests, AgreeWithSampledSurfacesAtRandomPoses) {
  for (const ShapeKind kind : test::kAllKinds) {
    SCOPED_TRACE(name_of(kind));
    RandomStream random(7, name_of(kind));
    int met = 0, missed = 0, held = 0;
    for (int round = 0; round < 300; ++round) {
      const Shape shape = test::random_shape(kind, random, 0.05);
      const auto piece = only_piece(shape);
      const auto patches = test::patches_of(shape, Pose::Identity());
      const double edge = 0.02 + 0.1 * random.uniform();
      const Box box = cube(0.5 * random.uniform() - 0.25, 0.5 * random.uniform() - 0.25,
                           0.5 * random.uniform() - 0.25, edge);
      const double sampled = test::sampled_distance(patches, box, 24);
      const bool meets = meets_surface(piece, box);
      ++(meets ? met : missed);
      if (meets) {
        EXPECT_LT(sampled, 1e-8) << "round " << round;
        EXPECT_FALSE(inside_open(piece, box));
      } else {
        EXPECT_GT(sampled, 0) << "round " << round;
      }
      if (inside_open(piece, box)) {
        ++held;
        EXPECT_TRUE(meets_solid(piece, box));
        EXPECT_GT(sampled, 0);
      }
    }
    EXPECT_GT(met, 10);
    EXPECT_GT(missed, 10);
    if (kind != ShapeKind::plane && kind != ShapeKind::mesh) {
      EXPECT_GT(held, 0);
    }
  }
}

// Boxes and planes turned about one axis of the map take a shorter way through the separating axes.
TEST(ShapeTests, FormsTurnedAboutOneAxisAgreeWithASearch) {
  RandomStream random(11, "upright");
  int met = 0, missed = 0;
  for (int round = 0; round < 3000; ++round) {
    Shape shape = shape_at(round % 4 == 0 ? ShapeKind::plane : ShapeKind::box,
                           {0.02 + 0.3 * random.uniform(), 0.02 + 0.3 * random.uniform(),
                            0.02 + 0.3 * random.uniform()},
                           {0.3 * random.normal(), 0.3 * random.normal(), 0.3 * random.normal()});
    shape.T_world_shape.linear() =
        Eigen::AngleAxisd(6 * random.uniform(), Vector3d::Unit(round % 3)).toRotationMatrix();
    const Box box = cube(-0.1, -0.15, -0.05, 0.05 + 0.2 * random.uniform());
    const auto set = test::convex_sets_of(shape, Pose::Identity()).front();
    const double found = test::near_pair(set, box).distance;
    const bool meets =
        std::visit([&](const auto& form) { return mapscore::eval::meets(form, box); },
                   only_piece(shape).form());
    ++(meets ? met : missed);
    if (meets) {
      EXPECT_LT(found, 1e-9) << "round " << round;
    } else {
      EXPECT_GT(found, 0) << "round " << round;
    }
  }
  EXPECT_GT(met, 300);
  EXPECT_GT(missed, 300);
}

// A box is moved to touch the surface from outside and from inside at a known gap; extreme
// proportions.
TEST(ShapeTests, EllipsoidOfExtremeProportionsIsExactAtItsTips) {
  RandomStream random(3, "needle");
  for (int round = 0; round < 50; ++round) {
    Shape shape = shape_at(ShapeKind::ellipsoid, {2.0, 0.02, 0.3});
    shape.T_world_shape = test::random_pose(random, 1.0);
    const auto piece = only_piece(shape);
    // The extreme point along map x: a box beyond it touches there and nowhere else.
    const Eigen::Matrix3d R = shape.T_world_shape.linear();
    const Vector3d scaled = shape.size.cwiseProduct(R.transpose() * Vector3d::UnitX());
    const Vector3d tip =
        shape.T_world_shape.translation() + R * shape.size.cwiseProduct(scaled.normalized());
    const Vector3d half(0, 0.05, 0.05), far(0.1, 0.05, 0.05);
    EXPECT_TRUE(meets_surface(piece, Box(tip - half - Vector3d(1e-8, 0, 0), tip + far)));
    EXPECT_FALSE(meets_surface(piece, Box(tip - half + Vector3d(1e-8, 0, 0), tip + far)));
  }
}

TEST(ShapeTests, RefusesShapesThatAreNotUsable) {
  EXPECT_THROW((void)prepare({shape_at(ShapeKind::sphere, {0, 0, 0})}, Pose::Identity()), Error);
  EXPECT_THROW((void)prepare({shape_at(ShapeKind::box, {1, -1, 1})}, Pose::Identity()), Error);
  const double nan = std::numeric_limits<double>::quiet_NaN();
  EXPECT_THROW(
      (void)prepare({shape_at(ShapeKind::sphere, {1, 0, 0}, {nan, 0, 0})}, Pose::Identity()),
      Error);
  try {
    Shape bad = shape_at(ShapeKind::plane, {0, 1, 0});
    bad.name = "floor";
    (void)prepare({bad}, Pose::Identity());
    FAIL();
  } catch (const Error& error) {
    EXPECT_NE(std::string(error.what()).find("plane 'floor'"), std::string::npos);
  }
}

}  // namespace
}  // namespace mapscore::eval
