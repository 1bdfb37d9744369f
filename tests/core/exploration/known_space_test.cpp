// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#include "core/exploration/known_space.hpp"

#include "core/error.hpp"
#include "tests/core/exploration/box_flat.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <limits>
#include <map>

namespace mapscore::testing {
namespace {

SemanticMap seen_rooms(double edge_m) {
  const BoxFlat flat = two_rooms();
  FlatSensors sensors(flat, flat_robot(), 1.0);
  SemanticMap map(edge_m, Carving{.carve = true});
  for (const PlanarPose& here : {PlanarPose{1.5, 1.5, 0.0}, PlanarPose{1.5, 1.5, 1.0}})
    map.see(sensors.camera_at(here), sensors.points(here));
  return map;
}

const Eigen::AlignedBox3d kBox(Eigen::Vector3d(-0.31, -0.2, -0.1), Eigen::Vector3d(4.04, 2.5, 1.9));

/// What the cubes should hold, voxel by voxel.
std::map<VoxelKey, Space> plain_cubes(const SemanticMap& map, int per_cube) {
  std::map<VoxelKey, Space> cubes;
  const auto down = [&](std::int32_t index) {
    return static_cast<std::int32_t>(std::floor(static_cast<double>(index) / per_cube));
  };
  for (const MapVoxel& voxel : map.voxels()) {
    Space& cube = cubes[{down(voxel.key.i), down(voxel.key.j), down(voxel.key.k)}];
    cube = std::max(cube, voxel.occupied ? Space::occupied : Space::free);
  }
  return cubes;
}

/// Occupied cubes of the box with fewer than two occupied neighbours in it become free.
void free_specks(const KnownSpace& space, std::map<VoxelKey, Space>& cubes) {
  const VoxelKey &low = space.low(), &size = space.size();
  const auto occupied = [&](const VoxelKey& key) {
    const bool inside = key.i >= low.i && key.i < low.i + size.i && key.j >= low.j &&
                        key.j < low.j + size.j && key.k >= low.k && key.k < low.k + size.k;
    const auto found = cubes.find(key);
    return inside && found != cubes.end() && found->second == Space::occupied;
  };
  std::vector<VoxelKey> specks;
  for (const auto& [key, cube] : cubes) {
    int beside = 0;
    for (int n = 0; n < 27; ++n)
      if (n != 13)
        beside += occupied({key.i + n % 3 - 1, key.j + n / 3 % 3 - 1, key.k + n / 9 - 1});
    if (cube == Space::occupied && beside < 2) specks.push_back(key);
  }
  for (const VoxelKey& key : specks) cubes[key] = Space::free;
}

void expect_equal(const KnownSpace& space, std::map<VoxelKey, Space> cubes) {
  free_specks(space, cubes);
  std::size_t known = 0;
  const VoxelKey &low = space.low(), &size = space.size();
  for (std::int32_t i = low.i; i < low.i + size.i; ++i)
    for (std::int32_t j = low.j; j < low.j + size.j; ++j)
      for (std::int32_t k = low.k; k < low.k + size.k; ++k) {
        const auto found = cubes.find({i, j, k});
        const Space expected = found == cubes.end() ? Space::unknown : found->second;
        ASSERT_EQ(space.at({i, j, k}), expected) << i << ' ' << j << ' ' << k;
        known += expected != Space::unknown;
      }
  EXPECT_GT(known, 1000u);
}

TEST(KnownSpace, HoldsEveryVoxelOfTheMap) {
  const SemanticMap map = seen_rooms(0.05);
  const KnownSpace space(map, kBox, 0.0);
  EXPECT_EQ(space.edge_m(), 0.05);
  EXPECT_EQ(space.low(), (VoxelKey{-7, -4, -2}));
  expect_equal(space, plain_cubes(map, 1));
}

TEST(KnownSpace, OfFineVoxelsItHoldsWhatIsThereInEachCube) {
  const SemanticMap map = seen_rooms(0.02);
  const KnownSpace space(map, kBox, 0.0);
  EXPECT_EQ(space.edge_m(), 0.04);
  expect_equal(space, plain_cubes(map, 2));
}

TEST(KnownSpace, EndsInALayerBeyond) {
  const KnownSpace space(SemanticMap(0.05, Carving{.carve = true}), kBox, 0.0);
  EXPECT_EQ(space.at(space.low()), Space::unknown);
  EXPECT_EQ(space.at({space.low().i - 1, 0, 0}), Space::beyond);
  EXPECT_EQ(space.at({space.low().i - 50, 0, 0}), Space::beyond);
  EXPECT_EQ(space.at(space.place_of({0, 0, space.low().k + space.size().k})), Space::beyond);
}

// A voxel of two classes, and one of a class that is sure.
TEST(KnownSpace, MarksSurfacesWhoseClassIsUncertain) {
  SemanticMap map(0.05, Carving{.carve = true});
  std::vector<Eigen::Vector3d> points;
  for (const double y : {-0.03, 0.02, 0.07, 0.47, 0.52, 0.57}) points.emplace_back(1.02, y, 0.52);
  map.see({0.02, 0.02, 0.52}, points);
  map.set_beliefs({20, 0, 10}, ClassBeliefs({{1, 0.5}, {2, 0.4}}));
  map.set_beliefs({20, 10, 10}, ClassBeliefs({{1, 0.95}}));
  const KnownSpace space(map, kBox, 0.6);
  EXPECT_EQ(space.at({20, 0, 10}), Space::unsure);
  EXPECT_EQ(space.at({20, 10, 10}), Space::occupied);
  EXPECT_EQ(KnownSpace(map, kBox, 0.4).at({20, 0, 10}), Space::occupied);
}

TEST(KnownSpace, RefusesMapsWithoutFreeSpaceAndBoxesThatAreNone) {
  EXPECT_THROW(KnownSpace(SemanticMap(0.05), kBox, 0.0), Error);
  const SemanticMap map(0.05, Carving{.carve = true});
  EXPECT_THROW(KnownSpace(map, {}, 0.0), Error);
  Eigen::AlignedBox3d endless = kBox;
  endless.max().x() = std::numeric_limits<double>::infinity();
  EXPECT_THROW(KnownSpace(map, endless, 0.0), Error);
}

}  // namespace
}  // namespace mapscore::testing
