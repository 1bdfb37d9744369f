// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#include "core/error.hpp"
#include "core/mapping/map_query.hpp"
#include "core/mapping/map_resolution.hpp"
#include "core/mapping/semantic_map.hpp"
#include "core/random_stream.hpp"
#include "tests/core/mapping/carved_map.hpp"
#include "tests/core/mapping/voxel_filter.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <octomap/ColorOcTree.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <limits>
#include <map>
#include <tuple>

namespace mapscore {
namespace {

using testing::carved_map;
using testing::kBlend;
using testing::kEdge;
using testing::rows;

bool equal_voxels(const CoarseVoxel& a, const CoarseVoxel& b) {
  return a.key == b.key && a.occupied == b.occupied && a.log_odds == b.log_odds &&
         a.beliefs == b.beliefs && a.colour == b.colour;
}

TEST(Prune, NoReadingChanges) {
  for (const FusionRule& rule :
       {FusionRule(kBlend), FusionRule(VoteRule{}), FusionRule(BayesRule{uniform_priors(5)})}) {
    SemanticMap map = carved_map(12, rule), pruned = carved_map(12, rule);
    map.fuse(std::vector<VoxelHit>{{{40, 40, 40}, 1, 1, 1.0}}, 1, rule);
    pruned.fuse(std::vector<VoxelHit>{{{40, 40, 40}, 1, 1, 1.0}}, 1, rule);
    // Cut every leaf into the finest, then prune one of the two.
    for (const MapVoxel& voxel : map.voxels()) {
      (void)const_cast<SemanticOcTree&>(map.tree()).finest(octree_key(voxel.key));
      (void)const_cast<SemanticOcTree&>(pruned.tree()).finest(octree_key(voxel.key));
    }
    pruned.prune();
    ASSERT_LT(pruned.tree().size(), map.tree().size());
    EXPECT_EQ(rows(pruned.voxels()), rows(map.voxels()));
    for (const int times : {1, 2, 4, 8, 16}) {
      const auto whole = read_at(map, rule, times), small = read_at(pruned, rule, times);
      EXPECT_TRUE(std::equal(whole.begin(), whole.end(), small.begin(), small.end(), equal_voxels))
          << times;
    }
  }
}

/// Reading at several times the voxel by hand: groups of voxels by key, doubled step by step.
std::vector<CoarseVoxel> by_hand(const SemanticMap& map, const FusionRule& rule, int times) {
  std::vector<CoarseVoxel> voxels;
  for (const MapVoxel& v : map.voxels()) {
    const auto classes = map.classes_at(v.key);
    const auto* node = map.tree().search(octree_key(v.key));
    voxels.push_back({v.key,
                      v.occupied,
                      node->getLogOdds(),
                      ClassBeliefs({classes.begin(), classes.end()}),
                      {}});
    if (node->colour().count > 0) voxels.back().colour = node->colour().mean();
  }
  for (; times > 1; times /= 2) {
    std::map<VoxelKey, std::vector<CoarseVoxel>> groups;
    for (const CoarseVoxel& v : voxels)  // children in OctoMap's order: x fastest, z slowest
      groups[{v.key.i >> 1, v.key.j >> 1, v.key.k >> 1}].push_back(v);
    voxels.clear();
    for (auto& [key, group] : groups) {
      std::sort(group.begin(), group.end(), [](const CoarseVoxel& a, const CoarseVoxel& b) {
        return std::tie(a.key.k, a.key.j, a.key.i) < std::tie(b.key.k, b.key.j, b.key.i);
      });
      CoarseVoxel whole{key, false, -100.0f, {}, {}};
      std::vector<const ClassBeliefs*> beliefs;
      int r = 0, g = 0, b = 0, coloured = 0;
      for (const CoarseVoxel& v : group) {
        whole.occupied = whole.occupied || v.occupied;
        whole.log_odds = std::max(whole.log_odds, v.log_odds);
        if (v.occupied) beliefs.push_back(&v.beliefs);
        if (v.colour) r += v.colour->r, g += v.colour->g, b += v.colour->b, ++coloured;
      }
      whole.beliefs = combined(rule, beliefs);
      const auto mean = [&](int sum) {
        return static_cast<std::uint8_t>(std::floor(sum / double(coloured) + 0.5));
      };
      if (coloured > 0) whole.colour = Colour{mean(r), mean(g), mean(b)};
      voxels.push_back(whole);
    }
  }
  return voxels;
}

TEST(ReadAt, EqualsTheReadingByHand) {
  for (const FusionRule& rule :
       {FusionRule(kBlend), FusionRule(VoteRule{}), FusionRule(MaxConfidenceRule{})}) {
    const SemanticMap map = carved_map(8, rule);
    for (const int times : {1, 2, 4, 8}) {
      const auto expected = by_hand(map, rule, times), found = read_at(map, rule, times);
      ASSERT_EQ(found.size(), expected.size()) << times;
      EXPECT_TRUE(std::equal(found.begin(), found.end(), expected.begin(), equal_voxels)) << times;
    }
  }
  EXPECT_THROW((void)read_at(carved_map(1), kBlend, 3), Error);
  EXPECT_THROW((void)read_at(carved_map(1), kBlend, 0), Error);
  EXPECT_TRUE(read_at(SemanticMap(kEdge), kBlend, 8).empty());
}

TEST(Query, BoxAndRegionAndClassEqualAFilterOverAllVoxels) {
  const SemanticMap map = carved_map(10);
  RandomStream stream(5, "boxes");
  const auto all = map.voxels();
  std::size_t found = 0;
  for (int n = 0; n < 200; ++n) {
    Eigen::AlignedBox3d box;
    for (int corner = 0; corner < 2; ++corner)
      box.extend(Eigen::Vector3d(4 * stream.uniform() - 2, 4 * stream.uniform() - 2,
                                 3 * stream.uniform() - 1.5));
    if (n % 5 == 0) box = {centre_of({-3, -2, 0}, kEdge), centre_of({4, 5, 6}, kEdge)};
    const auto in_sphere = [&](const Eigen::Vector3d& c) { return c.norm() < 1.2; };
    VoxelWanted wanted;
    wanted.free_too = n % 2 == 0;
    if (n % 3 == 0) wanted = {ClassId{1}, 0.3, false};
    std::vector<MapVoxel> expected;
    for (const MapVoxel& v : all) {
      const Eigen::Vector3d c = centre_of(v.key, kEdge);
      if (!box.contains(c) || !in_sphere(c) || (!v.occupied && !wanted.free_too)) continue;
      if (wanted.class_id && (v.best_class != 1 || v.probability < 0.3)) continue;
      expected.push_back(v);
    }
    EXPECT_EQ(rows(voxels_in_region(map, box, in_sphere, wanted)), rows(expected));
    found += expected.size();
    EXPECT_GE(voxels_in_box(map, box, wanted).size(), expected.size());
  }
  EXPECT_GT(found, 1000u);
  EXPECT_THROW((void)voxels_in_box(map, Eigen::AlignedBox3d()), Error);
}

TEST(VoxelFilter, KeepsThePointNearestToEachCentre) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const std::vector<Eigen::Vector3d> points{{0.01, 0.01, 0.01}, {0.04, 0.05, 0.05}, {nan, 0, 0},
                                            {0.04, 0.05, 0.05}, {-0.01, 0, 0},      {0, 1e9, 0}};
  EXPECT_THAT(testing::voxel_filter(points, kEdge), ::testing::ElementsAre(1, 4))
      << "a tie goes to the first";
  EXPECT_TRUE(testing::voxel_filter({}, kEdge).empty());
  EXPECT_THROW((void)testing::voxel_filter(points, 0.0), Error);
}

TEST(Export, AtAnyResolutionInEitherColour) {
  const auto file = std::filesystem::path(::testing::TempDir()) / "mapscore_export_at.ot";
  const SemanticMap map = carved_map(6);
  ClassTable table;
  for (ClassId id = 1; id <= 3; ++id)
    table.classes.push_back({id, "c", {static_cast<std::uint8_t>(id * 50), 0, 9}, true});
  for (const int times : {1, 2, 8})
    for (const Paint paint : {Paint::classes, Paint::seen}) {
      export_color_at(map, kBlend, times, paint, table, 0.2, file);
      const std::unique_ptr<octomap::AbstractOcTree> read(
          octomap::AbstractOcTree::read(file.string()));
      const auto* tree = dynamic_cast<octomap::ColorOcTree*>(read.get());
      ASSERT_NE(tree, nullptr);
      EXPECT_DOUBLE_EQ(tree->getResolution(), kEdge * times);
      std::size_t expected = 0;
      for (const CoarseVoxel& v : read_at(map, kBlend, times)) {
        const ClassProbability best = v.best();
        const bool classed = best.class_id != kBackground && best.probability >= 0.2;
        if (!v.occupied || (paint == Paint::classes ? !classed : !v.colour)) continue;
        const Colour colour =
            paint == Paint::classes ? table.classes[best.class_id].colour : *v.colour;
        const auto* node = tree->search(octree_key(v.key));
        ASSERT_NE(node, nullptr);
        EXPECT_EQ(node->getColor(), octomap::ColorOcTreeNode::Color(colour.r, colour.g, colour.b));
        ++expected;
      }
      EXPECT_EQ(tree->getNumLeafNodes(), expected);
      EXPECT_GT(expected, 0u);
    }
  EXPECT_THROW(export_color_at(map, kBlend, 1, Paint::classes, ClassTable{}, 0.2, file), Error);
  std::filesystem::remove(file);
}

}  // namespace
}  // namespace mapscore
