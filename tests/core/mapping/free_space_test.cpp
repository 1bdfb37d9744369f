// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

// Carving against its twin, OctoMap itself: octomap::OcTree::insertPointCloud, discretised.

#include "core/mapping/free_space.hpp"

#include "core/error.hpp"
#include "core/mapping/semantic_octree.hpp"
#include "core/random_stream.hpp"
#include "tests/core/geometry/voxel_ray.hpp"

#include <gtest/gtest.h>
#include <octomap/OcTree.h>

#include <algorithm>
#include <cstddef>
#include <limits>
#include <set>
#include <vector>

namespace mapscore {
namespace {

struct Scan {
  Eigen::Vector3d origin;
  std::vector<Eigen::Vector3d> points;
};

/// OctoMap's coordinates are single precision.
Eigen::Vector3d single(const Eigen::Vector3d& p) {
  return p.cast<float>().cast<double>();
}

/// Walls, clutter and far points around a sensor that may stand anywhere.
Scan random_scan(RandomStream& stream, int points, double reach_m) {
  const auto anywhere = [&](double size_m) {
    return Eigen::Vector3d(size_m * (stream.uniform() - 0.5), size_m * (stream.uniform() - 0.5),
                           size_m * (stream.uniform() - 0.5));
  };
  Scan scan{single(anywhere(0.5 * reach_m)), {}};
  for (int n = 0; n < points; ++n) {
    Eigen::Vector3d p = anywhere(2 * reach_m);
    if (n % 3 == 0) p.x() = 0.3 * reach_m;                  // a wall
    if (n % 7 == 0) p.tail<2>() = scan.origin.tail<2>();    // along an axis
    if (n % 11 == 0) p = scan.origin + 0.01 * anywhere(1);  // in the sensor's own voxel
    scan.points.push_back(single(p));
  }
  return scan;
}

void insert_by_octomap(const Scan& scan, double max_range_m, octomap::OcTree& tree) {
  const auto point = [](const Eigen::Vector3d& p) {
    return octomap::point3d(static_cast<float>(p.x()), static_cast<float>(p.y()),
                            static_cast<float>(p.z()));
  };
  octomap::Pointcloud cloud;
  for (const Eigen::Vector3d& p : scan.points) cloud.push_back(point(p));
  tree.insertPointCloud(cloud, point(scan.origin), max_range_m, false, true);
}

/// Every node, inner ones included: key, depth and log-odds.
template <class Tree>
std::vector<std::tuple<std::uint64_t, unsigned, float>> nodes_of(const Tree& tree) {
  std::vector<std::tuple<std::uint64_t, unsigned, float>> nodes;
  for (auto node = tree.begin_tree(), end = tree.end_tree(); node != end; ++node)
    nodes.emplace_back(pack(voxel_key(node.getKey())), node.getDepth(), node->getLogOdds());
  return nodes;
}

struct Case {
  double edge_m, reach_m;
  int points, scans;
  double max_range_m;  ///< below 0: none
};
void PrintTo(const Case& c, std::ostream* out) {
  *out << "edge " << c.edge_m << " m, reach " << c.reach_m << " m, range ";
  if (c.max_range_m < 0)
    *out << "unlimited";
  else
    *out << c.max_range_m << " m";
}

class AgainstOctomap : public ::testing::TestWithParam<Case> {};

TEST_P(AgainstOctomap, EveryNodeOfTheTreeIsEqualAfterEveryScan) {
  const Case& c = GetParam();
  RandomStream stream(11, "carve");
  octomap::OcTree theirs(c.edge_m);
  SemanticOcTree ours(c.edge_m);
  Scan scan;
  for (int n = 0; n < c.scans; ++n) {
    if (n % 8 < 2) scan = random_scan(stream, c.points, c.reach_m);  // repeated until it clamps
    insert_by_octomap(scan, c.max_range_m, theirs);
    const auto range = c.max_range_m < 0 ? std::nullopt : std::optional(c.max_range_m);
    ours.observe(seen_space(scan.origin, scan.points, c.edge_m, range).blocks);
    ASSERT_EQ(nodes_of(ours), nodes_of(theirs)) << "scan " << n;
    ASSERT_EQ(ours.size(), theirs.size());
  }
  EXPECT_GT(ours.getNumLeafNodes(), 1000u);
}

INSTANTIATE_TEST_SUITE_P(
    Scans, AgainstOctomap,
    ::testing::Values(Case{0.05, 3.0, 1000, 16, -1}, Case{0.1, 6.0, 1000, 16, -1},
                      Case{0.05, 3.0, 1000, 16, 1.9}, Case{0.2, 15.0, 300, 24, 7},
                      Case{0.0625, 3.0, 1000, 12, -1}, Case{0.02, 1.0, 600, 12, -1}));

TEST(SeenSpace, ManySmallScansFromVoxelPlanes) {
  RandomStream stream(12, "carve");
  const double edge_m = 0.0625;  // all coordinates on quarters of it: ties everywhere
  octomap::OcTree theirs(edge_m);
  SemanticOcTree ours(edge_m);
  const auto quarter = [&] { return std::floor(64 * stream.uniform() - 32) * edge_m / 4; };
  for (int n = 0; n < 600; ++n) {
    Scan scan{{quarter(), quarter(), quarter()}, {}};
    for (int p = 0; p < 4; ++p) scan.points.emplace_back(quarter(), quarter(), quarter());
    insert_by_octomap(scan, -1, theirs);
    ours.observe(seen_space(scan.origin, scan.points, edge_m).blocks);
  }
  EXPECT_EQ(nodes_of(ours), nodes_of(theirs));
}

std::vector<VoxelKey> voxels_of(const SpaceBlocks& blocks, bool hit) {
  std::vector<VoxelKey> voxels;
  for (const SpaceBlock& block : blocks)
    for (int n = 0; n < 512; ++n) {
      const auto& bits = hit ? block.hit : block.free;
      if ((bits[static_cast<std::size_t>(n >> 6)] >> (n & 63) & 1) == 0) continue;
      const auto axis = [&](int a) {
        return (n >> 6 >> a & 1) * 4 + (n >> 3 >> a & 1) * 2 + (n >> a & 1);
      };
      voxels.push_back(
          {block.key.i * 8 + axis(0), block.key.j * 8 + axis(1), block.key.k * 8 + axis(2)});
    }
  std::sort(voxels.begin(), voxels.end());
  return voxels;
}

TEST(SeenSpace, OneRayIsTheExactTraversalBeforeItsEnd) {
  RandomStream stream(13, "carve");
  const double edge_m = 0.05;
  std::size_t other = 0, all = 0;
  for (int n = 0; n < 2000; ++n) {
    Scan scan = random_scan(stream, 2, 4.0);
    scan.points.erase(scan.points.begin());
    scan.points[0] = centre_of(voxel_of(scan.points[0], edge_m), edge_m);
    auto exact = voxels_on_segment(scan.origin, scan.points[0], edge_m);
    if (!exact.empty()) exact.pop_back();
    std::sort(exact.begin(), exact.end());
    const auto free = voxels_of(seen_space(scan.origin, scan.points, edge_m).blocks, false);
    std::vector<VoxelKey> differ;
    std::set_symmetric_difference(free.begin(), free.end(), exact.begin(), exact.end(),
                                  std::back_inserter(differ));
    other += differ.size();
    all += exact.size();
  }
  EXPECT_GT(all, 50000u);
  EXPECT_LT(other, all / 1000) << "single precision decides only where a ray grazes an edge";
}

TEST(SeenSpace, HitWinsAndListedVoxelsAreHit) {
  const std::vector<Eigen::Vector3d> points{{1.05, 0.05, 0.05}, {0.55, 0.05, 0.05}};
  const std::vector<VoxelKey> listed{{2, 0, 0}, {0, 7, 0}};
  const SeenSpace seen = seen_space({0.05, 0.05, 0.05}, points, 0.1, {}, listed);
  EXPECT_EQ(voxels_of(seen.blocks, true),
            (std::vector<VoxelKey>{{0, 7, 0}, {2, 0, 0}, {5, 0, 0}, {10, 0, 0}}));
  EXPECT_EQ(
      voxels_of(seen.blocks, false),
      (std::vector<VoxelKey>{
          {0, 0, 0}, {1, 0, 0}, {3, 0, 0}, {4, 0, 0}, {6, 0, 0}, {7, 0, 0}, {8, 0, 0}, {9, 0, 0}}));
}

TEST(SeenSpace, LeavesOutWhatIsNowhere) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const double inf = std::numeric_limits<double>::infinity();
  const std::vector<Eigen::Vector3d> points{
      {nan, 0, 0}, {0, inf, 0}, {0, 0, 1e9}, {0.05 * 40000, 0, 0}, {0.31, 0.01, 0.01}};
  const SeenSpace seen = seen_space({0.01, 0.01, 0.01}, points, 0.05);
  EXPECT_EQ(seen.points_left_out, 4u);
  EXPECT_EQ(voxels_of(seen.blocks, true), (std::vector<VoxelKey>{{6, 0, 0}}));
  EXPECT_TRUE(seen_space({0, 0, 0}, {}, 0.05).blocks.empty());
}

TEST(SeenSpace, RefusesBadInput) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const std::vector<Eigen::Vector3d> corners{{-1600, -1600, -1600}, {1600, 1600, 1600}};
  EXPECT_THROW((void)seen_space({0, 0, 0}, {}, 0.0), Error);
  EXPECT_THROW((void)seen_space({nan, 0, 0}, {}, 0.05), Error);
  EXPECT_THROW((void)seen_space({1e6, 0, 0}, {}, 0.05), Error);
  EXPECT_THROW((void)seen_space({0, 0, 0}, {}, 0.05, 0.0), Error);
  EXPECT_THROW((void)seen_space({0, 0, 0}, corners, 0.05), Error) << "10^14 voxels";
}

}  // namespace
}  // namespace mapscore
