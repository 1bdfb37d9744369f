// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#include "eval/truth/distance.hpp"

#include "tests/eval/truth/surface_patches.hpp"

#include <gtest/gtest.h>

namespace mapscore::eval {
namespace {

using Eigen::Vector3d;

Shape shape_at_origin(ShapeKind kind, const Vector3d& size) {
  Shape shape;
  shape.kind = kind;
  shape.size = size;
  return shape;
}

PreparedShape piece_of(const Shape& shape) {
  return prepare({shape}, Pose::Identity()).front();
}

Box cube(const Vector3d& low, double edge) {
  return {low, (low.array() + edge).matrix()};
}

TEST(Distance, OfSimplePlacesByHand) {
  const auto box = piece_of(shape_at_origin(ShapeKind::box, {1, 1, 1}));
  EXPECT_NEAR(distance(box, cube({1.3, 0, 0}, 0.1)), 0.3, 1e-12);
  EXPECT_NEAR(distance(box, cube({1.3, 1.4, 0}, 0.1)), 0.5, 1e-12);
  EXPECT_NEAR(distance(box, cube({0.5, 0, 0}, 0.1)), 0.4, 1e-12);  // from within
  EXPECT_EQ(distance(box, cube({0.95, 0, 0}, 0.1)), 0);
  const auto ball = piece_of(shape_at_origin(ShapeKind::sphere, {1, 0, 0}));
  EXPECT_NEAR(distance(ball, cube({-0.05, -0.05, 1.2}, 0.1)), 0.2, 1e-12);
  EXPECT_NEAR(distance(ball, cube({-0.1, -0.1, -0.1}, 0.2)), 1 - std::sqrt(0.03), 1e-12);
  const auto cylinder = piece_of(shape_at_origin(ShapeKind::cylinder, {1, 2, 0}));
  EXPECT_NEAR(distance(cylinder, cube({1.3, -0.05, 2.4}, 0.1)), 0.5, 1e-9);
  EXPECT_NEAR(distance(cylinder, cube({-0.05, -0.05, 1.7}, 0.1)), 0.2, 1e-12);
  const auto capsule = piece_of(shape_at_origin(ShapeKind::capsule, {1, 2, 0}));
  EXPECT_NEAR(distance(capsule, cube({-0.05, -0.05, 3.5}, 0.1)), 0.5, 1e-12);
  const auto plane = piece_of(shape_at_origin(ShapeKind::plane, {1, 1, 0}));
  EXPECT_NEAR(distance(plane, cube({0, 0, -0.3}, 0.1)), 0.2, 1e-12);
  const auto ellipsoid = piece_of(shape_at_origin(ShapeKind::ellipsoid, {3, 2, 1}));
  EXPECT_NEAR(distance(ellipsoid, cube({3.25, -0.05, -0.05}, 0.1)), 0.25, 1e-9);
  // From the centre the nearest boundary lies across the smallest axis.
  EXPECT_NEAR(distance(ellipsoid, Box(Vector3d::Zero(), Vector3d::Zero())), 1, 1e-12);
}

// Held against a pattern search over the patches, from outside and from inside.
TEST(Distance, AgreesWithSearchOverTheSurfaceAtRandomPoses) {
  for (const ShapeKind kind : test::kAllKinds) {
    SCOPED_TRACE(name_of(kind));
    RandomStream random(11, name_of(kind));
    int inner = 0;
    for (int round = 0; round < 80; ++round) {
      const Shape shape = test::random_shape(kind, random, 0.02);
      const auto piece = piece_of(shape);
      const double reach = round % 2 ? 0.6 : 0.08;
      const Vector3d low(reach * (random.uniform() - 0.5), reach * (random.uniform() - 0.5),
                         reach * (random.uniform() - 0.5));
      const Box box = cube(low, 0.01 + 0.03 * random.uniform());
      const double searched =
          test::sampled_distance(test::patches_of(shape, Pose::Identity()), box, 40);
      const double exact = distance(piece, box);
      EXPECT_NEAR(exact, searched, 2e-8) << "round " << round;
      EXPECT_LE(exact, searched + 1e-9) << "round " << round;  // the search is an upper bound
      inner += inside_open(piece, box);
    }
    if (kind != ShapeKind::plane && kind != ShapeKind::mesh) {
      EXPECT_GT(inner, 0);
    }
  }
}

TEST(Distance, TreeAndListAgreeAndHonourTheCap) {
  RandomStream random(5, "tree");
  std::vector<Shape> shapes;
  for (int i = 0; i < 60; ++i) {
    shapes.push_back(test::random_shape(test::kAllKinds[i % 7], random, 3.0));
  }
  const auto pieces = prepare(shapes, Pose::Identity());
  const SurfaceDistance tree(pieces);
  int capped = 0;
  for (int round = 0; round < 300; ++round) {
    const Box box = cube(test::random_pose(random, 3.0).translation(), 0.05);
    double least = kNoCap;
    for (const auto& piece : pieces) least = std::min(least, distance(piece, box));
    EXPECT_EQ(tree(box), least);
    EXPECT_EQ(distance_to_surface(pieces, box), least);
    EXPECT_EQ(tree(box, 0.25), std::min(least, 0.25));
    capped += least > 0.25;
  }
  EXPECT_GT(capped, 10);
  EXPECT_LT(capped, 290);
}

TEST(Distance, OfNothingIsTheCap) {
  const Box box = cube({0, 0, 0}, 1);
  EXPECT_EQ(SurfaceDistance({})(box), kNoCap);
  EXPECT_EQ(distance_to_surface({}, box, 0.25), 0.25);
}

TEST(Distance, PartsInsideOtherSolidsCount) {
  Shape outer = shape_at_origin(ShapeKind::box, {1, 1, 1});
  Shape inner = shape_at_origin(ShapeKind::box, {0.2, 0.2, 0.2});
  outer.instance = inner.instance = 1;
  ClassTable table;
  table.classes.push_back({1, "thing", {}, true});
  table.instances.push_back({1, "thing_1", 1});
  const auto pieces = pieces_of(prepare({outer, inner}, Pose::Identity()), table, 1);
  EXPECT_NEAR(distance_to_surface(pieces, cube({0.3, 0, 0}, 0.05)), 0.1, 1e-12);
  EXPECT_TRUE(pieces_of(pieces, table, 0).empty());
}

}  // namespace
}  // namespace mapscore::eval
