// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#include "core/error.hpp"
#include "core/mapping/map_query.hpp"
#include "core/mapping/map_resolution.hpp"
#include "core/mapping/semantic_map.hpp"
#include "core/random_stream.hpp"
#include "tests/core/mapping/carved_map.hpp"

#include <gtest/gtest.h>
#include <octomap/ColorOcTree.h>

#include <limits>
#include <sstream>

namespace mapscore {
namespace {

using testing::add;
using testing::carved_map;
using testing::kBlend;
using testing::kEdge;
using testing::random_view;
using testing::rows;
using testing::View;

TEST(SemanticOcTree, ANodeWithoutASurfaceIsSmall) {
  EXPECT_LE(sizeof(SemanticOcTreeNode), 24u);
  EXPECT_TRUE(SemanticOcTreeNode().beliefs().empty());
}

TEST(SemanticOcTree, FinestCutsAPrunedLeafAndLosesNothing) {
  SemanticMap map(kEdge);
  std::vector<VoxelHit> hits;
  for (int i = 0; i < 4; ++i)
    for (int j = 0; j < 4; ++j)
      for (int k = 0; k < 4; ++k) hits.push_back({{i, j, k}, 3, 1, 1.0});
  map.fuse(hits, 1, kBlend);
  const auto before = rows(map.voxels());
  map.prune();
  ASSERT_EQ(map.tree().getNumLeafNodes(), 1u);
  EXPECT_EQ(rows(map.voxels()), before);
  map.fuse(std::vector<VoxelHit>{{{1, 2, 3}, 5, 1, 1.0}}, 1, kBlend);
  EXPECT_EQ(map.voxels().size(), 64u);
  EXPECT_EQ(map.classes_at({1, 2, 3}).size(), 2u);
  EXPECT_EQ(map.classes_at({1, 2, 2}).size(), 1u) << "its neighbour was not hit";
}

TEST(SemanticOcTree, HitIsOctomapsUpdateOfAVoxel) {
  octomap::ColorOcTree theirs(kEdge);
  SemanticOcTree ours(kEdge);
  SemanticOcTree::Descent descent(ours);
  RandomStream stream(3, "hits");
  for (int n = 0; n < 5000; ++n) {
    const int far = stream.uniform() < 0.1 ? 20000 : 0;
    const auto index = [&] { return static_cast<int>(stream.uniform() * 6) - 3 - far; };
    const VoxelKey key{index(), index(), index()};
    ASSERT_EQ(descent.hit(octree_key(key)).getLogOdds(),
              theirs.updateNode(octree_key(key), true, true)->getLogOdds());
  }
}

TEST(Merge, OfTwoHalvesIsTheWholeWhereTheRuleAllowsIt) {
  const VoteRule rule;
  Carving carving{.carve = true};
  carving.model.clamp_min = 1e-6;  // a clamp forgets: halves and whole agree before it is reached
  carving.model.clamp_max = 1 - 1e-6;
  SemanticMap whole(kEdge, carving), first(kEdge, carving), second(kEdge, carving);
  RandomStream stream(6, "halves");
  for (int n = 0; n < 8; ++n) {
    const View view = random_view(stream);
    add(view, rule, whole);
    add(view, rule, n < 4 ? first : second);
  }
  first.merge(second, rule);
  const auto expected = read_at(whole, rule, 1), merged = read_at(first, rule, 1);
  ASSERT_EQ(merged.size(), expected.size());
  for (std::size_t n = 0; n < merged.size(); ++n) {
    EXPECT_EQ(merged[n].key, expected[n].key);
    EXPECT_NEAR(merged[n].log_odds, expected[n].log_odds, 1e-5);
    EXPECT_EQ(merged[n].beliefs, expected[n].beliefs);
  }
}

TEST(Merge, WithPrunedLeavesOnEitherSide) {
  SemanticMap a = carved_map(12, VoteRule{}, 1), b = carved_map(12, VoteRule{}, 2);
  SemanticMap a_pruned = carved_map(12, VoteRule{}, 1), b_pruned = carved_map(12, VoteRule{}, 2);
  for (SemanticMap* map : {&a, &b})
    for (const MapVoxel& v : map->voxels())
      (void)const_cast<SemanticOcTree&>(map->tree()).finest(octree_key(v.key));
  ASSERT_LT(a_pruned.tree().size(), a.tree().size());
  a.merge(b, VoteRule{});
  a_pruned.merge(b_pruned, VoteRule{});
  EXPECT_EQ(rows(a_pruned.voxels()), rows(a.voxels()));
}

TEST(Merge, RefusesWhatItCannotAndChangesNothing) {
  SemanticMap map = carved_map(3), finer(0.05);
  const auto before = rows(map.voxels());
  EXPECT_THROW(map.merge(carved_map(2), kBlend), Error);
  EXPECT_THROW(map.merge(finer, VoteRule{}), Error);
  EXPECT_EQ(rows(map.voxels()), before);
}

TEST(See, RefusesBadInputAndChangesNothing) {
  SemanticMap map = carved_map(3);
  const auto before = rows(map.voxels());
  const double nan = std::numeric_limits<double>::quiet_NaN();
  EXPECT_THROW(map.see({nan, 0, 0}, {}), Error);
  Carving bad{.carve = true};
  bad.model.hit = 0.4;
  EXPECT_THROW(SemanticMap(kEdge, bad), Error);
  bad = {.carve = true, .max_range_m = -1.0};
  EXPECT_THROW(SemanticMap(kEdge, bad), Error);
  EXPECT_EQ(rows(map.voxels()), before);
  SemanticMap plain(kEdge);
  EXPECT_THROW(plain.see({0, 0, 0}, {}), Error) << "it does not carve";
}

TEST(See, AVoxelSeenThroughOftenEnoughIsNoLongerOccupied) {
  SemanticMap map(kEdge, {.carve = true});
  const std::vector<VoxelHit> leak{{{5, 0, 0}, 1, 1, 1.0}};
  const std::vector<Eigen::Vector3d> near{{0.55, 0.05, 0.05}}, far{{1.55, 0.05, 0.05}};
  const auto leaked = [&] {
    return voxels_in_box(map, {Eigen::Vector3d(0.5, 0, 0), Eigen::Vector3d(0.6, 0.1, 0.1)}, {1});
  };
  map.see({0.05, 0.05, 0.05}, near, leak);
  map.fuse(leak, 1, kBlend);
  EXPECT_EQ(leaked().size(), 1u);
  for (int n = 0; n < 3; ++n) map.see({0.05, 0.05, 0.05}, far);
  EXPECT_TRUE(leaked().empty()) << "0.847 - 3 x 0.405 < 0";
}

TEST(Colour, IsTheMeanInAnyOrder) {
  SemanticMap map(kEdge);
  map.fuse(std::vector<VoxelHit>{{{0, 0, 0}, 1, 1, 1.0}}, 1, kBlend);
  const Eigen::Vector3d p(0.05, 0.05, 0.05);
  map.add_colours(std::vector<ColouredPoint>{
      {p, {0, 10, 255}}, {p, {1, 20, 255}}, {{5, 5, 5}, {9, 9, 9}}, {{1e9, 0, 0}, {9, 9, 9}}});
  const auto colour = map.tree().search(octree_key({0, 0, 0}))->colour();
  EXPECT_EQ(colour.mean(), (Colour{1, 15, 255}));
  EXPECT_EQ(map.tree().search(octree_key({50, 50, 50})), nullptr) << "not in the map";
}

std::string bytes_of(const SemanticMap& map) {
  std::ostringstream stream;
  map.tree().write(stream);
  return stream.str();
}

TEST(SemanticOcTreeFile, HoldsColoursAndBeliefsAndPrunedLeaves) {
  const SemanticMap map = carved_map(10);
  std::istringstream stream(bytes_of(map));
  const auto read = SemanticOcTree::read_whole(stream);
  EXPECT_TRUE(*read == map.tree());
}

/// Occupancy of inner nodes is brought up to date in the file alone: const is const.
TEST(SemanticOcTreeFile, HoldsInnerOccupancyAndWritingChangesNothing) {
  SemanticMap map(kEdge);
  for (int n = 0; n < 20; ++n)
    map.fuse(std::vector<VoxelHit>{{{n % 7, n % 5, -n}, 1, 1, 1.0}}, 1, kBlend);
  auto& tree = const_cast<SemanticOcTree&>(map.tree());
  tree.getRoot()->setLogOdds(-3.0f);  // as inner nodes are before they are brought up to date
  const std::string bytes = bytes_of(map);
  EXPECT_EQ(tree.getRoot()->getLogOdds(), -3.0f);
  tree.updateInnerOccupancy();  // OctoMap's own
  std::ostringstream theirs;
  tree.OccupancyOcTreeBase<SemanticOcTreeNode>::writeData(theirs);
  EXPECT_EQ(bytes.substr(bytes.find("data\n") + 5), theirs.str());
  EXPECT_GT(theirs.str().size(), 500u);
}

TEST(SemanticOcTreeFile, WithoutColourIsTheOldOne) {
  // A file of before colours: one voxel's chain of nodes, the leaf with one class.
  std::string bytes = "# Octomap OcTree file\nid SemanticOcTree\nsize 17\nres 0.1\ndata\n";
  const auto append = [&](auto value) {
    bytes.append(reinterpret_cast<const char*>(&value), sizeof value);
  };
  for (int depth = 0; depth <= 16; ++depth) {
    append(0.5f);
    append(std::uint16_t(depth == 16 ? 1 : 0));
    if (depth == 16) append(ClassId{7}), append(0.75);
    append(std::uint8_t(depth == 16 ? 0 : 1));
  }
  std::istringstream stream(bytes);
  const auto tree = SemanticOcTree::read_whole(stream);
  EXPECT_EQ(tree->begin_leafs()->best(), (ClassProbability{7, 0.75}));
  std::ostringstream again;
  tree->write(again);
  EXPECT_EQ(again.str().substr(again.str().find("data")), bytes.substr(bytes.find("data")));
}

TEST(SemanticOcTreeFile, RefusesColoursThatCannotBe) {
  SemanticMap map(kEdge);
  map.fuse(std::vector<VoxelHit>{{{0, 0, 0}, 1, 1, 1.0}}, 1, kBlend);
  map.add_colours(std::vector<ColouredPoint>{{{0.05, 0.05, 0.05}, {200, 100, 50}}});
  const std::string bytes = bytes_of(map);
  for (const auto& [from_end, value] : {std::pair(5u, 0), std::pair(17u, 255), std::pair(16u, 1)}) {
    std::string damaged = bytes;  // the last node ends in r, g, b, count (4 bytes each), children
    damaged[damaged.size() - from_end] = static_cast<char>(value);
    std::istringstream stream(damaged);
    if (from_end == 17u) {
      EXPECT_NO_THROW((void)SemanticOcTree::read_whole(stream));
    } else {
      EXPECT_THROW((void)SemanticOcTree::read_whole(stream), Error) << from_end;
    }
  }
}

}  // namespace
}  // namespace mapscore
