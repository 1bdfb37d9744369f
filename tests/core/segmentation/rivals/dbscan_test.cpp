// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#include "core/segmentation/rivals/dbscan.hpp"

#include "core/random_stream.hpp"
#include "tests/core/points.hpp"
#include "tests/core/segmentation/rivals/mask_scene.hpp"

#include <gtest/gtest.h>

#include <deque>

namespace mapscore {
namespace {

using mapscore::testing::MaskScene;
using mapscore::testing::Points;

/// DBSCAN as its paper has it: points in their order, each unseen core point starts a cluster,
/// which takes whatever it reaches that no earlier one took. O(n^2).
std::vector<int> plain_clusters(const Points& points, double eps_m, int min_points) {
  const auto near = [&](std::size_t a) {
    std::vector<std::size_t> found;
    for (std::size_t b = 0; b < points.size(); ++b)
      if ((points[a] - points[b]).squaredNorm() <= eps_m * eps_m) found.push_back(b);
    return found;
  };
  const auto is_core = [&](std::size_t n) {
    return static_cast<int>(near(n).size()) >= min_points;
  };
  std::vector<int> cluster(points.size(), kNoCluster);
  int count = 0;
  for (std::size_t start = 0; start < points.size(); ++start) {
    if (cluster[start] != kNoCluster || !is_core(start)) continue;
    cluster[start] = count;
    for (std::deque<std::size_t> queue{start}; !queue.empty(); queue.pop_front()) {
      if (!is_core(queue.front())) continue;
      for (const std::size_t b : near(queue.front()))
        if (cluster[b] == kNoCluster) cluster[b] = count, queue.push_back(b);
    }
    ++count;
  }
  return cluster;
}

Points on_a_line(const std::vector<double>& xs) {
  Points points;
  for (const double x : xs) points.emplace_back(x, 0, 1);
  return points;
}

TEST(Dbscan, ABorderPointJoinsTheFirstClusterThatReachesIt) {
  // Two groups of four with a point between that each reaches, and two points alone.
  const Points points = on_a_line({9, 6.0, 0.0, 0.3, 0.6, 0.9, 1.8, 2.7, 3.0, 3.3, 3.6});
  EXPECT_EQ(dbscan_clusters(points, 1.0, 4), (std::vector<int>{-1, -1, 0, 0, 0, 0, 0, 1, 1, 1, 1}));
  const Points turned = on_a_line({2.7, 3.0, 3.3, 3.6, 1.8, 0.0, 0.3, 0.6, 0.9});
  EXPECT_EQ(dbscan_clusters(turned, 1.0, 4), (std::vector<int>{0, 0, 0, 0, 0, 1, 1, 1, 1}));
}

TEST(Dbscan, RadiusAndCountIncludeTheirLimits) {
  const Points points = on_a_line({0, 1, 2});
  EXPECT_EQ(dbscan_clusters(points, 1.0, 3), (std::vector<int>{0, 0, 0})) << "the middle is core";
  EXPECT_EQ(dbscan_clusters(points, 1.0, 4), (std::vector<int>{-1, -1, -1}));
  EXPECT_EQ(dbscan_clusters(points, 0.999, 2), (std::vector<int>{-1, -1, -1}));
  EXPECT_EQ(dbscan_clusters(points, 0.999, 1), (std::vector<int>{0, 1, 2}));
  EXPECT_TRUE(dbscan_clusters({}, 1.0, 1).empty());
}

TEST(Dbscan, EqualsThePlainFormOnRandomPoints) {
  std::size_t noise = 0, clusters = 0;
  for (std::uint64_t seed = 0; seed < 60; ++seed) {
    RandomStream random(seed, "dbscan");
    Points points(150);
    for (Eigen::Vector3d& point : points)
      point = {random.uniform() - 0.5, random.uniform() - 0.5, 0.5 * random.uniform()};
    const double eps_m = 0.05 + 0.15 * random.uniform();
    const int min_points = 1 + static_cast<int>(6 * random.uniform());
    const std::vector<int> expected = plain_clusters(points, eps_m, min_points);
    EXPECT_EQ(dbscan_clusters(points, eps_m, min_points), expected) << seed;
    for (const int cluster : expected) noise += cluster == kNoCluster, clusters += cluster > 0;
  }
  EXPECT_GT(noise, 100u);
  EXPECT_GT(clusters, 100u);
}

TEST(Dbscan, EqualsThePlainFormOnALattice) {
  Points points;  // distances that equal the radius
  for (int i = 0; i < 6; ++i)
    for (int j = 0; j < 6; ++j)
      if ((i * 7 + j * 3) % 5 != 0) points.emplace_back(0.25 * i, 0.25 * j, 1);
  for (const int min_points : {2, 3, 4, 5})
    EXPECT_EQ(dbscan_clusters(points, 0.25, min_points), plain_clusters(points, 0.25, min_points));
}

TEST(Dbscan, ALeakOntoSomethingBehindIsLeftOut) {
  MaskScene scene;
  scene.label(cv::Rect(10, 10, 20, 10)) = 1;
  scene.depth(cv::Rect(24, 0, 16, 30)) = 11000;                      // 0.2 m behind
  const Segment segment = scene.segment_by(Dbscan{.cell_m = 0.01});  // a cell for each point
  EXPECT_EQ(segment.points, scene.points({{10, 10, 14, 10}}));
  EXPECT_EQ(segment.skipped, SkipReason::none);
  EXPECT_FALSE(segment.voxel_centres.empty());
}

TEST(Dbscan, WithoutALargeClusterEverythingStays) {
  MaskScene scene;
  scene.label(cv::Rect(0, 0, 3, 3)) = 1;  // nine means are no ten; cut by the image's corner
  EXPECT_EQ(scene.segment_by(Dbscan{}).points, scene.points({{0, 0, 3, 3}}));
  scene.depth(cv::Rect(0, 0, 2, 2)) = 10500;
  // Means 2 cm apart in two groups, of four and of five: only five are a cluster.
  EXPECT_EQ(scene.segment_by(Dbscan{.cell_m = 0.01, .min_points = 4}).points,
            scene.points({{2, 0, 1, 3}, {0, 2, 3, 1}}));
  scene.label(2, 2) = 0;
  EXPECT_EQ(scene.segment_by(Dbscan{.cell_m = 0.01, .eps_m = 0.03, .min_points = 2}).points,
            scene.points({{0, 0, 2, 2}, {2, 0, 1, 2}, {0, 2, 2, 1}}));
}

TEST(Dbscan, PointsOfACellStayTogether) {
  MaskScene scene;
  scene.label(cv::Rect(0, 0, 40, 30)) = 1;
  scene.depth(15, 20) = 10010;  // 2 mm behind, in the same cell
  EXPECT_EQ(scene.segment_by(Dbscan{.cell_m = 0.1, .eps_m = 0.15, .min_points = 4}).points,
            scene.points({{0, 0, 40, 30}}));
}

TEST(Dbscan, NoDepthYieldsNothing) {
  MaskScene scene;
  scene.label(cv::Rect(5, 5, 10, 10)) = 1;
  scene.depth.setTo(0);
  const Segment segment = scene.segment_by(Dbscan{});
  EXPECT_TRUE(segment.points.empty());
  EXPECT_EQ(segment.skipped, SkipReason::no_points);
}

}  // namespace
}  // namespace mapscore
