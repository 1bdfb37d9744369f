// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#include "core/segmentation/edge_aligned/depth_edges.hpp"

#include "plate_scene.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <set>
#include <vector>

namespace mapscore {
namespace {

constexpr double kMiddle = 159.5;  // of 320 columns, 240 rows

/// A plate 2 m away in columns 100 to 149 before a wall at 3 m, with a ledge at both its sides; the
/// columns after which, and before which, steps are found.
std::set<double> steps_with_ledge(double ledge_m, int width_px) {
  const Calibration camera = testing::PlateScene({}).truth();
  cv::Mat1w depth(240, 320, static_cast<std::uint16_t>(3.0 * kDepthUnitsPerMetre));
  depth.colRange(100 - width_px, 150 + width_px) =
      static_cast<std::uint16_t>(ledge_m * kDepthUnitsPerMetre);
  depth.colRange(100, 150) = static_cast<std::uint16_t>(2.0 * kDepthUnitsPerMetre);
  std::set<double> columns;
  for (const DepthEdge& step : find_depth_edges(depth, camera).steps)
    columns.insert(
        std::round(2 * static_cast<double>(step.point.x() / step.point.z()) * camera.depth.fx_px) /
            2 +
        kMiddle);
  return columns;
}

TEST(DepthEdges, AreWhereASurfaceEnds) {
  EXPECT_EQ(steps_with_ledge(2.0, 0), (std::set{99.5, 149.5}));
  EXPECT_EQ(steps_with_ledge(2.05, 4), (std::set{95.5, 153.5}))
      << "a crease of 5 cm beside the plate's end is none";
}

/// A plate 2 m away whose right side ends before nothing, from the upper border to a row.
TEST(DepthEdges, EndBeforeNothingButNotBeforeANearHole) {
  const Calibration camera = testing::PlateScene({}).truth();
  const auto ends = [&](const cv::Rect& hole) {
    cv::Mat1w depth(240, 320, static_cast<std::uint16_t>(2.0 * kDepthUnitsPerMetre));
    depth(hole).setTo(0);
    const std::vector<DepthEdge> steps = find_depth_edges(depth, camera).steps;
    return std::ranges::count(steps, Outward::right, &DepthEdge::outward);
  };
  EXPECT_EQ(ends({200, 0, 120, 200}), 200) << "nothing";
  EXPECT_EQ(ends({200, 0, 120, 240}), 240) << "open: from the upper to the lower border";
  EXPECT_LT(ends({200, 40, 120, 200}), 40) << "near: on the lower border alone";
}

TEST(DepthEdges, OfAnObjectBeforeAnotherStay) {
  EXPECT_EQ(steps_with_ledge(2.2, 4), (std::set{95.5, 99.5, 149.5, 153.5}));
}

TEST(DepthEdges, OfACreaseFarFromTheEndStay) {
  EXPECT_EQ(steps_with_ledge(2.05, 6), (std::set{93.5, 155.5}));
  EXPECT_EQ(steps_with_ledge(2.05, 7), (std::set{92.5, 99.5, 149.5, 156.5}));
}

}  // namespace
}  // namespace mapscore
