// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#include "eval/map_files/map_file.hpp"
#include "tests/eval/map_files/cloud_bytes.hpp"
#include "tests/eval/map_files/octree_maps.hpp"
#include "tests/support/expect_error.hpp"

#include <fmt/format.h>
#include <octomap/OcTreeStamped.h>

#include <functional>
#include <limits>
#include <memory>
#include <set>

namespace mapscore::eval {
namespace {

using testing::expect_error;
using testing::put;

constexpr float kInfinite = std::numeric_limits<float>::infinity();

struct OctreeFile : testing::MapFiles {
  void expect_refusal(const std::string& bytes, const std::string& part) {
    const auto path = file("map.ot", bytes);
    expect_error("map.ot:", [&] { (void)read_octree(path); });
    expect_error(part, [&] { (void)read_octree(path); });
  }
};

/// Every voxel of the map is what `tree` says of it, and the map has all that the tree has.
/// `expect_node` looks at the labels.
template <class Tree, class ExpectNode>
void expect_same(const MapFile& map, const Tree& tree, ExpectNode&& expect_node) {
  EXPECT_DOUBLE_EQ(map.edge_m, tree.getResolution());
  EXPECT_TRUE(map.points.empty() && map.instances.empty() && map.names.empty());
  ASSERT_EQ(map.occupied.size(), map.voxels.size());
  ASSERT_EQ(map.probabilities.size(), map.voxels.size());
  for (std::size_t n = 0; n < map.voxels.size(); ++n) {
    const auto* node = tree.search(octree_key(map.voxels[n]));
    ASSERT_NE(node, nullptr) << "voxel " << n;
    ASSERT_EQ(map.occupied[n] != 0, tree.isNodeOccupied(node)) << "voxel " << n;
    expect_node(n, *node);
  }
  std::size_t covered = 0;
  for (auto leaf = tree.begin_leafs(), end = tree.end_leafs(); leaf != end; ++leaf)
    covered += std::size_t{1} << (3 * (tree.getTreeDepth() - leaf.getDepth()));
  EXPECT_EQ(map.voxels.size(), covered);
  EXPECT_EQ(std::set<VoxelKey>(map.voxels.begin(), map.voxels.end()).size(), covered);
}

/// As above for a tree that has occupancy alone.
template <class Tree>
void expect_same_occupancy(const MapFile& map, const Tree& tree) {
  EXPECT_EQ(map.label_kind, LabelKind::none);
  EXPECT_TRUE(map.labels.empty());
  expect_same(map, tree, [&](std::size_t n, const auto& node) {
    ASSERT_EQ(map.probabilities[n], node.getOccupancy()) << "voxel " << n;
  });
}

template <class Tree>
std::unique_ptr<Tree> read_by_octomap(const std::filesystem::path& file) {
  auto* tree = dynamic_cast<Tree*>(octomap::AbstractOcTree::read(file.string()));
  EXPECT_NE(tree, nullptr);
  return std::unique_ptr<Tree>(tree);
}

TEST_F(OctreeFile, PlainTreeIsWhatOctoMapReads) {
  const octomap::OcTree tree = testing::plain_tree();
  const auto path = folder_ / "plain.ot";
  testing::write_ot(tree, path);
  const MapFile map = read_octree(path);
  ASSERT_LT(tree.getNumLeafNodes(), map.size()) << "something was pruned";
  expect_same_occupancy(map, *read_by_octomap<octomap::OcTree>(path));
  const auto occupied = std::ranges::count(map.occupied, 1);
  EXPECT_GT(occupied, 500);
  EXPECT_GT(map.size() - static_cast<std::size_t>(occupied), 5000u) << "free space";
}

TEST_F(OctreeFile, BinaryTreeIsWhatOctoMapReads) {
  const auto path = folder_ / "plain.bt";
  testing::write_bt(testing::plain_tree(), path);
  octomap::OcTree tree(1.0);
  ASSERT_TRUE(tree.readBinary(path.string()));
  const MapFile map = read_octree(path);
  expect_same_occupancy(map, tree);
  EXPECT_NEAR(*std::ranges::max_element(map.probabilities), 0.971, 1e-6);
  EXPECT_NEAR(*std::ranges::min_element(map.probabilities), 0.1192, 1e-6);
}

TEST_F(OctreeFile, BinaryFileOfAColourTreeHasOccupancyAlone) {
  const auto path = folder_ / "colour.bt";
  testing::write_bt(testing::colour_tree(), path);
  octomap::ColorOcTree tree(1.0);
  ASSERT_TRUE(tree.readBinary(path.string()));
  expect_same_occupancy(read_octree(path), tree);
}

TEST_F(OctreeFile, StampedTreeIsReadWithoutItsStamps) {
  octomap::OcTreeStamped tree(0.125);
  for (int n = 0; n < 40; ++n) tree.updateNode(octree_key({n - 20, n * n % 7, -n}), n % 3 != 0);
  const auto path = folder_ / "stamped.ot";
  testing::write_ot(tree, path);
  expect_same_occupancy(read_octree(path), tree);
}

TEST_F(OctreeFile, ColourTreeIsWhatOctoMapReads) {
  const auto path = folder_ / "colour.ot";
  testing::write_ot(testing::colour_tree(), path);
  const MapFile map = read_octree(path);
  EXPECT_EQ(map.label_kind, LabelKind::colour);
  ASSERT_EQ(map.labels.size(), map.voxels.size());
  std::set<std::uint32_t> colours;
  expect_same(map, *read_by_octomap<octomap::ColorOcTree>(path),
              [&](std::size_t n, const octomap::ColorOcTreeNode& node) {
                const auto colour = node.getColor();
                ASSERT_EQ(map.labels[n],
                          static_cast<std::uint32_t>(colour.r << 16 | colour.g << 8 | colour.b));
                ASSERT_EQ(map.probabilities[n], node.getOccupancy());
                colours.insert(map.labels[n]);
              });
  EXPECT_EQ(colours, (std::set<std::uint32_t>{0x0110c8, 0x0a10c8, 0x6310c8, 0xfa10c8, 0xffffff}));
}

void expect_same_classes(const std::filesystem::path& path) {
  const MapFile map = read_octree(path);
  EXPECT_EQ(map.label_kind, LabelKind::id);
  ASSERT_EQ(map.labels.size(), map.voxels.size());
  std::set<std::uint32_t> classes;
  expect_same(map, *read_by_octomap<SemanticOcTree>(path),
              [&](std::size_t n, const SemanticOcTreeNode& node) {
                ASSERT_EQ(map.labels[n], node.best().class_id);
                ASSERT_EQ(map.probabilities[n], node.best().probability);
                classes.insert(map.labels[n]);
              });
  EXPECT_EQ(classes, (std::set<std::uint32_t>{0, 1, 2, 3}));
}

TEST_F(OctreeFile, SavedSemanticMapIsWhatOctoMapReads) {
  testing::semantic_map().save(folder_ / "map.ot");
  expect_same_classes(folder_ / "map.ot");
}

TEST_F(OctreeFile, PrunedSemanticTreeIsWhatOctoMapReads) {
  SemanticOcTree tree(0.02);
  for (int i = -8; i < 8; ++i)
    for (int j = -8; j < 8; ++j)
      for (int k = 0; k < 4; ++k) {
        auto* node = tree.updateNode(octree_key({i, j, k}), i < 4);
        if (j >= 0)
          node->mutable_beliefs() =
              ClassBeliefs({{1, 0.25}, {2, i < 0 ? 0.5 : 0.25}, {3, j < 4 ? 0.125 : 1.0}});
      }
  tree.prune();
  testing::write_ot(tree, folder_ / "map.ot");
  ASSERT_EQ(tree.getNumLeafNodes(), 16u) << "blocks of four voxels a side";
  expect_same_classes(folder_ / "map.ot");
}

std::string header(const std::string& id, std::size_t nodes, const std::string& res = "0.1") {
  return fmt::format("# Octomap OcTree file\n# by hand\nid {}\nsize {}\nres {}\ndata\n", id, nodes,
                     res);
}

std::string binary_header(std::size_t nodes) {
  return fmt::format("# Octomap OcTree binary file\nid OcTree\nsize {}\nres 0.1\ndata\n", nodes);
}

/// Nodes of a plain tree one below the other, each the last child of the one before.
std::string chain(int nodes, float log_odds = 1.0f, char last_child = '\x80') {
  std::string bytes;
  for (int n = 0; n < nodes; ++n) {
    put(bytes, log_odds);
    bytes.push_back(n + 1 < nodes ? last_child : '\0');
  }
  return bytes;
}

/// The same of a .bt file: `inner` nodes, the last one with an occupied first child.
std::string binary_chain(int inner) {
  std::string bytes;
  for (int n = 0; n + 1 < inner; ++n) put<std::uint16_t>(bytes, 3);
  put<std::uint16_t>(bytes, 2);
  return bytes;
}

TEST_F(OctreeFile, FirstAndLastVoxelOfTheSpan) {
  const MapFile last = read_octree(file("last.ot", header("OcTree", 17) + chain(17, 0.0f)));
  EXPECT_EQ(last.voxels, (std::vector<VoxelKey>{{32767, 32767, 32767}}));
  EXPECT_EQ(last.occupied, std::vector<std::uint8_t>{1}) << "log-odds of 0 are occupied";
  EXPECT_EQ(last.probabilities, std::vector<double>{0.5});
  EXPECT_EQ(last.edge_m, 0.1);
  const MapFile first = read_octree(file("first.ot", header("OcTree", 17) + chain(17, -1e-6f, 1)));
  EXPECT_EQ(first.voxels, (std::vector<VoxelKey>{{-32768, -32768, -32768}}));
  EXPECT_EQ(first.occupied, std::vector<std::uint8_t>{0});
  const MapFile binary = read_octree(file("first.bt", binary_header(17) + binary_chain(16)));
  EXPECT_EQ(binary.voxels, first.voxels);
  EXPECT_EQ(binary.occupied, std::vector<std::uint8_t>{1});
}

TEST_F(OctreeFile, ALeafOneLevelUpCoversEightVoxels) {
  const MapFile map = read_octree(file("map.ot", header("OcTree", 16) + chain(16)));
  EXPECT_EQ(map.voxels, (std::vector<VoxelKey>{{32766, 32766, 32766},
                                               {32766, 32766, 32767},
                                               {32766, 32767, 32766},
                                               {32766, 32767, 32767},
                                               {32767, 32766, 32766},
                                               {32767, 32766, 32767},
                                               {32767, 32767, 32766},
                                               {32767, 32767, 32767}}));
  EXPECT_EQ(map.occupied, std::vector<std::uint8_t>(8, 1));
  EXPECT_EQ(map.probabilities, std::vector<double>(8, octomap::probability(1.0)));
}

TEST_F(OctreeFile, HeaderLinesMayComeInAnyOrderAndEndInCrLf) {
  const std::string bytes =
      "# Octomap OcTree file\r\n#\r\nres 0.1\r\nsize 17\r\nauthor x y\r\nid OcTree\r\ndata\r\n";
  EXPECT_EQ(read_octree(file("map.ot", bytes + chain(17))).size(), 1u);
}

TEST_F(OctreeFile, WhatTheFileIsStandsInItAndNotInItsName) {
  EXPECT_EQ(read_octree(file("map.ot", binary_header(17) + binary_chain(16))).size(), 1u);
}

TEST_F(OctreeFile, RefusesAnEmptyMap) {
  testing::write_ot(octomap::OcTree(0.1), folder_ / "empty.ot");
  expect_error("empty.ot: the map is empty", [&] { (void)read_octree(folder_ / "empty.ot"); });
  testing::write_bt(octomap::OcTree(0.1), folder_ / "empty.bt");
  expect_error("empty.bt: the map is empty", [&] { (void)read_octree(folder_ / "empty.bt"); });
}

TEST_F(OctreeFile, RefusesWhatIsNoOctree) {
  expect_refusal("", "no octree");
  expect_refusal("ply\n", "no octree");
  expect_refusal(header("CountingOcTree", 17) + chain(17), ":3: octrees of type 'CountingOcTree'");
  expect_error("gone.ot: cannot open", [&] { (void)read_octree(folder_ / "gone.ot"); });
}

TEST_F(OctreeFile, RefusesADamagedHeader) {
  for (const char* res : {"0", "-0.1", "nan", "inf", "1e999", "", "0.1 m", "x"})
    expect_refusal(header("OcTree", 17, res) + chain(17), ":5: expected 'res'");
  expect_refusal("# Octomap OcTree file\nid OcTree\nsize -1\nres 0.1\ndata\n",
                 ":3: expected 'size'");
  expect_refusal("# Octomap OcTree file\nid OcTree\nsize 1\nres 0.1\n", "no line 'data'");
  expect_refusal("# Octomap OcTree file\nsize 17\nres 0.1\ndata\n" + chain(17), "lacks 'id'");
  expect_refusal("# Octomap OcTree file\nid OcTree\nres 0.1\ndata\n" + chain(17), "lacks");
  expect_refusal("# Octomap OcTree file\nid OcTree\nsize 17\ndata\n" + chain(17), "lacks");
}

TEST_F(OctreeFile, RefusesMissingAndSpareNodesAndBytes) {
  const std::string nodes = chain(17);
  expect_refusal(header("OcTree", 18) + nodes, "holds 17 nodes, its header says 18");
  expect_refusal(header("OcTree", 16) + nodes, "more than the 16 nodes");
  expect_refusal(header("OcTree", 17) + nodes + "x", "1 bytes stand after its last node");
  expect_refusal(binary_header(18) + binary_chain(16), "holds 17 nodes");
  expect_refusal(binary_header(17) + binary_chain(16) + "x", "1 bytes stand after");
  for (std::size_t kept = 0; kept < nodes.size(); ++kept)
    expect_refusal(header("OcTree", 17) + nodes.substr(0, kept), "truncated");
}

TEST_F(OctreeFile, RefusesNodesBelowTheFinest) {
  expect_refusal(header("OcTree", 18) + chain(18), "deeper than 16 levels");
  expect_refusal(binary_header(18) + binary_chain(17), "deeper than 16 levels");
  constexpr int kEndless = 1'000'000;  // each node would be a call of OctoMap's recursion
  expect_refusal(header("OcTree", kEndless) + chain(kEndless), "deeper than 16 levels");
  expect_refusal(binary_header(kEndless) + binary_chain(kEndless), "deeper than 16 levels");
}

TEST_F(OctreeFile, RefusesLeavesThatCoverTooMuch) {
  expect_refusal(header("OcTree", 1) + chain(1), "its leaves cover 281474976710656 voxels");
  expect_refusal(header("OcTree", 8) + chain(8), "its leaves cover 134217728 voxels");
  expect_refusal(binary_header(2) + binary_chain(1),
                 "cover 35184372088832 voxels, at most 50000000");
}

TEST_F(OctreeFile, RefusesMoreVoxelsThanItsBytesAreWorth) {
  EXPECT_EQ(read_octree(file("room.ot", header("OcTree", 10) + chain(10))).voxels.size(),
            std::size_t{1 << 21});
  expect_refusal(header("OcTree", 9) + chain(9), "cover 16777216 voxels, more than 128 a byte");
}

TEST_F(OctreeFile, RefusesDamagedNodes) {
  expect_refusal(header("OcTree", 17) + chain(17, kInfinite), "node 1 has odds of inf");
  expect_refusal(header("OcTree", 17) + chain(17, -kInfinite), "node 1 has odds of -inf");
  std::string empty_inner;
  put<std::uint16_t>(empty_inner, 0);
  expect_refusal(binary_header(1) + empty_inner, "an inner node has no children");
  for (const double probability : {-0.25, 1.5, std::numeric_limits<double>::quiet_NaN()}) {
    std::string node;
    put(node, 1.0f);
    put<std::uint16_t>(node, 1);
    put<ClassId>(node, 3);
    put(node, probability);
    node.push_back('\0');
    expect_refusal(header("SemanticOcTree", 1) + node, probability == 1.5
                                                           ? "node 1 has a class of probability 1.5"
                                                           : "node 1 has a class of weight");
  }
}

}  // namespace
}  // namespace mapscore::eval
