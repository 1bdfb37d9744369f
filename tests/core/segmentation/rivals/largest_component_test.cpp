// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#include "core/segmentation/rivals/largest_component.hpp"

#include "core/random_stream.hpp"
#include "tests/core/segmentation/rivals/mask_scene.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <numeric>

namespace mapscore {
namespace {

using mapscore::testing::MaskScene;

/// A mask of 20 x 10 pixels whose last 6 columns leak onto something half a metre behind.
MaskScene leaking() {
  MaskScene scene;
  scene.label(cv::Rect(10, 10, 20, 10)) = 1;
  scene.depth(cv::Rect(24, 0, 16, 30)) = 12500;
  return scene;
}

TEST(LargestComponent, ALeakOntoSomethingBehindIsLeftOut) {
  const MaskScene scene = leaking();
  const Segment segment = scene.segment_by(LargestComponent{});
  EXPECT_EQ(segment.points, scene.points({{10, 10, 14, 10}}));
  EXPECT_EQ(segment.skipped, SkipReason::none);
  EXPECT_FALSE(segment.voxel_centres.empty());
}

TEST(LargestComponent, AllKeepsEveryComponentOfEnoughPoints) {
  const MaskScene scene = leaking();  // 140 and 60 points
  const auto kept = [&](int min_points) {
    return scene.segment_by(LargestComponent{.min_points = min_points, .keep = KeptComponents::all})
        .points;
  };
  EXPECT_EQ(kept(60), scene.points({{10, 10, 20, 10}}));
  EXPECT_EQ(kept(61), scene.points({{10, 10, 14, 10}}));
  EXPECT_TRUE(kept(141).empty());
}

TEST(LargestComponent, CellsThatShareACornerAreOneComponent) {
  MaskScene scene;
  scene.depth.setTo(0);
  scene.label.setTo(1);
  // Cells of 2 m: (0, 0, 0) and (-1, -1, 1), then one that lies a cell beyond them.
  scene.depth(cv::Rect(25, 20, 10, 5)) = 9000;
  scene.depth(cv::Rect(5, 5, 10, 5)) = 11000;
  const LargestComponent kind{.cell_m = 2};
  EXPECT_EQ(scene.segment_by(kind).points, scene.points({{25, 20, 10, 5}, {5, 5, 10, 5}}));
  scene.depth(cv::Rect(5, 5, 10, 5)) = 21000;  // 4.2 m: the cell between is empty
  EXPECT_EQ(scene.segment_by(kind).points, scene.points({{5, 5, 10, 5}})) << "the first of equals";
}

TEST(LargestComponent, TooFewPointsYieldNothing) {
  MaskScene scene;
  scene.label(cv::Rect(0, 0, 7, 7)) = 1;
  const Segment segment = scene.segment_by(LargestComponent{});
  EXPECT_TRUE(segment.points.empty());
  EXPECT_TRUE(segment.voxel_centres.empty());
  EXPECT_EQ(segment.skipped, SkipReason::no_points);
  scene.label(0, 7) = 1;
  EXPECT_EQ(scene.segment_by(LargestComponent{}).points, scene.points({{0, 0, 7, 7}, {7, 0, 1, 1}}))
      << "cut by the image's corner";
}

TEST(LargestComponent, NoDepthYieldsNothing) {
  MaskScene scene = leaking();
  scene.depth.setTo(0);
  EXPECT_EQ(scene.segment_by(LargestComponent{}).skipped, SkipReason::no_points);
}

/// The components of points by comparing every pair of their cells.
std::vector<std::size_t> plain_components(const std::vector<Eigen::Vector3d>& points,
                                          double cell_m) {
  std::vector<std::size_t> component(points.size());
  std::iota(component.begin(), component.end(), std::size_t{0});
  const auto touch = [&](std::size_t a, std::size_t b) {
    const VoxelKey p = voxel_of(points[a], cell_m), q = voxel_of(points[b], cell_m);
    return std::max({std::abs(p.i - q.i), std::abs(p.j - q.j), std::abs(p.k - q.k)}) <= 1;
  };
  for (bool changed = true; changed;) {
    changed = false;
    for (std::size_t a = 0; a < points.size(); ++a)
      for (std::size_t b = 0; b < points.size(); ++b)
        if (component[b] < component[a] && touch(a, b)) component[a] = component[b], changed = true;
  }
  return component;
}

TEST(LargestComponent, EqualsThePlainFormOnRandomDepths) {
  for (std::uint64_t seed = 0; seed < 20; ++seed) {
    RandomStream random(seed, "largest component");
    MaskScene scene;
    scene.label(cv::Rect(2, 3, 30, 20)) = 1;
    for (std::uint16_t& value : scene.depth)
      value = random.uniform() < 0.3 ? static_cast<std::uint16_t>(5000 + 8000 * random.uniform())
                                     : std::uint16_t{0};
    const std::vector<Eigen::Vector3d> all = scene.segment_by(Direct{}).points;
    const std::vector<std::size_t> component = plain_components(all, 0.05);
    std::map<std::size_t, int> sizes;
    for (const std::size_t c : component) ++sizes[c];
    const auto largest = std::ranges::max_element(
        sizes, [](const auto& a, const auto& b) { return a.second < b.second; });
    std::vector<Eigen::Vector3d> expected;
    for (std::size_t n = 0; n < all.size(); ++n)
      if (component[n] == largest->first) expected.push_back(all[n]);
    EXPECT_EQ(scene.segment_by(LargestComponent{.cell_m = 0.05, .min_points = 1}).points, expected)
        << seed;
    EXPECT_LT(expected.size(), all.size());
  }
}

}  // namespace
}  // namespace mapscore
