// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#include "sim/world/shape_bounds.hpp"

#include "core/random_stream.hpp"
#include "sim/world/facets.hpp"

#include <gtest/gtest.h>

namespace mapscore::sim {
namespace {

Pose random_pose(RandomStream& random) {
  Pose pose = Pose::Identity();
  pose.linear() =
      Eigen::Quaterniond(random.normal(), random.normal(), random.normal(), random.normal())
          .normalized()
          .toRotationMatrix();
  pose.translation() = Eigen::Vector3d(random.normal(), random.normal(), random.normal());
  return pose;
}

struct Kind {
  ShapeKind kind;
};
void PrintTo(const Kind& param, std::ostream* out) {
  *out << name_of(param.kind);
}

class ShapeBoundsTest : public ::testing::TestWithParam<Kind> {};

TEST_P(ShapeBoundsTest, AreTightAboutItsFacets) {
  RandomStream random(7, "bounds");
  for (int i = 0; i < 20; ++i) {
    Shape shape;
    shape.kind = GetParam().kind;
    shape.T_world_shape = random_pose(random);
    shape.size = {0.2 + random.uniform(), 0.2 + random.uniform(), 0.2 + random.uniform()};
    Eigen::AlignedBox3d touched;
    for (const Eigen::Vector3d& v : facets_of(shape.kind, shape.size, 1e-4).vertices)
      touched.extend(shape.T_world_shape * v);
    const Eigen::AlignedBox3d bounds = bounds_of(shape);
    EXPECT_LT((touched.min() - bounds.min()).maxCoeff(), 5e-3);
    EXPECT_TRUE((bounds.min().array() <= touched.min().array() + 1e-9).all());
    EXPECT_TRUE((bounds.max().array() >= touched.max().array() - 1e-9).all());
    EXPECT_LT((bounds.max() - touched.max()).maxCoeff(), 5e-3);
  }
}

INSTANTIATE_TEST_SUITE_P(Round, ShapeBoundsTest,
                         ::testing::Values(Kind{ShapeKind::sphere}, Kind{ShapeKind::capsule},
                                           Kind{ShapeKind::ellipsoid}, Kind{ShapeKind::cylinder}));

TEST(ShapeBounds, OfFlatThings) {
  Shape box;
  box.size = {1, 2, 3};
  box.T_world_shape = planar_pose(10, 20, M_PI_2);
  EXPECT_TRUE(bounds_of(box).isApprox(
      Eigen::AlignedBox3d(Eigen::Vector3d(8, 19, -3), Eigen::Vector3d(12, 21, 3))));
  Shape plane = box;
  plane.kind = ShapeKind::plane;
  plane.size.z() = 0;
  EXPECT_EQ(bounds_of(plane).sizes().z(), 0.0);
  Shape mesh = box;
  mesh.kind = ShapeKind::mesh;
  EXPECT_TRUE(bounds_of(mesh).isEmpty());
  mesh.triangles = {{Eigen::Vector3d(0, 0, 0), Eigen::Vector3d(1, 0, 0), Eigen::Vector3d(0, 0, 2)}};
  EXPECT_TRUE(bounds_of(mesh).isApprox(
      Eigen::AlignedBox3d(Eigen::Vector3d(10, 20, 0), Eigen::Vector3d(10, 21, 2)), 1e-9));
}

}  // namespace
}  // namespace mapscore::sim
