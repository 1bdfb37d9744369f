// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#include "core/geometry/camera.hpp"
#include "core/random_stream.hpp"
#include "core/segmentation/growing/region_growing.hpp"
#include "tests/core/not_finite.hpp"
#include "tests/core/points.hpp"
#include "tests/core/segmentation/growing/growing_variant.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace mapscore {
namespace {

using testing::GrowingVariant;
using testing::kInf;
using testing::kNan;
using testing::Points;

class FastRegionGrowing : public ::testing::TestWithParam<GrowingVariant> {};

/// A bumpy sheet, a second one behind it, and stray points.
Points narrow_cloud(RandomStream& stream, int count) {
  Points points;
  for (int n = 0; n < count; ++n) {
    const double sheet = stream.uniform() < 0.6 ? 1.0 : 1.35;
    points.emplace_back(0.3 * stream.uniform(), 0.3 * stream.uniform(),
                        sheet + 0.02 * stream.normal());
    if (n % 10 == 9) points.emplace_back(stream.normal(), stream.normal(), 1 + stream.uniform());
  }
  return points;
}

/// Together more than 10,000 clouds for the factors 1 and 1/2, of every shape from a point to a few
/// pieces, some of them 1 km away.
TEST_P(FastRegionGrowing, EqualsThePlainFormOnThousandsOfClouds) {
  const auto [factor, released] = GetParam();
  for (std::uint64_t round = 0; round < 2600; ++round) {
    RandomStream stream(23, "thousands of clouds", {round});
    Points points = narrow_cloud(stream, 1 + static_cast<int>(round % 40));
    const double pitch = 0.03 + 0.1 * stream.uniform();
    const double far = round % 5 == 0 ? 1e3 : 0.0;
    for (Eigen::Vector3d& p : points) p += Eigen::Vector3d(far, -far, far);
    if (round % 7 == 0) points[points.size() / 2].y() = round % 2 ? kNan : kInf;
    const Eigen::Vector3d seed =
        points.front() + 0.3 * pitch * Eigen::Vector3d(stream.normal(), stream.normal(), 0);
    const Region fast = grow_region(points, seed, pitch, factor, released);
    const Region plain = grow_region_reference(points, seed, pitch, factor, released);
    ASSERT_EQ(fast.positions, plain.positions) << "cloud " << round;
    ASSERT_EQ(fast.points, plain.points) << "cloud " << round;
  }
}

/// As a depth camera stores it, 2 mm of noise, at a voxel edge of 1 cm.
TEST_P(FastRegionGrowing, EqualsThePlainFormOnAWallThatFillsTheImage) {
  const auto [factor, released] = GetParam();
  const CameraModel camera = CameraModel::from_hfov(640, 480, 1.02);
  RandomStream stream(29, "wall");
  Points wall;
  for (int v = 0; v < 480; ++v) {
    for (int u = 0; u < 640; ++u) {
      const double z = 2.0 + 2e-4 * u + 0.002 * stream.normal();
      wall.push_back(camera.back_project(u, v, std::round(5000 * z) / 5000));
    }
  }
  const Eigen::Vector3d seed = wall[240 * 640 + 320];
  const Region fast = grow_region(wall, seed, 0.01, factor, released);
  const Region plain = grow_region_reference(wall, seed, 0.01, factor, released);
  EXPECT_GT(fast.positions.size(), 10000u);
  EXPECT_TRUE(fast.positions == plain.positions);
  EXPECT_TRUE(fast.points == plain.points);
}

INSTANTIATE_TEST_SUITE_P(Variants, FastRegionGrowing,
                         ::testing::Values(GrowingVariant{1.0, false}, GrowingVariant{0.5, false},
                                           GrowingVariant{1.0, true}, GrowingVariant{0.5, true}));

}  // namespace
}  // namespace mapscore
