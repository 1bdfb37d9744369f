// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#include "eval/truth/truth_cost.hpp"

#include "core/error.hpp"
#include "tests/eval/truth/truth_scenes.hpp"

#include <gtest/gtest.h>

#include <limits>
#include <numbers>
#include <string>
#include <vector>

namespace mapscore::eval {
namespace {

using Eigen::Vector3d;
using test::box_shape;

constexpr double kInfinite = std::numeric_limits<double>::infinity();

Shape shape_of(ShapeKind kind, const Vector3d& size) {
  Shape shape;
  shape.kind = kind;
  shape.instance = 1;
  shape.size = size;
  shape.T_world_shape.translation() = Vector3d(0.413, -0.127, 0.291);
  shape.T_world_shape.linear() =
      (Eigen::AngleAxisd(0.7, Vector3d(1, 2, -1).normalized())).toRotationMatrix();
  return shape;
}

/// A ball of triangles, `rings` from pole to pole.
Shape mesh_ball(double radius_m, int rings) {
  const auto at = [&](int ring, int step) {
    const double polar = std::numbers::pi * ring / rings, azimuth = std::numbers::pi * step / rings;
    return Vector3d(radius_m * std::sin(polar) * std::cos(azimuth),
                    radius_m * std::sin(polar) * std::sin(azimuth), radius_m * std::cos(polar));
  };
  Shape mesh = shape_of(ShapeKind::mesh, Vector3d::Zero());
  for (int ring = 0; ring < rings; ++ring)
    for (int step = 0; step < 2 * rings; ++step) {
      mesh.triangles.push_back({at(ring, step), at(ring + 1, step), at(ring + 1, step + 1)});
      mesh.triangles.push_back({at(ring, step), at(ring + 1, step + 1), at(ring, step + 1)});
    }
  return mesh;
}

/// A room with furniture whose boards are thinner than a voxel, some inside one another.
std::vector<Shape> small_room() {
  std::vector<Shape> room;
  room.push_back(box_shape({0.0, 0.0, -0.1}, {2.013, 1.717, 0.003}, 0));
  room.push_back(box_shape({-0.1, 0.0, 0.0}, {0.011, 1.717, 1.2}, 0));
  for (int board = 0; board < 4; ++board)
    room.push_back(box_shape({0.2, 0.3, 0.1 + 0.25 * board}, {1.1, 0.6, 0.118 + 0.25 * board}, 2));
  room.push_back(box_shape({0.2, 0.3, 0.0}, {0.218, 0.6, 1.0}, 2));
  room.push_back(shape_of(ShapeKind::sphere, {0.09, 0, 0}));
  room.push_back(shape_of(ShapeKind::cylinder, {0.04, 0.12, 0}));
  room.push_back(mesh_ball(0.15, 24));
  return room;
}

void expect_within_a_factor_of_two(const std::vector<Shape>& shapes, double edge_m,
                                   double epsilon_m) {
  const SurfaceOptions options{edge_m, epsilon_m, 1};
  const Pose T_map_world = map_from_world({0.0031, 0.0017, 0}, 0.2);
  const double made = static_cast<double>(
      surface_truth(shapes, test::four_classes(), T_map_world, options).voxels().size());
  const double told = truth_cost(shapes, T_map_world, options).voxels;
  EXPECT_GT(told, made / 2) << "edge " << edge_m << " epsilon " << epsilon_m;
  EXPECT_LT(told, made * 2) << "edge " << edge_m << " epsilon " << epsilon_m;
}

TEST(TruthCost, TellsTheVoxelsOfEveryKindOfShapeWithinAFactorOfTwo) {
  const Shape shapes[] = {shape_of(ShapeKind::box, {0.3, 0.2, 0.1}),
                          shape_of(ShapeKind::box, {0.3, 0.2, 0.002}),
                          shape_of(ShapeKind::plane, {0.3, 0.4, 0}),
                          shape_of(ShapeKind::sphere, {0.2, 0, 0}),
                          shape_of(ShapeKind::ellipsoid, {0.1, 0.3, 0.2}),
                          shape_of(ShapeKind::capsule, {0.08, 0.2, 0}),
                          shape_of(ShapeKind::cylinder, {0.12, 0.2, 0}),
                          shape_of(ShapeKind::cylinder, {0.12, 0.002, 0}),
                          mesh_ball(0.2, 12),
                          mesh_ball(0.2, 60)};
  for (const Shape& shape : shapes) {
    SCOPED_TRACE(name_of(shape.kind));
    for (const double edge_m : {0.005, 0.01, 0.03})
      for (const double epsilon_m : {0.0, 0.0005})
        expect_within_a_factor_of_two({shape}, edge_m, epsilon_m);
  }
}

TEST(TruthCost, TellsTheVoxelsOfARoomWithinAFactorOfTwo) {
  for (const double edge_m : {0.005, 0.01, 0.02, 0.05})
    expect_within_a_factor_of_two(small_room(), edge_m, 0.0005);
}

TEST(TruthCost, OfHalfTheEdgeIsFourTimesTheVoxels) {
  const std::vector<Shape> box{shape_of(ShapeKind::box, {0.5, 0.5, 0.5})};
  const auto voxels = [&](double edge_m) {
    return truth_cost(box, Pose::Identity(), {edge_m, 0.0}).voxels;
  };
  EXPECT_NEAR(voxels(0.001) / voxels(0.002), 4.0, 0.01);
  const TruthCost fine = truth_cost(box, Pose::Identity(), {0.001, 0.0}),
                  coarse = truth_cost(box, Pose::Identity(), {0.002, 0.0});
  EXPECT_GT(fine.bytes, 3 * coarse.bytes);
  EXPECT_GT(fine.seconds, 3 * coarse.seconds);
}

std::string refusal_of(double bytes, double available_bytes) {
  try {
    refuse_too_large({.voxels = 3.5e8, .bytes = bytes, .whole_view = 0, .seconds = 90}, 0.001,
                     available_bytes);
  } catch (const Error& error) {
    return error.what();
  }
  return "";
}

TEST(TruthCost, IsSaidWhenItIsMoreThanTheMachineShouldBeAskedFor) {
  EXPECT_EQ(refusal_of(8.4e9, kInfinite),
            "truth at 0.001 m: about 350 million voxels, 8.4 GB and 1.5 minutes; add --yes, or "
            "take larger voxels");
  EXPECT_EQ(refusal_of(3.9e9, kInfinite), "");
  EXPECT_EQ(refusal_of(0.9e9, 2e9), "");
  EXPECT_NE(refusal_of(1.1e9, 2e9), "");
  EXPECT_EQ(refusal_of(0.2e9, 0), "") << "little enough for any machine";
}

}  // namespace
}  // namespace mapscore::eval
