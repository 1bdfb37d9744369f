// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#include "tests/core/geometry/voxel_ray.hpp"

#include "core/error.hpp"
#include "core/random_stream.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <limits>
#include <set>

namespace mapscore {
namespace {

using ::testing::ElementsAre;
using Whole = std::array<std::int64_t, 3>;

TEST(VoxelRay, StraightAndStandingStill) {
  EXPECT_THAT(voxels_on_segment({0.1, 0.1, 0.1}, {0.1, 0.1, 0.1}, 1.0), ElementsAre(VoxelKey{}));
  EXPECT_THAT(voxels_on_segment({0.5, 0, 0}, {2.5, 0, 0}, 1.0),
              ElementsAre(VoxelKey{0, 0, 0}, VoxelKey{1, 0, 0}, VoxelKey{2, 0, 0}));
  EXPECT_THAT(voxels_on_segment({0.5, 0, 0}, {-1.5, 0, 0}, 1.0),
              ElementsAre(VoxelKey{0, 0, 0}, VoxelKey{-1, 0, 0}, VoxelKey{-2, 0, 0}));
}

TEST(VoxelRay, ThroughEdgesByHalfOpenCubes) {
  EXPECT_THAT(voxels_on_segment({0.5, 0.5, 0}, {1.5, 1.5, 0}, 1.0),
              ElementsAre(VoxelKey{0, 0, 0}, VoxelKey{1, 1, 0}));
  EXPECT_THAT(voxels_on_segment({1.5, 1.5, 0}, {0.5, 0.5, 0}, 1.0),
              ElementsAre(VoxelKey{1, 1, 0}, VoxelKey{0, 0, 0}));
  EXPECT_THAT(voxels_on_segment({0.5, 1.5, 0}, {1.5, 0.5, 0}, 1.0),
              ElementsAre(VoxelKey{0, 1, 0}, VoxelKey{1, 1, 0}, VoxelKey{1, 0, 0}))
      << "the point (1, 1) lies in (1, 1)";
}

TEST(VoxelRay, EndsOnPlanes) {
  EXPECT_THAT(voxels_on_segment({0.5, 0, 0}, {1.0, 0, 0}, 1.0),
              ElementsAre(VoxelKey{0, 0, 0}, VoxelKey{1, 0, 0}));
  EXPECT_THAT(voxels_on_segment({1.5, 0, 0}, {1.0, 0, 0}, 1.0), ElementsAre(VoxelKey{1, 0, 0}));
  EXPECT_THAT(voxels_on_segment({1.0, 0, 0}, {0.5, 0, 0}, 1.0),
              ElementsAre(VoxelKey{1, 0, 0}, VoxelKey{0, 0, 0}));
}

/// A share of the way as a fraction, below > 0, and whether the end itself is meant.
struct Bound {
  std::int64_t above, below;
  bool closed;
};
bool less(const Bound& a, const Bound& b) {
  return a.above * b.below < b.above * a.below;
}
bool equal(const Bound& a, const Bound& b) {
  return a.above * b.below == b.above * a.below;
}

/// Whether the segment from a to b, in quarters of a voxel, holds a point of the half-open cube:
/// the shares of the way inside its three slabs, cut with each other.
bool meets(const Whole& a, const Whole& b, const Whole& cell) {
  Bound enter{0, 1, true}, leave{1, 1, true};
  for (int n = 0; n < 3; ++n) {
    const std::int64_t low = 4 * cell[n], high = low + 4, way = b[n] - a[n];
    if (way == 0) {
      if (a[n] < low || a[n] >= high) return false;
      continue;
    }
    const Bound in = way > 0 ? Bound{low - a[n], way, true} : Bound{a[n] - high, -way, false};
    const Bound out = way > 0 ? Bound{high - a[n], way, false} : Bound{a[n] - low, -way, true};
    if (less(enter, in) || (equal(enter, in) && !in.closed)) enter = in;
    if (less(out, leave) || (equal(out, leave) && !out.closed)) leave = out;
  }
  return less(enter, leave) || (equal(enter, leave) && enter.closed && leave.closed);
}

std::int64_t whole_between(RandomStream& stream, int low, int high) {
  return low + static_cast<std::int64_t>(stream.uniform() * (high - low + 1));
}

TEST(VoxelRay, EqualsTheCubesThatASegmentMeetsOnALatticeFullOfTies) {
  RandomStream stream(1, "voxel_ray");
  std::size_t diagonal = 0;
  for (int round = 0; round < 3000; ++round) {
    Whole a, b;
    for (int n = 0; n < 3; ++n)
      a[n] = whole_between(stream, -14, 14), b[n] = whole_between(stream, -14, 14);
    std::set<VoxelKey> expected;
    for (std::int32_t i = -5; i < 5; ++i)
      for (std::int32_t j = -5; j < 5; ++j)
        for (std::int32_t k = -5; k < 5; ++k)
          if (meets(a, b, {i, j, k})) expected.insert({i, j, k});
    const double edge_m = 0.0625, quarter_m = edge_m / 4;
    const auto point = [&](const Whole& q) {
      return Eigen::Vector3d(static_cast<double>(q[0]) * quarter_m,
                             static_cast<double>(q[1]) * quarter_m,
                             static_cast<double>(q[2]) * quarter_m);
    };
    const auto found = voxels_on_segment(point(a), point(b), edge_m);
    ASSERT_EQ(std::set<VoxelKey>(found.begin(), found.end()), expected) << "round " << round;
    ASSERT_EQ(found.size(), expected.size()) << "a voxel twice in round " << round;
    for (std::size_t n = 1; n < found.size(); ++n)
      diagonal += (found[n].i != found[n - 1].i) + (found[n].j != found[n - 1].j) +
                      (found[n].k != found[n - 1].k) >
                  1;
  }
  EXPECT_GT(diagonal, 300u) << "steps through edges and corners";
}

TEST(VoxelRay, HoldsEverySampleOfLongSegments) {
  RandomStream stream(2, "voxel_ray");
  const double edge_m = 0.02;
  for (int round = 0; round < 200; ++round) {
    Eigen::Vector3d a, b;
    for (int n = 0; n < 3; ++n) a[n] = 8 * stream.uniform() - 4, b[n] = 8 * stream.uniform() - 4;
    const auto found = voxels_on_segment(a, b, edge_m);
    const std::set<VoxelKey> voxels(found.begin(), found.end());
    EXPECT_EQ(found.front(), voxel_of(a, edge_m));
    EXPECT_EQ(found.back(), voxel_of(b, edge_m));
    int missed = 0;
    for (int sample = 0; sample <= 20000; ++sample)
      missed += voxels.count(voxel_of(a + (b - a) * (sample / 20000.0), edge_m)) == 0;
    EXPECT_LE(missed, 1) << "within rounding of a plane";
    const VoxelKey last = found.back(), first = found.front();
    EXPECT_LE(found.size(), 1u + static_cast<std::size_t>(std::abs(last.i - first.i) +
                                                          std::abs(last.j - first.j) +
                                                          std::abs(last.k - first.k)));
  }
}

TEST(VoxelRay, BackwardsTheSameVoxelsOffTies) {
  RandomStream stream(3, "voxel_ray");
  for (int round = 0; round < 500; ++round) {
    Eigen::Vector3d a, b;
    for (int n = 0; n < 3; ++n) a[n] = 40 * stream.uniform() - 20, b[n] = 40 * stream.uniform();
    auto back = voxels_on_segment(b, a, 0.1);
    std::reverse(back.begin(), back.end());
    EXPECT_EQ(voxels_on_segment(a, b, 0.1), back);
  }
}

TEST(VoxelRay, RefusesBadInput) {
  const Eigen::Vector3d here = Eigen::Vector3d::Zero();
  const double nan = std::numeric_limits<double>::quiet_NaN();
  EXPECT_THROW((void)voxels_on_segment(here, here, 0.0), Error);
  EXPECT_THROW((void)voxels_on_segment(here, here, nan), Error);
  EXPECT_THROW((void)voxels_on_segment({nan, 0, 0}, here, 0.1), Error);
  EXPECT_THROW((void)voxels_on_segment(here, {0, 1e6, 0}, 0.1), Error);
}

}  // namespace
}  // namespace mapscore
