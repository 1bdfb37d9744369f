// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#include "eval/score/distances/thin_score.hpp"

#include "core/error.hpp"
#include "eval/score/metrics.hpp"
#include "eval/truth/shapes/shape_tests.hpp"

#include <gtest/gtest.h>

namespace mapscore::eval {
namespace {

Shape box(const Eigen::Vector3d& centre, const Eigen::Vector3d& half) {
  Shape shape;
  shape.kind = ShapeKind::box;
  shape.instance = 1;
  shape.size = half;
  shape.T_world_shape.translation() = centre;
  return shape;
}

ClassTable one_class() {
  ClassTable table;
  table.classes.push_back({1, "chair", {}, true});
  table.instances.push_back({1, "chair_1", 1});
  return table;
}

TEST(ThinScore, TwoNarrowSidesMakeAThinPart) {
  EXPECT_TRUE(is_thin(box({0, 0, 0}, {0.02, 0.02, 0.3})));
  EXPECT_TRUE(is_thin(box({0, 0, 0}, {0.3, 0.029, 0.01})));
  EXPECT_FALSE(is_thin(box({0, 0, 0}, {0.2, 0.2, 0.01})));   // a seat is a plate
  EXPECT_FALSE(is_thin(box({0, 0, 0}, {0.03, 0.03, 0.3})));  // 6 cm is not below 6 cm
  Shape capsule = box({0, 0, 0}, {0.02, 0.2, 0});
  capsule.kind = ShapeKind::capsule;
  EXPECT_TRUE(is_thin(capsule));
  Shape mesh = box({0, 0, 0}, {0, 0, 0});
  mesh.kind = ShapeKind::mesh;
  mesh.triangles = {
      {Eigen::Vector3d(0, 0, 0), Eigen::Vector3d(0.04, 0, 0.5), Eigen::Vector3d(0, 0.05, 1)}};
  EXPECT_TRUE(is_thin(mesh));
}

/// A seat at z = 0.45 and a leg at x = y = 0.225 below it, voxels of 5 cm: counted by hand.
TEST(ThinScore, CountsTheVoxelsOfTheLeg) {
  const double edge_m = 0.05;
  const std::vector<Shape> shapes{box({0.2, 0.2, 0.475}, {0.2, 0.2, 0.02}),
                                  box({0.225, 0.225, 0.225}, {0.015, 0.015, 0.22})};
  const ClassTable table = one_class();
  const SurfaceTruth surface = surface_truth(shapes, table, Pose::Identity(), {edge_m, 0.0005, 1});
  const CubeDistance to_class = cube_distance(prepare(shapes, Pose::Identity()), table, edge_m);
  const CubeDistance to_thin = distance_to_thin(shapes, table, Pose::Identity(), edge_m);
  // leg voxel found, leg voxel missed, seat voxel; beside the leg, far beside the seat
  const VisibleTruth visible({{{4, 4, 2}, 1, 5}, {{4, 4, 3}, 1, 5}, {{1, 1, 9}, 1, 5}}, edge_m);
  const MapSnapshot map(
      {{{4, 4, 2}, 1, 1.0}, {{5, 4, 2}, 1, 1.0}, {{1, 1, 9}, 1, 1.0}, {{0, 0, 11}, 1, 1.0}});
  Counts counts = zero_counts(2, {.asked = {.thin = true}});
  score_thin(map, 0.5, surface, visible, {to_class, to_thin}, counts);
  EXPECT_EQ(*counts[1].thin, (ThinCounts{2, 1, 2, 1}));
  const std::vector<Metric> metrics = metrics_of(counts[1]);
  EXPECT_EQ(value_of(metrics, "thin_precision"), 0.5);
  EXPECT_EQ(value_of(metrics, "thin_recall"), 0.5);
  EXPECT_EQ(value_of(metrics, "thin_f1"), 0.5);
}

TEST(ThinScore, PoolsOnlyWithItsLike) {
  Counts with = zero_counts(2, {.asked = {.thin = true}});
  const Counts without = zero_counts(2, {});
  EXPECT_THROW(pool_into(with, without), Error);
  with[1].thin = ThinCounts{4, 3, 2, 1};
  Counts total = with;
  pool_into(total, with);
  EXPECT_EQ(*total[1].thin, (ThinCounts{8, 6, 4, 2}));
}

}  // namespace
}  // namespace mapscore::eval
