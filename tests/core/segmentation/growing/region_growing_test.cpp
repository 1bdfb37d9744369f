// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#include "core/segmentation/growing/region_growing.hpp"

#include "core/error.hpp"
#include "core/random_stream.hpp"
#include "tests/core/not_finite.hpp"
#include "tests/core/points.hpp"
#include "tests/core/segmentation/growing/growing_variant.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <deque>
#include <set>

// Its suite has the name of the parameters, which it would hide from other tests.
namespace mapscore::region_growing_test {
namespace {

using testing::GrowingVariant;
using testing::kInf;
using testing::kNan;
using testing::Points;

template <class Scalar>
bool reaches(const Eigen::Vector3d& position, const Eigen::Vector3d& p, double radius_m) {
  const auto difference = [&](int axis) {
    return static_cast<Scalar>(position[axis]) - static_cast<Scalar>(p[axis]);
  };
  const Scalar dx = difference(0), dy = difference(1), dz = difference(2);
  return dx * dx + dy * dy + dz * dz < static_cast<Scalar>(radius_m * radius_m);
}

/// The definition with neither tree nor grid: every position against every point.
Region grow_exhaustively(const Points& points, const Eigen::Vector3d& seed, double pitch_m,
                         double factor, bool released) {
  std::set<VoxelKey> tried{{0, 0, 0}};
  std::deque<VoxelKey> queue{{0, 0, 0}};
  std::set<int> kept;
  Region region;
  for (; !queue.empty(); queue.pop_front()) {
    const VoxelKey key = queue.front();
    const Eigen::Vector3d position = lattice_position(seed, pitch_m, key);
    bool accepted = false;
    for (std::size_t i = 0; i < points.size(); ++i) {
      if (!points[i].allFinite()) continue;
      const bool reached = released ? reaches<float>(position, points[i], factor * pitch_m)
                                    : reaches<double>(position, points[i], factor * pitch_m);
      if (reached) kept.insert(static_cast<int>(i));
      accepted = accepted || reached;
    }
    if (!accepted) continue;
    region.positions.push_back(key);
    for (int n = 0; n < 27; ++n) {
      const VoxelKey next{key.i + n / 9 - 1, key.j + n / 3 % 3 - 1, key.k + n % 3 - 1};
      if (tried.insert(next).second) queue.push_back(next);
    }
  }
  std::sort(region.positions.begin(), region.positions.end());
  region.points.assign(kept.begin(), kept.end());
  return region;
}

class RegionGrowing : public ::testing::TestWithParam<GrowingVariant> {
 protected:
  /// Both forms give `expected`.
  void expect_region(const Points& points, const Eigen::Vector3d& seed, double pitch_m,
                     const Region& expected) const {
    const auto [factor, released] = GetParam();
    const Region fast = grow_region(points, seed, pitch_m, factor, released);
    const Region plain = grow_region_reference(points, seed, pitch_m, factor, released);
    EXPECT_EQ(plain.positions, expected.positions);
    EXPECT_EQ(plain.points, expected.points);
    EXPECT_EQ(fast.positions, expected.positions);
    EXPECT_EQ(fast.points, expected.points);
  }
  void expect_exhaustive(const Points& points, const Eigen::Vector3d& seed, double pitch_m) const {
    const auto [factor, released] = GetParam();
    expect_region(points, seed, pitch_m,
                  grow_exhaustively(points, seed, pitch_m, factor, released));
  }
};

/// A bumpy sheet, a second one behind it, and stray points.
Points wide_cloud(RandomStream& stream, int count) {
  Points points;
  for (int n = 0; n < count; ++n) {
    const double x = 0.5 * stream.uniform(), y = 0.5 * stream.uniform();
    const double sheet = stream.uniform() < 0.6 ? 1.0 : 1.35;
    points.emplace_back(x, y, sheet + 0.02 * stream.normal());
    if (n % 10 == 0) points.emplace_back(stream.normal(), stream.normal(), 1 + stream.uniform());
  }
  return points;
}

TEST_P(RegionGrowing, NoPointsGiveNothing) {
  expect_region({}, {1, 2, 3}, 0.1, {});
}

TEST_P(RegionGrowing, OnePointAtTheSeed) {
  const auto [factor, released] = GetParam();
  const Region region = grow_region(Points{{1, 2, 3}}, {1, 2, 3}, 0.1, factor, released);
  EXPECT_EQ(region.points, std::vector<int>{0});
  EXPECT_TRUE(std::count(region.positions.begin(), region.positions.end(), VoxelKey{}) == 1);
  expect_exhaustive({{1, 2, 3}}, {1, 2, 3}, 0.1);
}

TEST_P(RegionGrowing, SeedOutOfReachOfEveryPointGivesNothing) {
  expect_region({{9, 9, 9}, {9.1, 9, 9}}, {1, 2, 3}, 0.1, {});
}

TEST_P(RegionGrowing, AllPointsInOneCell) {
  RandomStream stream(5, "one cell");
  Points points;
  for (int n = 0; n < 200; ++n)
    points.emplace_back(0.02 * stream.uniform(), 0.02 * stream.uniform(), 1.0);
  expect_exhaustive(points, points.front(), 0.1);
}

TEST_P(RegionGrowing, PointsExactlyOnTheRadiusAreOutOfReach) {
  const double factor = GetParam().factor;
  // Powers of two: positions, differences and squares are exact in both precisions.
  const double pitch = 0.25, radius = factor * pitch;
  Points points{{0, 0, 0}};
  for (int n = -4; n <= 4; ++n) {
    points.emplace_back(n * pitch + radius, 0, 0);
    points.emplace_back(0, n * pitch - radius, 0);
    points.emplace_back(0, 0, std::nextafter(n * pitch + radius, 0.0));
    points.emplace_back(0.6 * radius + n * pitch, 0.8 * radius, 0);
  }
  expect_exhaustive(points, {0, 0, 0}, pitch);
  expect_exhaustive(points, {pitch, pitch, 0}, pitch);
}

/// A KD-tree adds up its bounds in another order than a distance and alone would miss some of
/// these.
TEST_P(RegionGrowing, PointsWithinTheLastBitsOfTheRadius) {
  for (std::uint64_t round = 0; round < 40; ++round) {
    RandomStream stream(7, "last bits", {round});
    const double pitch = 0.05 + 0.1 * stream.uniform(), radius = GetParam().factor * pitch;
    const Eigen::Vector3d seed(stream.normal(), stream.normal(), 2 + stream.uniform());
    Points points;
    for (int n = 0; n < 200; ++n) {
      const Eigen::Vector3d direction(stream.normal(), stream.normal(), stream.normal());
      points.push_back(seed + radius * direction.normalized());
    }
    expect_exhaustive(points, seed, pitch);
  }
}

TEST_P(RegionGrowing, PointsOnPositionsAndHalfwayBetweenThem) {
  RandomStream stream(8, "half-way");
  const double pitch = 0.05;
  const Eigen::Vector3d seed(0.3, -0.2, 2.0);
  const auto half_steps = [&] { return 0.5 * pitch * std::floor(12 * stream.uniform()); };
  Points points{seed};
  for (int n = 0; n < 300; ++n)
    points.push_back(seed + Eigen::Vector3d(half_steps(), half_steps(), half_steps()));
  expect_exhaustive(points, seed, pitch);
}

TEST_P(RegionGrowing, RandomClouds) {
  for (std::uint64_t round = 0; round < 12; ++round) {
    RandomStream stream(11, "random clouds", {round});
    const Points points = wide_cloud(stream, 150);
    const double pitch = 0.02 + 0.08 * stream.uniform();
    expect_exhaustive(points, points.at(round), pitch);
    expect_exhaustive(points, points.at(round) + Eigen::Vector3d(0.01, 0.02, -0.01), pitch);
  }
}

TEST_P(RegionGrowing, SeedFarFromTheOriginOfItsFrame) {
  RandomStream stream(13, "far away");
  for (const double distance_m : {1e3, 1e5}) {
    Points points = wide_cloud(stream, 120);
    for (Eigen::Vector3d& p : points) p += Eigen::Vector3d(distance_m, -distance_m, distance_m);
    expect_exhaustive(points, points.front(), 0.05);
  }
}

TEST_P(RegionGrowing, StrayPointsTooFarForADenseGrid) {
  RandomStream stream(14, "strays");
  Points points = wide_cloud(stream, 100);
  const Eigen::Vector3d seed = points.front();
  points.emplace_back(1e6, 0, 0);
  points.emplace_back(-1e6, 1e6, 1e12);
  expect_exhaustive(points, seed, 0.05);
}

TEST_P(RegionGrowing, TinyCloudAtTheOrigin) {
  RandomStream stream(15, "tiny");
  Points points{{0, 0, 0}};
  const double radius = GetParam().factor * 0.05;
  for (int n = 0; n < 60; ++n) points.emplace_back(radius * (1 + 1e-8 * stream.normal()), 0, 0);
  expect_exhaustive(points, {0, 0, 0}, 0.05);
}

TEST_P(RegionGrowing, PointsThatAreNotFiniteAreIgnored) {
  RandomStream stream(17, "not finite");
  Points points = wide_cloud(stream, 80);
  const Eigen::Vector3d seed = points.front();
  for (std::size_t n = 3; n < points.size(); n += 7)
    points[n][static_cast<int>(n % 3)] = n % 2 ? kNan : (n % 4 ? kInf : -kInf);
  expect_exhaustive(points, seed, 0.05);
  expect_region({{kNan, kNan, kNan}, {kInf, 0, 0}}, {0, 0, 0}, 0.05, {});
}

TEST_P(RegionGrowing, ResultDoesNotDependOnTheOrderOfThePoints) {
  const auto [factor, released] = GetParam();
  RandomStream stream(19, "order");
  Points points = wide_cloud(stream, 150);
  const Eigen::Vector3d seed = points.front();
  const Region forwards = grow_region(points, seed, 0.05, factor, released);
  std::reverse(points.begin(), points.end());
  const Region backwards = grow_region(points, seed, 0.05, factor, released);
  EXPECT_EQ(forwards.positions, backwards.positions);
  EXPECT_EQ(forwards.points.size(), backwards.points.size());
}

INSTANTIATE_TEST_SUITE_P(Variants, RegionGrowing,
                         ::testing::Values(GrowingVariant{1.0, false}, GrowingVariant{0.5, false},
                                           GrowingVariant{1.0, true}, GrowingVariant{0.5, true},
                                           GrowingVariant{0.3, false}, GrowingVariant{0.75, true},
                                           GrowingVariant{1.7, false}, GrowingVariant{2.5, true}));

/// A row of points 1 m apart on a lattice of 1 m that starts at the first: worked by hand.
TEST(RegionGrowingByHand, FactorOfAHalfAcceptsThePointsOwnPositions) {
  const Points row{{5, 0, 0}, {6, 0.25, 0}, {7, 0.25, 0.25}, {9, 0, 0}};
  for (const auto& grow : {grow_region, grow_region_reference}) {
    const Region region = grow(row, row[0], 1.0, 0.5, false);
    EXPECT_EQ(region.positions, (std::vector<VoxelKey>{{0, 0, 0}, {1, 0, 0}, {2, 0, 0}}));
    EXPECT_EQ(region.points, (std::vector<int>{0, 1, 2}));  // (9, 0, 0) lies beyond a gap
  }
}

TEST(RegionGrowingByHand, FactorOfOneDrawsTwoLayersOfAPlaneBetweenThem) {
  const Points one{{0, 0, 0}, {0, 0, 0.5}};
  for (const auto& grow : {grow_region, grow_region_reference}) {
    const Region region = grow(one, one[0], 1.0, 1.0, false);
    EXPECT_EQ(region.positions, (std::vector<VoxelKey>{{0, 0, 0}, {0, 0, 1}}));
  }
}

TEST(RegionGrowingByHand, NeighboursTouchAtCorners) {
  const Points diagonal{{0, 0, 0}, {1, 1, 1}, {2, 0, 2}};
  for (const auto& grow : {grow_region, grow_region_reference}) {
    const Region region = grow(diagonal, diagonal[0], 1.0, 0.5, false);
    EXPECT_EQ(region.positions, (std::vector<VoxelKey>{{0, 0, 0}, {1, 1, 1}, {2, 0, 2}}));
  }
}

TEST(RegionGrowingByHand, PointOutsideEveryAcceptedSphereIsNotKept) {
  const Points points{{0, 0, 0}, {0.4, 0.4, 0}};  // 0.57 from (0, 0, 0) and from (1, 0, 0)
  for (const auto& grow : {grow_region, grow_region_reference})
    EXPECT_EQ(grow(points, points[0], 1.0, 0.5, false).points, std::vector<int>{0});
}

TEST(RegionGrowingByHand, SinglePrecisionDecidesTheReleasedForm) {
  // 1/4 - 2^-30 lies below k_r = 1/4 in doubles and rounds to it in single precision.
  const Points points{{0.25 - std::ldexp(1.0, -30), 0, 0}};
  for (const auto& grow : {grow_region, grow_region_reference}) {
    EXPECT_EQ(grow(points, {0, 0, 0}, 0.5, 0.5, false).points, std::vector<int>{0});
    EXPECT_TRUE(grow(points, {0, 0, 0}, 0.5, 0.5, true).points.empty());
  }
}

TEST(RegionGrowingByHand, RefusesPitchAndFactorThatAreNotPositive) {
  const Points points{{0, 0, 0}};
  for (const double bad : {0.0, -1.0, kNan, kInf}) {
    EXPECT_THROW((void)grow_region(points, points[0], bad, 1.0, false), Error);
    EXPECT_THROW((void)grow_region(points, points[0], 0.05, bad, false), Error);
  }
}

}  // namespace
}  // namespace mapscore::region_growing_test
