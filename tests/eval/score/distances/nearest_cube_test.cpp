// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#include "eval/score/distances/nearest_cube.hpp"

#include "core/random_stream.hpp"
#include "eval/score/distance_tally.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <set>

namespace mapscore::eval {
namespace {

double plain_distance(const std::vector<VoxelKey>& cubes, const Eigen::Vector3d& p, double edge_m) {
  double least = std::numeric_limits<double>::infinity();
  for (const VoxelKey& cube : cubes) {
    const Eigen::Vector3d from_centre = p - centre_of(cube, edge_m);
    least = std::min(least, (from_centre.array().abs() - edge_m / 2).max(0.0).matrix().norm());
  }
  return least;
}

VoxelKey random_key(RandomStream& random, int span) {
  const auto index = [&] { return static_cast<int>(std::floor((random.uniform() - 0.5) * span)); };
  const int i = index(), j = index(), k = index();
  return {i, j, k};
}

TEST(NearestCube, EqualsTheSearchThroughAllCubes) {
  for (std::uint64_t seed = 0; seed < 60; ++seed) {
    RandomStream random(seed, "nearest cube test");
    const double edge_m = 0.02 + 0.08 * random.uniform();
    std::set<VoxelKey> keys;
    const auto cubes_wanted = static_cast<std::size_t>(1 + random.uniform() * 150);
    while (keys.size() < cubes_wanted) keys.insert(random_key(random, 20));
    const std::vector<VoxelKey> cubes(keys.begin(), keys.end());
    NearestCube nearest(cubes, edge_m);
    for (int n = 0; n < 30; ++n) {
      const VoxelKey voxel = random_key(random, 40);
      nearest.enter(voxel);
      for (int s = 0; s < 5; ++s) {
        const double x = random.uniform(), y = random.uniform(), z = random.uniform();
        const Eigen::Vector3d offset = (Eigen::Vector3d(x, y, z).array() - 0.5).matrix() * edge_m;
        EXPECT_NEAR(nearest.distance_m(offset),
                    plain_distance(cubes, centre_of(voxel, edge_m) + offset, edge_m), 1e-12);
      }
    }
  }
}

TEST(NearestCube, NearestCentreNeedNotBeNearestCube) {
  // From the low corner of the voxel, the cube at (-3, 0, 0) is 2 edges away, that at (2, 1, 1)
  // farther, though its centre is nearer to the voxel's.
  const std::vector<VoxelKey> cubes{{-3, 0, 0}, {2, 1, 1}};
  NearestCube nearest(cubes, 1.0);
  nearest.enter({0, 0, 0});
  EXPECT_DOUBLE_EQ(nearest.distance_m({-0.5, -0.5, -0.5}), 2.0);
}

TEST(NearestCube, NothingToReachWithoutCubes) {
  NearestCube nearest({}, 0.05);
  nearest.enter({0, 0, 0});
  EXPECT_EQ(nearest.distance_m({0, 0, 0}), kUnreached);
}

}  // namespace
}  // namespace mapscore::eval
