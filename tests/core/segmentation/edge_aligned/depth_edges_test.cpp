// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#include "core/segmentation/edge_aligned/depth_edges.hpp"

#include "core/random_stream.hpp"
#include "plate_scene.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <set>
#include <utility>
#include <vector>

namespace mapscore {
namespace {

constexpr double kMiddle = 159.5;  // of 320 columns, 240 rows

/// A plate 2 m away in columns 100 to 149 before a wall at 3 m, with a ledge at both its sides; the
/// columns after which, and before which, steps are found.
std::set<double> steps_with_ledge(double ledge_m, int width_px, const DepthEdgeRules& rules = {}) {
  const Calibration camera = testing::PlateScene({}).truth();
  cv::Mat1w depth(240, 320, static_cast<std::uint16_t>(3.0 * kDepthUnitsPerMetre));
  depth.colRange(100 - width_px, 150 + width_px) =
      static_cast<std::uint16_t>(ledge_m * kDepthUnitsPerMetre);
  depth.colRange(100, 150) = static_cast<std::uint16_t>(2.0 * kDepthUnitsPerMetre);
  std::set<double> columns;
  for (const DepthEdge& step : find_depth_edges(depth, camera, rules).steps)
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

TEST(DepthEdges, OfAThickEndAreTheOuterOnesForACalibration) {
  const DepthEdgeRules outer{.same_depth = 0.06F};
  EXPECT_EQ(steps_with_ledge(2.1, 4), (std::set{95.5, 99.5, 149.5, 153.5}));
  EXPECT_EQ(steps_with_ledge(2.1, 4, outer), (std::set{95.5, 153.5}));
  EXPECT_EQ(steps_with_ledge(2.2, 4, outer), (std::set{95.5, 99.5, 149.5, 153.5}));
}

/// Left and right ends of a board .4 m away in columns 160 to 219 before a wall at 2 m, between
/// holes to its left and right, which are near but for their outermost 4 rows.
std::pair<int, int> ends_at_holes(double noise, int left_px, int right_px,
                                  const DepthEdgeRules& rules) {
  Calibration camera = testing::PlateScene({}).truth();
  camera.range_min_m = 0.35;
  RandomStream random(5, "board", {});
  cv::Mat1w depth(240, 320);
  for (int v = 0; v < 240; ++v)
    for (int u = 0; u < 320; ++u) {
      const double w = (u >= 160 && u < 220 ? 2.5 : 0.5) + noise * random.normal();
      depth(v, u) = cv::saturate_cast<std::uint16_t>(kDepthUnitsPerMetre / w);
    }
  depth(cv::Rect(160 - left_px, 20, left_px, 200)).setTo(0);
  depth(cv::Rect(220, 20, right_px, 200)).setTo(0);
  std::pair<int, int> ends;
  for (const DepthEdge& step : find_depth_edges(depth, camera, rules).steps) {
    const double x = static_cast<double>(step.point.x() / step.point.z()) * camera.depth.fx_px;
    ends.first += step.outward == Outward::left && std::abs(x + kMiddle - 159.5) < 0.1 ? 1 : 0;
    ends.second += step.outward == Outward::right && std::abs(x + kMiddle - 219.5) < 0.1 ? 1 : 0;
  }
  return ends;
}

/// 0.075 m between camera and projector throw a shadow of 43 px.
TEST(DepthEdges, AtAProjectorsShadowStandAtItsNearerEndForACalibration) {
  const DepthEdgeRules at_shadows{.shadow_ends = true};
  EXPECT_EQ(ends_at_holes(0.001, 43, 0, {}), (std::pair{48, 240}));
  EXPECT_EQ(ends_at_holes(0.001, 43, 0, at_shadows), (std::pair{240, 240}));
  EXPECT_EQ(ends_at_holes(0.001, 60, 0, at_shadows), (std::pair{48, 240})) << "wider than a shadow";
  EXPECT_EQ(ends_at_holes(0.001, 0, 43, at_shadows), (std::pair{240, 48})) << "on the other side";
  EXPECT_EQ(ends_at_holes(0, 43, 0, at_shadows), (std::pair{48, 240})) << "no noise, no projector";
}

}  // namespace
}  // namespace mapscore
