// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#include "eval/truth/surface_truth.hpp"
#include "tests/eval/truth/surface_patches.hpp"
#include "tests/eval/truth/surface_witness.hpp"
#include "tests/eval/truth/truth_scenes.hpp"

#include <gtest/gtest.h>

#include <cmath>

// Shapes from 3 mm to 3 m, each axis on its own, so that needles, sheets and grains are among them,
// at any pose and at decimal ones, against the oracle of surface_witness.hpp.

namespace mapscore::eval {
namespace {

using Eigen::Vector3d;

constexpr double kEdges_m[] = {0.01, 0.02, 0.05, 0.1};
constexpr std::size_t kMostChecked = 600;

double log_uniform(RandomStream& random, double low, double high) {
  return low * std::pow(high / low, random.uniform());
}

/// Quarter turns about two axes, exact.
Eigen::Matrix3d quarter_turns(RandomStream& random) {
  Eigen::Matrix3d about_z, about_x;
  about_z << 0, -1, 0, 1, 0, 0, 0, 0, 1;
  about_x << 1, 0, 0, 0, 0, -1, 0, 1, 0;
  Eigen::Matrix3d R = Eigen::Matrix3d::Identity();
  for (int n = static_cast<int>(4 * random.uniform()); n > 0; --n) R *= about_z;
  for (int n = static_cast<int>(4 * random.uniform()); n > 0; --n) R *= about_x;
  return R;
}

Shape extreme_shape(ShapeKind kind, RandomStream& random) {
  Shape shape;
  shape.kind = kind;
  shape.instance = 1;
  shape.T_world_shape = test::random_pose(random, 2.0);
  for (int i = 0; i < 3; ++i) shape.size[i] = log_uniform(random, 0.003, 1.5);
  if (kind == ShapeKind::mesh) {
    for (int t = 0; t < 3; ++t) {
      Triangle triangle;
      for (Vector3d& corner : triangle) {
        for (int i = 0; i < 3; ++i) corner[i] = shape.size[i] * (2 * random.uniform() - 1);
      }
      shape.triangles.push_back(triangle);
    }
  }
  return shape;
}

/// The same on round numbers: whole half centimetres, square to the axes.
Shape decimal_shape(ShapeKind kind, RandomStream& random) {
  Shape shape = extreme_shape(kind, random);
  const auto rounded = [](double x) { return std::round(x * 200) / 200; };
  for (int i = 0; i < 3; ++i) shape.size[i] = std::max(0.005, rounded(shape.size[i]));
  for (Triangle& triangle : shape.triangles) {
    for (Vector3d& corner : triangle) corner = corner.unaryExpr(rounded);
  }
  shape.T_world_shape.linear() = quarter_turns(random);
  shape.T_world_shape.translation() = shape.T_world_shape.translation().unaryExpr(rounded);
  return shape;
}

/// An edge at which the shape is no more than some 60 voxels long.
double edge_for(const Shape& shape, RandomStream& random) {
  double length = 2 * shape.size.maxCoeff();
  if (shape.kind == ShapeKind::capsule) length += shape.size.x();
  double edge_m = kEdges_m[static_cast<int>(4 * random.uniform())];
  for (int i = 0; length / edge_m > 60 && i < 4; ++i) edge_m = std::max(edge_m, kEdges_m[i]);
  return edge_m;
}

void check_samples(const Shape& shape, const SurfaceTruth& truth) {
  constexpr int kSteps = 160;  // edges, rims and poles among them
  for (const test::Patch& patch : test::patches_of(shape, Pose::Identity())) {
    for (int i = 0; i <= kSteps; ++i) {
      for (int j = 0; j <= kSteps; ++j) {
        const Vector3d p = patch(double(i) / kSteps, double(j) / kSteps);
        ASSERT_TRUE(truth.contains(voxel_of(p, truth.edge_m()), 1)) << p.transpose();
      }
    }
  }
}

/// Rows spread evenly over the truth, each with one of its neighbours.
void check_rows(const Shape& shape, const SurfaceTruth& truth, double epsilon_m) {
  const auto sets = test::convex_sets_of(shape, Pose::Identity());
  const auto rows = truth.voxels();
  const std::size_t stride = 1 + rows.size() / kMostChecked;
  int n = 0;
  for (std::size_t row = 0; row < rows.size(); row += stride, n = (n + 1) % 27) {
    const VoxelKey& key = rows[row].key;
    test::check_voxel(sets, truth, key, epsilon_m);
    test::check_voxel(sets, truth, {key.i + n % 3 - 1, key.j + n / 3 % 3 - 1, key.k + n / 9 - 1},
                      epsilon_m);
  }
}

class ExtremeSizes : public ::testing::TestWithParam<ShapeKind> {
 protected:
  static void check(const Shape& shape, RandomStream& random, int round) {
    const double edge_m = edge_for(shape, random);
    const double epsilon_m = round % 2 == 0 ? 0 : 0.0005;
    SCOPED_TRACE(::testing::Message()
                 << "round " << round << " edge " << edge_m << " size " << shape.size.transpose());
    const auto truth = test::truth_of({shape}, edge_m, epsilon_m);
    ASSERT_GT(truth.count(1), 0u);
    check_samples(shape, truth);
    check_rows(shape, truth, epsilon_m);
  }
};

TEST_P(ExtremeSizes, AtAnyPose) {
  RandomStream random(41, name_of(GetParam()));
  for (int round = 0; round < 24; ++round) check(extreme_shape(GetParam(), random), random, round);
}

TEST_P(ExtremeSizes, OnRoundNumbers) {
  RandomStream random(43, name_of(GetParam()));
  for (int round = 0; round < 24; ++round) check(decimal_shape(GetParam(), random), random, round);
}

INSTANTIATE_TEST_SUITE_P(Kinds, ExtremeSizes, ::testing::ValuesIn(test::kAllKinds));

}  // namespace
}  // namespace mapscore::eval
