// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#include "core/error.hpp"
#include "core/mapping/semantic_map.hpp"
#include "core/placement/placement.hpp"
#include "tests/core/not_finite.hpp"

#include <gtest/gtest.h>

#include <string>

namespace mapscore {
namespace {

using testing::kInf;
using testing::kNan;

constexpr int kLow = -(1 << 20), kHigh = (1 << 20) - 1;

/// Few draws are placed point by point, many by parts.
class FarPlacement : public ::testing::TestWithParam<int> {
 protected:
  [[nodiscard]] std::vector<VoxelHit> placed(const std::vector<Eigen::Vector3d>& positions,
                                             const Pose& pose = Pose::Identity()) const {
    return place({{1, 1.0, positions}}, std::vector<Pose>(GetParam(), pose), 0.05);
  }
  [[nodiscard]] VoxelHit hit(const VoxelKey& key) const {
    return {key, 1, GetParam(), static_cast<double>(GetParam())};
  }
};

TEST_P(FarPlacement, BeyondThePackableRangeIsItsLastVoxel) {
  for (const double far : {52428.8, 104857.7, 1e9, 1e300}) {
    EXPECT_EQ(placed({{far, 0.12, 0.12}}), (std::vector{hit({kHigh, 2, 2})})) << far;
    EXPECT_EQ(placed({{0.12, -far - 1, far}}), (std::vector{hit({2, kLow, kHigh})})) << far;
    Pose pose = Pose::Identity();
    pose.translation().x() = far;
    EXPECT_EQ(placed({{0.0, 0.12, 0.12}}, pose), (std::vector{hit({kHigh, 2, 2})})) << far;
  }
  EXPECT_EQ(placed({{52428.76, 0.12, -52428.79}}), (std::vector{hit({kHigh, 2, kLow})}));
  EXPECT_EQ(placed({{52428.74, 0.12, 0.12}}), (std::vector{hit({kHigh - 1, 2, 2})}));
}

TEST_P(FarPlacement, NearPositionsStayWhereTheyAre) {
  EXPECT_EQ(placed({{0.12, 0.12, 0.12}, {1e300, 0.12, 0.12}, {kNan, 0.12, 0.12}}),
            (std::vector{hit({2, 2, 2}), hit({kHigh, 2, 2})}));
}

TEST_P(FarPlacement, WhatIsNotFiniteIsLeftOut) {
  EXPECT_TRUE(placed({{kNan, 0, 0}, {0, kInf, 0}, {0, 0, -kInf}}).empty());
  Pose pose = Pose::Identity();
  pose.translation().y() = kNan;
  EXPECT_TRUE(placed({{0, 0, 1}}, pose).empty());
}

TEST_P(FarPlacement, IsLeftOutOfTheMapAndCounted) {
  SemanticMap map(0.05);
  map.fuse(placed({{0.12, 0.12, 0.12}, {104857.7, 0.12, 0.12}, {0, -1e300, 0}}), GetParam(),
           VoteRule{});
  EXPECT_EQ(map.voxels().size(), 1u);
  EXPECT_EQ(map.hits_beyond_span(), 2u);
}

TEST_P(FarPlacement, EdgesThatAreNoLengthAreRefused) {
  const std::vector<Pose> draws(GetParam(), Pose::Identity());
  for (const double edge_m : {0.0, -0.05, kNan, kInf})
    EXPECT_THROW((void)place({{1, 1.0, {{0, 0, 1}}}}, draws, edge_m), Error) << edge_m;
}

INSTANTIATE_TEST_SUITE_P(Draws, FarPlacement, ::testing::Values(1, 8, 200));

}  // namespace
}  // namespace mapscore
