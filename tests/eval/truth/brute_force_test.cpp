// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#include "eval/truth/surface_truth.hpp"
#include "tests/eval/truth/brute_force_shapes.hpp"
#include "tests/eval/truth/surface_witness.hpp"
#include "tests/eval/truth/truth_scenes.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <set>

// Surface truth against brute force that shares no code with it: dense samples of the surface must
// fall into the set, and every voxel of the set must come within 1e-9 m of the surface by the
// search of surface_witness.hpp, its neighbours outside the set not at all.

namespace mapscore::eval {
namespace {

using Eigen::Vector3d;

constexpr double kSamplesPerEdge = 6;

struct Placed {
  Shape shape;
  Pose T_map_world = Pose::Identity();
};

/// Calls `visit` with each voxel whose closed cube, widened by `margin_m`, holds the point.
template <typename Visit>
void for_voxels_that_hold(const Vector3d& p, double edge_m, double margin_m, const Visit& visit) {
  const auto first = [&](double x) {
    return static_cast<int>(std::ceil((x - margin_m) / edge_m - 1));
  };
  const auto last = [&](double x) { return static_cast<int>(std::floor((x + margin_m) / edge_m)); };
  for (int i = first(p.x()); i <= last(p.x()); ++i) {
    for (int j = first(p.y()); j <= last(p.y()); ++j) {
      for (int k = first(p.z()); k <= last(p.z()); ++k) visit(VoxelKey{i, j, k});
    }
  }
}

/// Number of steps, a multiple of four so that poles and quarter turns are hit, that keeps
/// neighbouring samples `pitch_m` apart or nearer.
int steps_for(const test::Patch& patch, double pitch_m) {
  constexpr int kCoarse = 32;
  double farthest = 0;
  for (int i = 0; i < kCoarse; ++i) {
    for (int j = 0; j <= kCoarse; ++j) {
      const double a = double(i) / kCoarse, b = double(i + 1) / kCoarse, c = double(j) / kCoarse;
      farthest = std::max(
          {farthest, (patch(a, c) - patch(b, c)).norm(), (patch(c, a) - patch(c, b)).norm()});
    }
  }
  return 4 * static_cast<int>(std::ceil(1.1 * farthest * kCoarse / pitch_m / 4));
}

/// Samples that no voxel of the truth accounts for; counts all samples.
std::size_t stray_samples(const Placed& placed, const SurfaceTruth& truth, double epsilon_m,
                          std::size_t& samples) {
  std::size_t strays = 0;
  for (const test::Patch& patch : test::patches_of(placed.shape, placed.T_map_world)) {
    const int n = steps_for(patch, truth.edge_m() / kSamplesPerEdge);
    for (int i = 0; i <= n; ++i) {
      for (int j = 0; j <= n; ++j) {
        ++samples;
        for_voxels_that_hold(patch(double(i) / n, double(j) / n), truth.edge_m(),
                             epsilon_m + test::kContactSlack_m,
                             [&](const VoxelKey& key) { strays += !truth.contains(key, 1); });
      }
    }
  }
  return strays;
}

std::set<VoxelKey> with_neighbours(const SurfaceTruth& truth) {
  std::set<VoxelKey> keys;
  for (const SurfaceVoxel& row : truth.voxels()) {
    for (int n = 0; n < 27; ++n) {
      keys.insert({row.key.i + n % 3 - 1, row.key.j + n / 3 % 3 - 1, row.key.k + n / 9 - 1});
    }
  }
  return keys;
}

/// Voxels of the set must be near the surface, those around it must not touch it.
void check_voxels(const Placed& placed, const SurfaceTruth& truth, double epsilon_m) {
  const auto sets = test::convex_sets_of(placed.shape, placed.T_map_world);
  for (const VoxelKey& key : with_neighbours(truth)) {
    test::check_voxel(sets, truth, key, epsilon_m);
    if (::testing::Test::HasFatalFailure()) return;
  }
}

std::size_t check_all(const std::vector<Placed>& cases, const std::vector<double>& edges_m) {
  std::size_t samples = 0;
  for (std::size_t i = 0; i < cases.size(); ++i) {
    for (const double edge_m : edges_m) {
      for (const double epsilon_m : {0.0, 0.0005}) {
        SCOPED_TRACE(::testing::Message()
                     << "case " << i << " edge " << edge_m << " epsilon " << epsilon_m);
        const auto truth = surface_truth({cases[i].shape}, test::four_classes(),
                                         cases[i].T_map_world, {edge_m, epsilon_m, 1});
        EXPECT_GT(truth.count(1), 0u);
        EXPECT_EQ(stray_samples(cases[i], truth, epsilon_m, samples), 0u);
        check_voxels(cases[i], truth, epsilon_m);
      }
    }
  }
  return samples;
}

class BruteForce : public ::testing::TestWithParam<ShapeKind> {};

TEST_P(BruteForce, UprightShapesOnAndOffTheLattice) {
  std::vector<Placed> cases;
  for (const Shape& shape : test::upright_shapes(GetParam())) {
    cases.push_back({shape, Pose::Identity()});
    cases.push_back({test::laid_down(shape), map_from_world({0.1, -0.3, 0.2}, 0)});
  }
  EXPECT_GT(check_all(cases, {0.01, 0.02, 0.05, 0.1}), 100'000u);
}

TEST_P(BruteForce, TiltedShapes) {
  std::vector<Placed> cases;
  for (const Shape& shape : test::tilted_shapes(GetParam(), 8)) {
    cases.push_back({shape, map_from_world({0.0123, -0.0071, 0.0042}, 0.3)});
  }
  EXPECT_GT(check_all(cases, {0.013, 0.05, 0.1}), 50'000u);
}

INSTANTIATE_TEST_SUITE_P(Kinds, BruteForce, ::testing::ValuesIn(test::kAllKinds));

// The oracle itself: no sample of the surface may be nearer than its nearest point, which must lie
// on the surface.
TEST_P(BruteForce, NearestPointsAreNearerThanAnySample) {
  RandomStream random(5, name_of(GetParam()));
  for (int round = 0; round < 20; ++round) {
    const Shape shape = test::random_shape(GetParam(), random);
    const auto set = test::convex_sets_of(shape, Pose::Identity()).front();
    const auto patches = test::patches_of(shape, Pose::Identity());
    const Vector3d p(random.normal(), random.normal(), random.normal());
    const Vector3d q = test::nearest_point(set, p);
    EXPECT_LT(test::sampled_distance(patches, {q, q}, 24), 1e-7);
    EXPECT_LE((p - q).norm(), test::sampled_distance(patches, {p, p}, 24) + 1e-12);
    if (!set.solid() || (p - q).norm() < 1e-3) continue;
    const Vector3d inner = q - 1e-3 * (p - q).normalized();
    const double depth = test::depth_in(set, inner);
    EXPECT_GT(depth, 0);
    // Exact but for the ellipsoid's bound, hence no more than the distance to q.
    if (GetParam() != ShapeKind::ellipsoid) {
      EXPECT_LE(depth, 1e-3 + 1e-12);
    }
    EXPECT_LE(test::depth_in(set, p), 0);
    const test::ClosedBox across = test::ClosedBox(inner).extend(p);
    EXPECT_LE(test::distance_found(set, across), 1e-12);
  }
}

}  // namespace
}  // namespace mapscore::eval
