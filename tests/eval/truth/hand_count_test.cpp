// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#include "tests/eval/truth/brute_force_shapes.hpp"
#include "tests/eval/truth/truth_scenes.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <numbers>

// Surface truth counted by hand, voxels of 10 cm. Cubes are closed, so a face on a plane of the
// lattice touches the layers on both of its sides. In the sums a voxel [i, i+1] counts by its least
// distance from 0 along an axis, a = i or -i-1 in voxels: each a stands for two indices, each
// triple (a, b, c) for eight voxels around a centre on a corner of the lattice.

namespace mapscore::eval {
namespace {

using Eigen::Vector3d;
using test::box_shape;
using test::kEdge;
using test::placed;

void expect_counts(const Shape& shape, std::size_t voxels, std::size_t touch_only) {
  for (const double epsilon_m : {0.0, 0.0005}) {
    SCOPED_TRACE(::testing::Message() << "epsilon " << epsilon_m);
    const auto truth = test::truth_of({shape}, kEdge, epsilon_m);
    EXPECT_EQ(truth.count(1), voxels);
    EXPECT_EQ(truth.voxels().size(), voxels);
    EXPECT_EQ(test::touch_only_count(truth), touch_only);
  }
}

Shape turned(Shape shape, double angle, const Vector3d& axis) {
  shape.T_world_shape.linear() = Eigen::AngleAxisd(angle, axis).toRotationMatrix();
  return shape;
}

TEST(HandCount, BoxWithAllFacesOnTheLattice) {
  // Touched: -1 to 10, 12 on each axis. Inside without contact: 1 to 8, 8 on each axis. Every face
  // lies between voxels, so all of it is contact. 12^3 - 8^3.
  const Shape box = box_shape({0, 0, 0}, {1, 1, 1}, 1);
  expect_counts(box, 1216, 1216);
  const auto truth = test::truth_of({box}, kEdge);
  for (const int low : {-1, 0}) {
    EXPECT_TRUE(truth.contains({low, 5, 5}, 1));
    EXPECT_TRUE(truth.contains({9 - low, 5, 5}, 1));  // layers 9 and 10 around x = 1
  }
  for (const int beside : {-2, 1, 8, 11}) EXPECT_FALSE(truth.contains({beside, 5, 5}, 1));
}

TEST(HandCount, BoxWithAllFacesOffTheLattice) {
  // Touched: 0 to 10, 11 on each axis. Inside: 1 to 9, 9 on each axis. 11^3 - 9^3.
  expect_counts(box_shape({0.05, 0.05, 0.05}, {1.05, 1.05, 1.05}, 1), 602, 0);
}

TEST(HandCount, BoxWithFacesOnOneAxisOnAndOnOthersOffTheLattice) {
  // x on the lattice: touched -1 to 4 (6), inside 1 to 2. y off: touched 0 to 3 (4), inside 1 to 2.
  // z in two layers, both with a face: none inside. 6 * 4 * 2; x = -1 and 4 by contact: 2 * 4 * 2.
  expect_counts(box_shape({0, 0.05, 0.03}, {0.4, 0.35, 0.17}, 1), 48, 16);
}

TEST(HandCount, BoxWithinOneVoxel) {
  expect_counts(box_shape({0.32, 0.34, 0.31}, {0.37, 0.36, 0.39}, 1), 1, 0);
}

TEST(HandCount, BoxTurnedToADiamond) {
  // |x| + |y| <= 2 voxels; z has a face in both of its layers. Touched columns: a + b <= 2, six
  // pairs of four columns. Those of a + b = 2 meet it at a corner only: three pairs.
  const double half = kEdge * std::numbers::sqrt2;
  const Shape box = placed(ShapeKind::box, {half, half, 0.05}, {0, 0, 0.1});
  expect_counts(turned(box, std::numbers::pi / 4, Vector3d::UnitZ()), 2 * 24, 2 * 12);
}

TEST(HandCount, PlaneWithinALayer) {
  // One layer. Edges on the lattice: 12 x 12 columns, 10 x 10 of them not by contact.
  expect_counts(placed(ShapeKind::plane, {0.5, 0.5, 0}, {0.5, 0.5, 0.35}), 144, 44);
  // Edges off the lattice: 10 x 10.
  expect_counts(placed(ShapeKind::plane, {0.45, 0.45, 0}, {0.5, 0.5, 0.35}), 100, 0);
}

TEST(HandCount, PlaneOnTheLattice) {
  expect_counts(placed(ShapeKind::plane, {0.5, 0.5, 0}, {0.5, 0.5, 0.3}), 2 * 144, 2 * 144);
}

TEST(HandCount, PlaneTiltedBy45Degrees) {
  // z = x from 0 to 4 voxels. In the plane of x and z: the squares on the diagonal, -1 to 4, and
  // two beside it at each of the five corners 0 to 4: 6 + 10. y from 1 to 3: touched 0 to 3. Not by
  // contact: the diagonal from 0 to 3 in y = 1 and 2.
  const Shape plane =
      placed(ShapeKind::plane, {0.2 * std::numbers::sqrt2, 0.1, 0}, {0.2, 0.2, 0.2});
  expect_counts(turned(plane, -std::numbers::pi / 4, Vector3d::UnitY()), 64, 64 - 8);
}

TEST(HandCount, SphereOfTwoVoxels) {
  // Nearest corner within: a^2 + b^2 + c^2 <= 4 holds for 11 triples: 000, 100 (3), 110 (3), 111,
  // 200 (3). Farthest corner of 000 at sqrt(3) is inside, so it is not touched. 200 by contact.
  expect_counts(placed(ShapeKind::sphere, {0.2, 0, 0}, {0.3, -0.1, 0.7}), 10 * 8, 3 * 8);
}

TEST(HandCount, CylinderOfTwoVoxels) {
  // Ends half way through a layer: there all 6 * 4 columns of a^2 + b^2 <= 4; in the two layers
  // between all but the four of 00, whose farthest corner is inside. 20 (2) by contact.
  expect_counts(placed(ShapeKind::cylinder, {0.2, 0.15, 0}, {0.3, -0.1, 0.7}), 2 * 24 + 2 * 20,
                4 * 8);
}

TEST(HandCount, CapsuleOfTwoVoxels) {
  // Two layers of the cylinder's side and the halves of the sphere.
  expect_counts(placed(ShapeKind::capsule, {0.2, 0.1, 0}, {0.3, -0.1, 0.7}), 2 * 20 + 80,
                2 * 8 + 24);
}

TEST(HandCount, EllipsoidOfFourByTwoByTwoVoxels) {
  // a^2 + 4 b^2 + 4 c^2 <= 16 <= (a+1)^2 + 4 (b+1)^2 + 4 (c+1)^2. b c = 00: a = 2, 3 and, by
  // contact, 4; 10 and 01: a = 0 to 3; 11: a = 0 to 2; 20 and 02: a = 0 by contact.
  expect_counts(placed(ShapeKind::ellipsoid, {0.4, 0.2, 0.2}, {0.3, -0.1, 0.7}),
                (3 + 2 * 4 + 3 + 2) * 8, 3 * 8);
}

TEST(HandCount, TriangleWithinALayer) {
  // x, y >= 0 and x + y <= 4 voxels. i, j >= 0: i + j <= 4, 15 voxels, the five of i + j = 4 by
  // contact. Row and column -1 by contact: -1 to 4 each, 11 in all.
  expect_counts(
      placed(ShapeKind::mesh, {0, 0, 0}, {0, 0, 0.05}, {{{{0, 0, 0}, {0.4, 0, 0}, {0, 0.4, 0}}}}),
      26, 16);
}

TEST(HandCount, ClosedMeshOfABoxIsItsSurface) {
  for (const Vector3d& low :
       {Vector3d(0, 0, 0), Vector3d(0.05, 0.02, 0.07), Vector3d(0, 0.03, 1)}) {
    const Vector3d half(0.2, 0.15, 0.3);
    const auto mesh = test::truth_of(
        {placed(ShapeKind::mesh, {0, 0, 0}, low + half, test::box_mesh(half))}, kEdge);
    const auto box = test::truth_of({box_shape(low, low + 2 * half, 1)}, kEdge);
    EXPECT_TRUE(std::ranges::equal(mesh.voxels(), box.voxels()));
  }
}

TEST(HandCount, EpsilonReachesAsFarAsItSays) {
  // Faces just inside the lattice planes 0 and 0.4: by less than epsilon, 6^3 - 2^3 voxels, those
  // beyond the planes by epsilon alone; by more, 4^3 - 2^3.
  const auto inset = [](double by) {
    const double low = by, high = 0.4 - by;
    return test::truth_of({box_shape({low, low, low}, {high, high, high}, 1)}, kEdge, 0.0005);
  };
  EXPECT_EQ(inset(0.0005 - 1e-6).count(1), 208u);
  EXPECT_EQ(test::touch_only_count(inset(0.0005 - 1e-6)), 208u - 56u);
  EXPECT_EQ(inset(0.0005).count(1), 208u);  // contact of the widened cube
  EXPECT_EQ(inset(0.0005 + 1e-6).count(1), 56u);
}

}  // namespace
}  // namespace mapscore::eval
