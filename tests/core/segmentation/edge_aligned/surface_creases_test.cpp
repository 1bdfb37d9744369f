// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#include "core/segmentation/edge_aligned/surface_creases.hpp"

#include "plate_scene.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <vector>

namespace mapscore {
namespace {

using namespace mapscore::testing;

/// 240 rows of 320 pixels with w = 1/z as given, rounded to a depth in steps of `grain_m`.
DepthEdges surface(const std::function<double(int u, int v)>& w, double grain_m) {
  cv::Mat1w depth(240, 320);
  for (int v = 0; v < depth.rows; ++v)
    for (int u = 0; u < depth.cols; ++u)
      depth(v, u) = static_cast<std::uint16_t>(std::lround(1.0 / w(u, v) / grain_m) * grain_m *
                                               kDepthUnitsPerMetre);
  return find_depth_edges(depth, PlateScene({}).truth());
}

constexpr double kFocal_px = 277.1, kCamera_m = 0.9;  // focal length; height above the floor

double floor_at(int v) {
  return (v - 119.5) / (kFocal_px * kCamera_m);
}
/// A wall 3 m away, which meets the floor at v = 119.5 + 83.1.
double wall_on_floor(int /*u*/, int v) {
  return std::max(1.0 / 3.0, floor_at(v));
}

TEST(SurfaceCreases, PartAWallFromItsFloorAndNothingElse) {
  for (const double grain_m : {0.0002, 0.001}) {
    const DepthEdges edges = surface(wall_on_floor, grain_m);
    const Continuity on = part_at_creases(edges);
    EXPECT_EQ(cv::countNonZero(edges.right != on.right), 0) << grain_m;
    EXPECT_EQ(cv::countNonZero(edges.down != on.down), 320) << grain_m;
    EXPECT_EQ(cv::countNonZero(on.down.rowRange(201, 204) == 0), 320) << grain_m;
  }
}

/// An edge that stands out, as of a box, does not part its faces.
TEST(SurfaceCreases, AreConcave) {
  const auto ridge = [](int u, int /*v*/) { return 0.6 - 0.002 * std::abs(u - 160); };
  const DepthEdges edges = surface(ridge, 0.0002);
  EXPECT_EQ(cv::countNonZero(part_at_creases(edges).right != edges.right), 0);
  const auto valley = [](int u, int /*v*/) { return 0.3 + 0.002 * std::abs(u - 160); };
  const DepthEdges concave = surface(valley, 0.0002);
  EXPECT_EQ(cv::countNonZero(part_at_creases(concave).right != concave.right), 240);
}

/// Of a skirting three pixels high, before a far wall, two slopes of two pixels tell the crease.
TEST(SurfaceCreases, AreToldBesideAStep) {
  const auto skirting = [](int u, int v) { return v < 200 ? 1.0 / 6.0 : wall_on_floor(u, v); };
  const DepthEdges edges = surface(skirting, 0.0002);
  const Continuity on = part_at_creases(edges);
  EXPECT_EQ(cv::countNonZero(on.down != edges.down), 320);
  EXPECT_EQ(cv::countNonZero(on.down.rowRange(201, 204) == 0), 320);
}

/// The foot of a wall is an edge that faces the floor, half a pixel below the wall's last row.
TEST(SurfaceCreases, OfColumnsAreEdgesThatFaceDown) {
  const DepthEdges edges = surface(wall_on_floor, 0.0002);
  const Calibration camera = PlateScene({}).truth();
  const std::vector<DepthEdge> contacts = contacts_of(edges, part_at_creases(edges), camera.depth);
  ASSERT_EQ(contacts.size(), 320U);
  EXPECT_TRUE(edges.steps.empty());
  for (const DepthEdge& contact : contacts) {
    EXPECT_EQ(contact.outward, Outward::down);
    EXPECT_EQ(contact.strength, 1.0F);
    EXPECT_NEAR(contact.point.z(), 3.0, 0.02);
    EXPECT_NEAR(camera.depth.project(contact.point.cast<double>()).y(), 202.5, 1.01);
  }
}

/// A crease of a row, as where an object stands at a wall, may face either way: it is no edge.
TEST(SurfaceCreases, OfRowsAreNoEdges) {
  const auto valley = [](int u, int /*v*/) { return 0.3 + 0.002 * std::abs(u - 160); };
  const DepthEdges edges = surface(valley, 0.0002);
  const Continuity parted = part_at_creases(edges);
  ASSERT_EQ(cv::countNonZero(parted.right != edges.right), 240);
  EXPECT_TRUE(contacts_of(edges, parted, PlateScene({}).truth().depth).empty());
}

}  // namespace
}  // namespace mapscore
