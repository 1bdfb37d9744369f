// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#include "tests/eval/truth/brute_force_shapes.hpp"
#include "tests/eval/truth/truth_scenes.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <vector>

// The buried rule on what homes are made of, counted by hand; see buried_rule_test.cpp for its
// finest cut and its limits. Red is class 1, green class 2, blue class 3.

namespace mapscore::eval {
namespace {

using Eigen::Vector3d;
using test::box_shape;
using test::placed;
using test::truth_of;

Shape of(InstanceId instance, Shape shape) {
  shape.instance = instance;
  return shape;
}

Shape ball(InstanceId instance, const Vector3d& centre, double radius) {
  return of(instance, placed(ShapeKind::sphere, {radius, 0, 0}, centre));
}

/// Rows of one class.
std::vector<SurfaceVoxel> rows_of(const SurfaceTruth& truth, ClassId class_id) {
  std::vector<SurfaceVoxel> rows;
  std::ranges::copy_if(truth.voxels(), std::back_inserter(rows),
                       [&](const SurfaceVoxel& row) { return row.class_id == class_id; });
  return rows;
}

TEST(Burial, TopOfALegInATablesPlate) {
  const Shape plate = box_shape({0, 0, 0.68}, {1, 1, 0.77}, 1);
  for (const InstanceId leg_of : {InstanceId{2}, InstanceId{1}}) {
    const Shape leg = box_shape({0.42, 0.42, 0}, {0.58, 0.58, 0.72}, leg_of);
    for (const double epsilon_m : {0.0, 0.0005}) {
      const auto truth = truth_of({plate, leg}, 0.05, epsilon_m);
      // Leg: columns 8 to 11. Its foot on the lattice fills 4 x 4 of the layers -1 and 0, its sides
      // a ring of 12 in the layers 1 to 13, the last of which it leaves for the plate at 0.68.
      // Layer 14 lies within the plate: sides and top at 0.72 are gone.
      const std::size_t leg_voxels = 2 * 16 + 13 * 12;
      // Plate: -1 to 20 across, layers 13 to 15, of which 18 x 18 in layer 14 are inside. Its
      // underside is gone in the 2 x 2 columns within the leg.
      const std::size_t plate_voxels = 22 * 22 * 3 - 18 * 18 - 4;
      if (leg_of == 2) {
        EXPECT_EQ(truth.count(2), leg_voxels);
        EXPECT_EQ(truth.count(1), plate_voxels);
        EXPECT_TRUE(truth.contains({8, 8, 13}, 2));
        EXPECT_FALSE(truth.contains({8, 8, 14}, 2));
        EXPECT_FALSE(truth.contains({9, 9, 14}, 2));
      } else {  // the same body: 12 voxels of layer 13 belong to both
        EXPECT_EQ(truth.count(1), leg_voxels + plate_voxels - 12);
      }
      EXPECT_FALSE(truth.touches_any({9, 9, 13}));
      EXPECT_FALSE(truth.touches_any({9, 9, 14}));
      EXPECT_TRUE(truth.contains({7, 7, 13}, 1));
    }
  }
}

TEST(Burial, LegThatEndsAtThePlateKeepsItsTop) {
  // Contact is no burial: the leg is as it would be alone, the plate too.
  const Shape plate = box_shape({0, 0, 0.7}, {1, 1, 0.75}, 1);
  const Shape leg = box_shape({0.42, 0.42, 0}, {0.58, 0.58, 0.7}, 2);
  const auto truth = truth_of({plate, leg}, 0.05);
  EXPECT_EQ(rows_of(truth, 2), rows_of(truth_of({leg}, 0.05), 2));
  EXPECT_EQ(rows_of(truth, 1), rows_of(truth_of({plate}, 0.05), 1));
  EXPECT_TRUE(truth.contains({9, 9, 13}, 2));
  EXPECT_TRUE(truth.contains({9, 9, 14}, 2));
}

TEST(Burial, SphereWhollyInABox) {
  const Shape box = box_shape({0, 0, 0}, {1, 1, 1}, 1);
  for (const double edge_m : {0.01, 0.05, 0.1}) {
    for (const InstanceId body : {InstanceId{0}, InstanceId{1}, InstanceId{2}}) {
      const auto truth = truth_of({box, ball(body, {0.47, 0.52, 0.44}, 0.31)}, edge_m, 0.0005);
      EXPECT_TRUE(std::ranges::equal(truth.voxels(), truth_of({box}, edge_m, 0.0005).voxels()));
    }
  }
}

TEST(Burial, SphereThatTouchesItsBoxFromInsideKeepsTheContacts) {
  // At each face it touches a corner of the lattice. Beyond the face: the four columns around it.
  // Within: those whose finest boxes at the face, 12.5 mm high, hold sphere, which is up to 0.111 m
  // from the contact: the four and the eight beside them, of which the nearest corner is at 0.1.
  const auto truth =
      truth_of({box_shape({0, 0, 0}, {1, 1, 1}, 1), ball(2, {0.5, 0.5, 0.5}, 0.5)}, 0.1);
  EXPECT_EQ(truth.count(2), 6u * (4 + 4 + 8));
  EXPECT_EQ(truth.count(1), 1216u);
}

TEST(Burial, SphereSunkToItsMiddleIntoABox) {
  // Radius of two voxels about a corner of the lattice, at the box's top. Above: half of its 80
  // voxels. Below, layer 9 reaches the top's plane, and all of its 20 hold a piece of the equator
  // there; layers 8 and 7 are gone.
  const auto truth =
      truth_of({box_shape({0, 0, 0}, {1, 1, 1}, 1), ball(2, {0.5, 0.5, 1}, 0.2)}, 0.1);
  EXPECT_EQ(truth.count(2), 40u + 20u);
  EXPECT_FALSE(truth.contains({4, 4, 8}, 2));
  EXPECT_TRUE(truth.contains({4, 4, 11}, 2));
  // The box loses its top in the 2 x 2 columns that lie within the sphere, on both layers.
  EXPECT_EQ(truth.count(1), 1216u - 8u);
}

// A die, turned, within solids of every kind, and half out of them.
TEST(Burial, EverySolidBuries) {
  const Pose pose = map_from_world({0.213, -0.154, 0.071}, 0.7);
  const auto turned = [&](const Shape& shape) {
    Shape moved = shape;
    moved.T_world_shape =
        pose * Eigen::AngleAxisd(0.6, Vector3d(1, 2, 0).normalized()) * shape.T_world_shape;
    return moved;
  };
  const Shape inner = turned(of(2, placed(ShapeKind::box, {0.05, 0.05, 0.05}, {0, 0, 0})));
  const Shape across = turned(of(2, placed(ShapeKind::box, {0.05, 0.05, 0.05}, {0.3, 0, 0})));
  for (const Shape& solid : {placed(ShapeKind::box, {0.3, 0.2, 0.25}, {0, 0, 0}),
                             placed(ShapeKind::sphere, {0.3, 0, 0}, {0, 0, 0}),
                             placed(ShapeKind::ellipsoid, {0.3, 0.2, 0.25}, {0, 0, 0}),
                             placed(ShapeKind::cylinder, {0.3, 0.2, 0}, {0, 0, 0}),
                             placed(ShapeKind::capsule, {0.3, 0.1, 0}, {0, 0, 0})}) {
    SCOPED_TRACE(name_of(solid.kind));
    EXPECT_EQ(truth_of({turned(solid), inner}, 0.02).count(2), 0u);
    const std::size_t alone = truth_of({across}, 0.02).count(2);
    const std::size_t kept = truth_of({turned(solid), across}, 0.02).count(2);
    EXPECT_GT(kept, alone / 3);
    EXPECT_LT(kept, alone - alone / 5);
  }
}

TEST(Burial, ClosedMeshesAndPlanesBuryNothing) {
  const Shape inner = ball(2, {0.5, 0.5, 0.5}, 0.2);
  const auto alone = rows_of(truth_of({inner}, 0.05), 2);
  const Shape mesh =
      placed(ShapeKind::mesh, {0, 0, 0}, {0.5, 0.5, 0.5}, test::box_mesh({0.4, 0.4, 0.4}));
  const Shape plane = of(3, placed(ShapeKind::plane, {1, 1, 0}, {0.5, 0.5, 0.9}));
  EXPECT_EQ(rows_of(truth_of({mesh, plane, inner}, 0.05), 2), alone);
  // The same walls as a solid bury it.
  EXPECT_EQ(truth_of({box_shape({0.1, 0.1, 0.1}, {0.9, 0.9, 0.9}, 1), inner}, 0.05).count(2), 0u);
}

TEST(Burial, TwoSolidsBuryTogetherOnlyWhatEitherBuries) {
  // A ball's voxels that span the seam at x = 0.025 lie in neither solid: in both together. The
  // others lie in one.
  const auto scene = [](bool left, bool right) {
    std::vector<Shape> shapes{ball(3, {0.025, 0.5, 0.5}, 0.2)};
    if (left) shapes.push_back(box_shape({-1, 0, 0}, {0.025, 1, 1}, 1));
    if (right) shapes.push_back(box_shape({0.025, 0, 0}, {1, 1, 1}, 2));
    return rows_of(truth_of(shapes, 0.05), 3);
  };
  const auto alone = scene(false, false), both = scene(true, true);
  std::vector<SurfaceVoxel> seam;
  std::ranges::copy_if(alone, std::back_inserter(seam), [](const SurfaceVoxel& row) {
    return row.key.i == 0;  // a great circle runs through every one of these within the seam
  });
  ASSERT_GT(seam.size(), 20u);
  EXPECT_LT(both.size(), alone.size() / 2);
  for (const SurfaceVoxel& row : both) EXPECT_EQ(row.key.i, 0);
  for (const SurfaceVoxel& row : both) EXPECT_TRUE(std::ranges::count(seam, row));
  EXPECT_GT(both.size(), 20u);
  EXPECT_GT(scene(true, false).size(), both.size());
  EXPECT_GT(scene(false, true).size(), both.size());
}

TEST(Burial, FacesInContactStayOnAndOffTheLattice) {
  for (const double epsilon_m : {0.0, 0.0005}) {
    for (int n = 0; n < 20; ++n) {
      const double x = 0.4 + n / 100.0;  // every fifth on the lattice
      SCOPED_TRACE(::testing::Message() << "face at " << x << " epsilon " << epsilon_m);
      const Shape left = box_shape({0.1, 0.1, 0.1}, {x, 0.4, 0.4}, 1);
      const Shape right = box_shape({x, 0.1, 0.1}, {x + 0.3, 0.4, 0.4}, 2);
      const auto truth = truth_of({left, right}, 0.05, epsilon_m);
      EXPECT_EQ(rows_of(truth, 1), rows_of(truth_of({left}, 0.05, epsilon_m), 1));
      EXPECT_EQ(rows_of(truth, 2), rows_of(truth_of({right}, 0.05, epsilon_m), 2));
      // The middle of the face: the voxels on both sides of a lattice plane, else the one.
      const int k = 8 + n / 5;
      EXPECT_TRUE(truth.contains({k, 5, 5}, 1) && truth.contains({k, 5, 5}, 2));
      EXPECT_EQ(truth.contains({k - 1, 5, 5}, 1), n % 5 == 0);
      EXPECT_EQ(truth.contains({k - 1, 5, 5}, 2), n % 5 == 0);
    }
  }
}

TEST(Burial, FacesOfTiltedBoxesInContactStay) {
  const Pose pose = map_from_world({0.213, -0.154, 0.071}, 0.7) *
                    Eigen::AngleAxisd(0.6, Vector3d(1, 2, 0).normalized());
  Shape left = box_shape({-0.3, -0.1, -0.1}, {0, 0.1, 0.1}, 1);
  Shape right = box_shape({0, -0.1, -0.1}, {0.3, 0.1, 0.1}, 2);
  for (Shape* shape : {&left, &right}) shape->T_world_shape = pose * shape->T_world_shape;
  const auto truth = truth_of({left, right}, 0.02);
  EXPECT_EQ(rows_of(truth, 1), rows_of(truth_of({left}, 0.02), 1));
  EXPECT_EQ(rows_of(truth, 2), rows_of(truth_of({right}, 0.02), 2));
}

}  // namespace
}  // namespace mapscore::eval
