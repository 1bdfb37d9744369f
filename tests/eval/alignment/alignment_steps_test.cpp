// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#include "core/geometry/voxel.hpp"
#include "eval/alignment/oriented_cloud.hpp"
#include "eval/alignment/point_to_plane.hpp"
#include "eval/alignment/shift_search.hpp"
#include "tests/eval/alignment/furnished_room.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace mapscore::eval {
namespace {

using Eigen::Vector3d;
using testing::box_at;
using testing::furnished_room;
using testing::inside_points;

/// Every kind of surface once, apart from each other.
std::vector<Shape> each_kind() {
  std::vector<Shape> shapes{box_at({0, 0, 0}, {0.3, 0.2, 0.1})};
  for (const auto& [kind, size] : {std::pair{ShapeKind::plane, Vector3d(0.3, 0.2, 0)},
                                   {ShapeKind::sphere, Vector3d(0.2, 0, 0)},
                                   {ShapeKind::capsule, Vector3d(0.1, 0.2, 0)},
                                   {ShapeKind::ellipsoid, Vector3d(0.3, 0.2, 0.1)},
                                   {ShapeKind::cylinder, Vector3d(0.2, 0.1, 0)}}) {
    Shape shape;
    shape.kind = kind;
    shape.size = size;
    shape.T_world_shape = planar_pose(static_cast<double>(shapes.size()), 0.1, 0.4);
    shapes.push_back(shape);
  }
  Shape mesh;
  mesh.kind = ShapeKind::mesh;
  mesh.triangles = {{Vector3d(0, 2, 0), Vector3d(0.4, 2, 0), Vector3d(0, 2.3, 0.2)}};
  shapes.push_back(mesh);
  return shapes;
}

TEST(SurfacePoints, LieOnTheSurfacesOfEveryKindWithTheirNormals) {
  constexpr double kSpacing_m = 0.02, kOff_m = 1e-4;
  for (const Shape& shape : each_kind()) {
    const auto pieces = prepare({shape}, Pose::Identity());
    const auto points = surface_points(pieces, kSpacing_m);
    EXPECT_GT(points.size(), 100u) << name_of(shape.kind);
    for (const auto& [p, n] : points) {
      EXPECT_NEAR(n.norm(), 1.0, 1e-9);
      const Box at = widened(Box(p, p), 1e-9);
      ASSERT_TRUE(meets_surface(pieces.front(), at)) << name_of(shape.kind);
      // A step along the normal leaves the surface, on one side the solid too.
      EXPECT_FALSE(meets_surface(pieces.front(), Box(p + kOff_m * n, p + kOff_m * n)));
      if (!shape.solid()) continue;
      EXPECT_NE(meets_solid(pieces.front(), Box(p + kOff_m * n, p + kOff_m * n)),
                meets_solid(pieces.front(), Box(p - kOff_m * n, p - kOff_m * n)));
    }
  }
}

TEST(SurfacePoints, GrowSparserWhereTheSurfacesAreVast) {
  EXPECT_EQ(bounded_spacing_m(prepare(furnished_room(), Pose::Identity())), 0.05);
  const auto ground = prepare({box_at({0, 0, -0.05}, {250, 250, 0.05})}, Pose::Identity());
  EXPECT_NEAR(bounded_spacing_m(ground), std::sqrt(500'200 / 3e6), 1e-9);
  // Of every kind the area is one that its points are spread over.
  for (Shape shape : each_kind()) {
    shape.size *= 1000;
    for (auto& triangle : shape.triangles)
      for (Vector3d& corner : triangle) corner *= 1000;
    const auto vast = prepare({shape}, Pose::Identity());
    const double spacing_m = bounded_spacing_m(vast);
    EXPECT_LT(surface_points(vast, 10 * spacing_m).size(), 33'000u) << name_of(shape.kind);
  }
}

TEST(SurfacePoints, NoneLiesInsideOfAnotherSolid) {
  const std::vector<Shape> shapes{box_at({0, 0, 0}, {0.5, 0.5, 0.5}),
                                  box_at({0, 0, 0.5}, {0.2, 0.2, 0.2})};
  const auto pieces = prepare(shapes, Pose::Identity());
  for (const OrientedPoint& point : surface_points(pieces, 0.05))
    for (const PreparedShape& piece : pieces)
      EXPECT_FALSE(inside_open(piece, Box(point.p, point.p))) << point.p.transpose();
}

TEST(OrientedCloud, KnowsVoxelsInAnyPoseAndNormalsOfPlanes) {
  Pose T = planar_pose(0.3, 0.4, 0.7);
  T.linear() = exp_rotation({0.1, -0.1, 0}) * T.linear();
  std::vector<Vector3d> layer, random;
  RandomStream stream(1, "cloud");
  for (int i = 0; i < 30; ++i)
    for (int j = 0; j < 30; ++j) {
      layer.push_back(T * centre_of({i, j, 0}, 0.05));
      layer.push_back(T * centre_of({i, 0, j}, 0.05));
      random.emplace_back(stream.uniform(), stream.uniform(), stream.uniform());
    }
  const OrientedCloud voxels = oriented_cloud(layer, 0.05, 10'000);
  // The three half edges are the lattice's axes, in some order and sign.
  const Eigen::Matrix3d axes = (T.linear().transpose() * voxels.half_edges / 0.025).cwiseAbs();
  EXPECT_NEAR(axes.sum(), 3.0, 0.01);
  EXPECT_NEAR(axes.maxCoeff(), 1.0, 0.01);
  std::size_t flat = 0;
  for (const OrientedPoint& point : voxels.points)
    flat += std::abs(point.n.dot(T.linear().col(2))) > 0.99 ||
            std::abs(point.n.dot(T.linear().col(1))) > 0.99;
  EXPECT_GT(flat, voxels.points.size() * 3 / 4);
  EXPECT_TRUE(oriented_cloud(random, 0.05, 10'000).half_edges.isZero());
  EXPECT_EQ(oriented_cloud(layer, 0.05, 100).points.size(), 100u);
}

TEST(ShiftSearch, FindsTheShiftsOfTwoCloudsAtOnce) {
  const auto points = inside_points(furnished_room(), 10'000);
  const ShiftSearch search(points);
  const std::array shifts{Vector3d(0.73, -0.41, 0.2), Vector3d(-9.3, 4.1, -1.7)};
  std::array<std::vector<Vector3d>, 2> clouds;
  for (std::size_t part = 0; part < 2; ++part)
    for (const Vector3d& p : points) clouds[part].emplace_back(p + shifts[part]);
  const std::vector<double> weights(points.size(), 2.0);
  const auto peaks = search.peaks(clouds, weights, 3);
  for (std::size_t part = 0; part < 2; ++part) {
    EXPECT_LT((peaks[part].front().by + shifts[part]).cwiseAbs().maxCoeff(), search.cell_m());
    // All of the weight lies within a cell of the surfaces there.
    EXPECT_GT(peaks[part].front().score, 0.6 * 2.0 * static_cast<double>(points.size()));
    EXPECT_LE(peaks[part].front().score, 2.001 * static_cast<double>(points.size()));
  }
}

TEST(PointToPlane, UndoesASmallMotion) {
  const SurfaceIndex surface(surface_points(prepare(furnished_room(), Pose::Identity()), 0.05));
  const OrientedCloud cloud = oriented_cloud(inside_points(furnished_room(), 20'000), 0.05, 5'000);
  const Pose motion = exp_pose((Vector6() << 0.1, -0.08, 0.05, 0.02, -0.01, 0.03).finished());
  std::vector<WeightedPoint> points;
  for (const OrientedPoint& point : cloud.points)
    points.push_back({{motion * point.p, motion.linear() * point.n}, 1.0});
  const Pose found = point_to_plane(points, surface, Pose::Identity(), {0.3, 0.02, 40});
  EXPECT_LT((found * motion).translation().norm(), 0.005);
  EXPECT_LT(Eigen::AngleAxisd((found * motion).linear()).angle(), 0.002);
  EXPECT_LT(share_at_surfaces(points, surface, Pose::Identity(), 0.02), 0.5);
  EXPECT_GT(share_at_surfaces(points, surface, found, 0.02), 0.9);
}

}  // namespace
}  // namespace mapscore::eval
