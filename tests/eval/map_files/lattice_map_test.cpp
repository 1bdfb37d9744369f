// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#include "eval/map_files/lattice_map.hpp"

#include "core/random_stream.hpp"
#include "tests/support/expect_error.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <set>

namespace mapscore::eval {
namespace {

using testing::expect_error;

/// One voxel with all that is known of it, to compare.
struct Cell {
  VoxelKey key;
  ClassId class_id = kBackground;
  double probability = 1.0;
  bool occupied = true;
  std::uint32_t instance = 0;
  bool operator==(const Cell&) const = default;
};
std::ostream& operator<<(std::ostream& out, const Cell& cell) {
  return out << cell.key.i << ',' << cell.key.j << ',' << cell.key.k << " class " << cell.class_id
             << " p " << cell.probability << " occupied " << cell.occupied << " instance "
             << cell.instance;
}

std::vector<Cell> cells_of(const LatticeMap& map) {
  std::vector<Cell> cells;
  for (std::size_t n = 0; n < map.voxels.size(); ++n) {
    const MapVoxel& voxel = map.voxels[n];
    cells.push_back({voxel.key, voxel.best_class, voxel.probability, voxel.occupied,
                     map.instances.empty() ? 0 : map.instances[n]});
  }
  return cells;
}

/// Random voxels in a block, each once, and what they bear. Probabilities are eighths, so that the
/// order in which they are summed does not show.
struct RandomMap {
  MapFile file;
  std::vector<ClassId> classes;
};
RandomMap random_map(RandomStream& draw, double edge_m, int size, int count) {
  RandomMap map;
  map.file.edge_m = edge_m;
  std::set<VoxelKey> keys;
  const auto below = [&](int n) {
    return static_cast<int>(draw.bits() % static_cast<unsigned>(n));
  };
  while (static_cast<int>(keys.size()) < count)
    keys.insert({below(size) - size / 2, below(size) - size / 2, below(size) - size / 2});
  map.file.voxels.assign(keys.rbegin(), keys.rend());
  for (std::size_t n = 0; n < keys.size(); ++n) {
    map.file.probabilities.push_back(below(9) / 8.0);
    map.file.occupied.push_back(below(3) > 0);
    map.file.instances.push_back(static_cast<std::uint32_t>(below(3)));
    map.classes.push_back(static_cast<ClassId>(below(4)));
  }
  return map;
}

Pose random_pose(RandomStream& draw) {
  Vector6 xi;
  for (int axis = 0; axis < 6; ++axis) xi[axis] = (axis < 3 ? 0.3 : 1.0) * draw.normal();
  return exp_pose(xi);
}

Cell cell_of(const RandomMap& map, std::size_t n, const VoxelKey& key) {
  return {key, map.classes[n], map.file.probabilities[n], map.file.occupied[n] != 0,
          map.file.instances[n]};
}

/// Asks every voxel of a block of the lattice in which source its centre lies.
std::vector<Cell> plain_pull(const RandomMap& map, const Pose& T_map_file, double edge_m,
                             int reach) {
  std::map<VoxelKey, std::size_t> sources;
  for (std::size_t n = 0; n < map.classes.size(); ++n) sources[map.file.voxels[n]] = n;
  const Pose T_file_map = T_map_file.inverse();
  std::vector<Cell> cells;
  for (int i = -reach; i < reach; ++i)
    for (int j = -reach; j < reach; ++j)
      for (int k = -reach; k < reach; ++k) {
        const Eigen::Vector3d p = T_file_map * centre_of({i, j, k}, edge_m);
        const auto source =
            sources.find(voxel_of(p + Eigen::Vector3d::Constant(1e-9), map.file.edge_m));
        if (source != sources.end()) cells.push_back(cell_of(map, source->second, {i, j, k}));
      }
  return cells;
}

template <class Key>
Key most_frequent(const std::map<Key, int>& counts) {
  return std::ranges::max_element(counts,
                                  [](const auto& a, const auto& b) {
                                    return a.second != b.second ? a.second < b.second
                                                                : a.first > b.first;
                                  })
      ->first;
}

/// Votes of points by voxel, counted in maps.
std::vector<Cell> plain_votes(const RandomMap& map, const std::vector<VoxelKey>& keys) {
  std::map<VoxelKey, std::vector<std::size_t>> by_voxel;
  for (std::size_t n = 0; n < keys.size(); ++n) by_voxel[keys[n]].push_back(n);
  std::vector<Cell> cells;
  for (auto& [key, votes] : by_voxel) {
    const bool occupied =
        std::ranges::any_of(votes, [&](std::size_t n) { return map.file.occupied[n] != 0; });
    std::erase_if(votes, [&](std::size_t n) { return (map.file.occupied[n] != 0) != occupied; });
    std::map<ClassId, int> classes;
    for (const std::size_t n : votes) ++classes[map.classes[n]];
    const ClassId winner = most_frequent(classes);
    std::map<std::uint32_t, int> instances;
    double sum = 0.0;
    for (const std::size_t n : votes)
      if (map.classes[n] == winner) {
        ++instances[map.file.instances[n]];
        sum += map.file.probabilities[n];
      }
    cells.push_back({key, winner, sum / classes[winner], occupied, most_frequent(instances)});
  }
  return cells;
}

TEST(LatticeMap, VoxelsOfItsEdgeStayAsTheyAre) {
  RandomStream draw(1, "as they are");
  RandomMap map = random_map(draw, 0.05, 9, 200);
  for (const double edge_m : {0.05, 0.05 + 4e-10, 0.0}) {
    map.file.edge_m = edge_m;
    std::vector<Cell> expected;
    for (std::size_t n = 200; n-- > 0;)  // the file has them in descending order
      expected.push_back(cell_of(map, n, map.file.voxels[n]));
    EXPECT_EQ(cells_of(on_lattice(map.file, map.classes, Pose::Identity(), 0.05, Resample::refuse)),
              expected);
  }
}

TEST(LatticeMap, ListsThatTheFileDoesNotHave) {
  MapFile map;
  map.voxels = {{1, 2, 3}};
  const LatticeMap on = on_lattice(map, {2}, Pose::Identity(), 0.05, Resample::refuse);
  EXPECT_EQ(cells_of(on), (std::vector<Cell>{{{1, 2, 3}, 2, 1.0, true, 0}}));
  EXPECT_TRUE(on.instances.empty());
}

TEST(LatticeMap, AnotherEdgeIsRefusedUnlessResamplingIsAllowed) {
  MapFile map;
  map.edge_m = 0.1;
  map.voxels = {{0, 0, 0}};
  expect_error("a map of 0.1 m voxels, the truth has 0.05: give --voxel_m 0.1, or --resample",
               [&] { (void)on_lattice(map, {1}, Pose::Identity(), 0.05, Resample::refuse); });
  EXPECT_EQ(on_lattice(map, {1}, Pose::Identity(), 0.05, Resample::allow).voxels.size(), 8u);
}

TEST(LatticeMap, PointsOfMostCountAndTiesGoLow) {
  MapFile map;
  map.points = {{0.01, 0, 0},    {0.02, 0, 0},  {0.03, 0, 0},  // chair twice, cup once
                {0.06, 0, 0},    {0.07, 0, 0},                 // chair against cup
                {-0.01, 0, 0},   {-0.02, 0, 0},                // cup against no class
                {0.05 * 3, 0, 0}};                             // 0.15 / 0.05 rounds to below 3
  map.probabilities = {0.5, 0.25, 1.0, 0.5, 0.75, 1.0, 0.25, 1.0};
  map.instances = {7, 6, 1, 0, 0, 0, 0, 0};
  const std::vector<ClassId> classes{2, 2, 1, 2, 1, 1, 0, 1};
  const auto cells = cells_of(on_lattice(map, classes, Pose::Identity(), 0.05, Resample::refuse));
  EXPECT_EQ(cells, (std::vector<Cell>{{{-1, 0, 0}, 0, 0.25, true, 0},
                                      {{0, 0, 0}, 2, 0.375, true, 6},
                                      {{1, 0, 0}, 1, 0.75, true, 0},
                                      {voxel_of({0.05 * 3, 0, 0}, 0.05), 1, 1.0, true, 0}}));
}

TEST(LatticeMap, PointsAgainstTheirPlainTwin) {
  for (std::uint64_t trial = 0; trial < 50; ++trial) {
    RandomStream draw(2, "points", {trial});
    RandomMap map = random_map(draw, 0.0, 30, 400);
    const Pose T_map_file = trial == 0 ? Pose::Identity() : random_pose(draw);
    std::vector<VoxelKey> keys;
    for (const VoxelKey& voxel : map.file.voxels) {
      map.file.points.push_back(Eigen::Vector3d(voxel.i, voxel.j, voxel.k) * 0.02);
      keys.push_back(voxel_of(T_map_file * map.file.points.back(), 0.1));
    }
    map.file.voxels.clear();
    EXPECT_EQ(cells_of(on_lattice(map.file, map.classes, T_map_file, 0.1, Resample::refuse)),
              plain_votes(map, keys));
  }
}

TEST(LatticeMap, CoarserAndTurnedVoxelsAgainstTheirPlainTwin) {
  for (const double source_m : {0.05, 0.07, 0.1, 0.23}) {
    for (std::uint64_t trial = 0; trial < 12; ++trial) {
      RandomStream draw(3, "pull", {trial, static_cast<std::uint64_t>(source_m * 100)});
      const RandomMap map = random_map(draw, source_m, 6, 60);
      Pose T_map_file = random_pose(draw);
      if (trial == 0) T_map_file = Pose::Identity();
      if (trial == 1) T_map_file = planar_pose(0.025, 0.05, EIGEN_PI / 2);
      const auto expected = plain_pull(map, T_map_file, 0.05, 50);
      EXPECT_EQ(cells_of(on_lattice(map.file, map.classes, T_map_file, 0.05, Resample::allow)),
                expected)
          << source_m << ' ' << trial;
      EXPECT_GT(expected.size(), 20u);
    }
  }
}

TEST(LatticeMap, FinerVoxelsAgainstTheirPlainTwin) {
  for (const double source_m : {0.01, 0.02, 0.03, 0.049}) {
    for (std::uint64_t trial = 0; trial < 12; ++trial) {
      RandomStream draw(4, "push", {trial, static_cast<std::uint64_t>(source_m * 1000)});
      const RandomMap map = random_map(draw, source_m, 20, 1500);
      const Pose T_map_file = trial == 0 ? Pose::Identity() : random_pose(draw);
      std::vector<VoxelKey> keys;
      for (const VoxelKey& voxel : map.file.voxels)
        keys.push_back(voxel_of(
            T_map_file * centre_of(voxel, source_m) + Eigen::Vector3d::Constant(1e-9), 0.05));
      EXPECT_EQ(cells_of(on_lattice(map.file, map.classes, T_map_file, 0.05, Resample::allow)),
                plain_votes(map, keys));
    }
  }
}

/// Also where the moved faces lie on the lattice's own in decimal numbers and not in doubles.
TEST(LatticeMap, WholeVoxelsMoveExactly) {
  RandomStream draw(5, "whole voxels");
  for (const double edge_m : {0.05, 0.1, 0.01, 0.03}) {
    const RandomMap map = random_map(draw, edge_m, 12, 300);
    for (int trial = 0; trial < 40; ++trial) {
      VoxelKey by;
      for (std::int32_t* axis : {&by.i, &by.j, &by.k})
        *axis = static_cast<std::int32_t>(draw.bits() % 20001) - 10000;
      Pose T_map_file = Pose::Identity();
      T_map_file.translation() = Eigen::Vector3d(by.i, by.j, by.k) * edge_m;
      std::vector<Cell> expected;
      for (std::size_t n = 300; n-- > 0;) {
        const VoxelKey& voxel = map.file.voxels[n];
        expected.push_back(cell_of(map, n, {voxel.i + by.i, voxel.j + by.j, voxel.k + by.k}));
      }
      EXPECT_EQ(cells_of(on_lattice(map.file, map.classes, T_map_file, edge_m, Resample::refuse)),
                expected);
    }
  }
}

/// By half a voxel all centres lie on faces: each target takes one source, and none is lost.
TEST(LatticeMap, HalfVoxelsMoveWithoutHoles) {
  RandomStream draw(6, "half voxels");
  const RandomMap map = random_map(draw, 0.05, 12, 300);
  for (int trial = -50; trial < 50; ++trial) {
    Pose T_map_file = Pose::Identity();
    T_map_file.translation().setConstant((trial + 0.5) * 0.05);
    const auto cells =
        cells_of(on_lattice(map.file, map.classes, T_map_file, 0.05, Resample::refuse));
    ASSERT_EQ(cells.size(), 300u);
    const VoxelKey by{cells[0].key.i - map.file.voxels.back().i,
                      cells[0].key.j - map.file.voxels.back().j,
                      cells[0].key.k - map.file.voxels.back().k};
    EXPECT_EQ(by, (VoxelKey{trial, trial, trial}));
    for (std::size_t n = 0; n < 300; ++n) {
      const VoxelKey& from = map.file.voxels[299 - n];
      EXPECT_EQ(cells[n].key, (VoxelKey{from.i + trial, from.j + trial, from.k + trial}));
    }
  }
}

TEST(LatticeMap, FarVoxelsAndFloodsAreRefused) {
  MapFile points;
  points.points = {{0, 0, 1e5}};
  expect_error("the map reaches (0, 0, 100000) m, beyond 1000000 voxels of 0.05 m",
               [&] { (void)on_lattice(points, {1}, Pose::Identity(), 0.05, Resample::refuse); });
  points.points = {{0, 1e308, 0}};
  const Pose turned = planar_pose(0, 0, EIGEN_PI);
  expect_error("beyond 1000000 voxels",
               [&] { (void)on_lattice(points, {1}, turned, 0.05, Resample::refuse); });
  MapFile voxels;
  voxels.edge_m = 0.05;
  voxels.voxels = {{0, -1'000'001, 0}};
  for (const Pose& pose : {Pose(Pose::Identity()), turned})
    expect_error("beyond 1000000 voxels",
                 [&] { (void)on_lattice(voxels, {1}, pose, 0.05, Resample::refuse); });
  voxels.voxels = {{0, -1'000'000, 1'000'000}};
  EXPECT_EQ(on_lattice(voxels, {1}, Pose::Identity(), 0.05, Resample::refuse).voxels.size(), 1u);
  voxels.edge_m = 100.0;
  voxels.voxels = {{0, 0, 0}};
  expect_error("1 voxels of 100 m would become 8e+09 of 0.05 m; score the map with --voxel_m 100",
               [&] { (void)on_lattice(voxels, {1}, turned, 0.05, Resample::allow); });
  voxels.edge_m = 10.0;  // beyond two million voxels, 128 a voxel
  expect_error("1 voxels of 10 m would become 8e+06 of 0.05 m",
               [&] { (void)on_lattice(voxels, {1}, turned, 0.05, Resample::allow); });
}

}  // namespace
}  // namespace mapscore::eval
