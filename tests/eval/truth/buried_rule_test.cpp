// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#include "tests/eval/truth/truth_scenes.hpp"

#include <gtest/gtest.h>

// The buried rule of docs/metrics.md, counted by hand.

namespace mapscore::eval {
namespace {

using test::box_shape;
using test::truth_of;

TEST(BuriedRule, ABoxInsideABoxIsGone) {
  const auto truth = truth_of(
      {box_shape({0, 0, 0}, {1, 1, 1}, 1), box_shape({0.3, 0.3, 0.3}, {0.62, 0.57, 0.7}, 2)}, 0.05,
      0.0005);
  EXPECT_EQ(truth.count(2), 0u);
  EXPECT_EQ(truth.count(1), 22u * 22 * 22 - 18u * 18 * 18);
}

TEST(BuriedRule, ABoxHalfInAnotherKeepsWhatStandsOut) {
  const auto truth = truth_of(
      {box_shape({0, 0, 0}, {1, 1, 1}, 1), box_shape({0.35, 0.35, 0.85}, {0.65, 0.65, 1.15}, 2)},
      0.1);
  // Green: layer 8 lies inside red; layer 9 reaches the plane of red's top, which is no inside; 12
  // + 12 voxels of the sides and 16 of the top.
  EXPECT_EQ(truth.count(2), 40u);
  EXPECT_FALSE(truth.contains({3, 3, 8}, 2));
  EXPECT_TRUE(truth.contains({3, 3, 9}, 2));
  // Red: its top within green is gone in the 2 x 2 columns wholly inside, on both layers.
  EXPECT_EQ(truth.count(1), 12u * 12 * 12 - 8u * 8 * 8 - 8);
  EXPECT_FALSE(truth.contains({4, 4, 9}, 1));
  EXPECT_FALSE(truth.contains({4, 4, 10}, 1));
  EXPECT_TRUE(truth.contains({3, 4, 9}, 1));
}

TEST(BuriedRule, OnlyASingleSolidBuries) {
  const auto scene = [](double left_ends, double right_begins) {
    return std::vector<Shape>{box_shape({-1, -1, -1}, {left_ends, 1, 1}, 1),
                              box_shape({right_begins, -1, -1}, {1, 1, 1}, 2),
                              box_shape({-0.03, -0.03, -0.03}, {0.07, 0.07, 0.07}, 3)};
  };
  // A seam at x = 0.02 leaves undecided boxes in the middle layer: 3 x 3 voxels but the inner one.
  const auto seam = truth_of(scene(0.02, 0.02), 0.05);
  EXPECT_EQ(seam.count(3), 8u);
  EXPECT_TRUE(seam.contains({0, -1, -1}, 3));
  // Where the two overlap by more than one of the 512 boxes, each box lies in one of them.
  EXPECT_EQ(truth_of(scene(0.03, 0.01), 0.05).count(3), 0u);
}

TEST(BuriedRule, ASlitFinerThanTheFinestCutStaysOpen) {
  // Two solids 1 mm apart bury neither of their faces at the slit, though no one could look in.
  const auto truth = truth_of({box_shape({0, 0, 0}, {0.512, 0.512, 0.512}, 1),
                               box_shape({0.513, 0, 0}, {1, 0.512, 0.512}, 2)},
                              0.05);
  EXPECT_TRUE(truth.contains({10, 5, 5}, 1));
  EXPECT_TRUE(truth.contains({10, 5, 5}, 2));
}

TEST(BuriedRule, PlanesAndMeshesAreBuriedButBuryNothing) {
  Shape plane;
  plane.kind = ShapeKind::plane;
  plane.size = {0.2, 0.2, 0};
  plane.instance = 2;
  plane.T_world_shape.translation() = Eigen::Vector3d(0.5, 0.5, 0.52);
  Shape mesh;
  mesh.kind = ShapeKind::mesh;
  mesh.instance = 3;
  mesh.triangles = {{Eigen::Vector3d(0.5, 0.5, 0.8), Eigen::Vector3d(0.6, 0.5, 0.8),
                     Eigen::Vector3d(0.5, 0.5, 1.33)}};
  const Shape solid = box_shape({0, 0, 0}, {1, 1, 1}, 1);
  const auto truth = truth_of({solid, plane, mesh}, 0.05);
  EXPECT_EQ(truth.count(2), 0u);
  EXPECT_GT(truth.count(3), 0u);
  EXPECT_FALSE(truth.contains({10, 9, 17}, 3));
  EXPECT_TRUE(truth.contains({10, 9, 21}, 3));
  EXPECT_EQ(truth.count(1), truth_of({solid}, 0.05).count(1));
}

TEST(BuriedRule, SolidsOfTheSameBodyBuryEachOther) {
  Shape ball;
  ball.kind = ShapeKind::sphere;
  ball.instance = 1;
  ball.size = {0.1, 0, 0};
  ball.T_world_shape.translation() = Eigen::Vector3d(0.5, 0.5, 0.5);
  const Shape solid = box_shape({0, 0, 0}, {1, 1, 1}, 1);
  EXPECT_EQ(truth_of({solid, ball}, 0.05).count(1), truth_of({solid}, 0.05).count(1));
  // Two equal solids in one place: the boundary of each meets the other's, so both stay.
  EXPECT_EQ(truth_of({solid, solid}, 0.05).count(1), truth_of({solid}, 0.05).count(1));
}

}  // namespace
}  // namespace mapscore::eval
