// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#include "eval/truth/moving_surface.hpp"

#include "core/random_stream.hpp"

#include <gtest/gtest.h>

#include <algorithm>

namespace mapscore::eval {
namespace {

constexpr ShapeKind kKinds[] = {ShapeKind::plane,     ShapeKind::sphere,   ShapeKind::capsule,
                                ShapeKind::ellipsoid, ShapeKind::cylinder, ShapeKind::box,
                                ShapeKind::mesh};

Pose random_pose(RandomStream& random, double spread_m) {
  Vector6 xi;
  for (int i = 0; i < 6; ++i) xi[i] = (i < 3 ? spread_m : 3.0) * (2 * random.uniform() - 1);
  return exp_pose(xi);
}

/// Shapes crowded into a cube of about a metre, so that they bury each other.
std::vector<Shape> crowd(RandomStream& random, int count) {
  std::vector<Shape> shapes;
  for (int i = 0; i < count; ++i) {
    Shape shape;
    shape.kind = kKinds[static_cast<std::size_t>(random.uniform() * 7) % 7];
    shape.instance = static_cast<InstanceId>(random.uniform() * 4);
    shape.T_world_shape = random_pose(random, 0.4);
    for (int axis = 0; axis < 3; ++axis) shape.size[axis] = 0.05 + 0.3 * random.uniform();
    if (shape.kind == ShapeKind::plane) shape.size.z() = 0;
    if (shape.kind == ShapeKind::mesh)
      for (int n = 0; n < 5; ++n) {
        Triangle triangle;
        for (Eigen::Vector3d& corner : triangle)
          for (int axis = 0; axis < 3; ++axis) corner[axis] = 0.6 * random.uniform() - 0.3;
        shape.triangles.push_back(triangle);
      }
    shapes.push_back(shape);
  }
  return shapes;
}

ClassTable three_classes() {
  ClassTable table;
  for (ClassId c = 1; c < 4; ++c) {
    table.classes.push_back({c, std::to_string(c), {}, true});
    table.instances.push_back({c, std::to_string(c), static_cast<ClassId>(c % 3 + 1)});
  }
  return table;
}

TEST(MovingSurface, IsRowByRowThatOfAllShapesAtOnce) {
  const ClassTable table = three_classes();
  std::size_t changed = 0;
  for (std::uint64_t seed = 0; seed < 12; ++seed) {
    RandomStream random(seed, "moving surface test");
    const std::vector<Shape> fixed = crowd(random, 9);
    std::vector<Shape> moving = crowd(random, 1 + static_cast<int>(seed % 6));
    const Pose T_map_world = random_pose(random, 2.0);
    const SurfaceOptions options{0.03 + 0.04 * random.uniform(), seed % 2 ? 0.0005 : 0.0, 1};
    const MovingSurface surface(fixed, table, T_map_world, options);
    for (int instant = 0; instant < 4; ++instant) {
      for (Shape& shape : moving) shape.T_world_shape = random_pose(random, 0.6);
      std::vector<Shape> all = fixed;
      all.insert(all.end(), moving.begin(), moving.end());
      const SurfaceTruth expected = surface_truth(all, table, T_map_world, options);
      const SurfaceTruth got = surface.at(moving);
      ASSERT_TRUE(std::ranges::equal(got.voxels(), expected.voxels())) << seed << ' ' << instant;
      // Not simply the two put together: what moves buries what stays.
      const SurfaceTruth alone = surface_truth(fixed, table, T_map_world, options);
      changed += static_cast<std::size_t>(std::ranges::count_if(
          alone.voxels(),
          [&](const SurfaceVoxel& row) { return !got.contains(row.key, row.class_id); }));
    }
  }
  EXPECT_GT(changed, 100u);
}

TEST(MovingSurface, OfNothingThatMovesIsThatOfWhatStays) {
  RandomStream random(5, "moving surface test");
  const std::vector<Shape> fixed = crowd(random, 6);
  const SurfaceOptions options{0.05, 0.0005, 1};
  const MovingSurface surface(fixed, three_classes(), Pose::Identity(), options);
  EXPECT_TRUE(std::ranges::equal(
      surface.at({}).voxels(),
      surface_truth(fixed, three_classes(), Pose::Identity(), options).voxels()));
}

}  // namespace
}  // namespace mapscore::eval
