// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#include "core/mapping/placement.hpp"

#include "core/mapping/pose_belief.hpp"
#include "core/random_stream.hpp"
#include "tests/core/mapping/counted_draws.hpp"
#include "tests/core/mapping/plain_draws.hpp"

#include <gtest/gtest.h>

#include <string>

namespace mapscore {
namespace {

/// Surfaces as a depth camera sees them: patches at several depths, with flying positions at their
/// borders, classes and scores that may repeat.
Observation random_patches(RandomStream& stream, int objects, bool own_scores) {
  Observation observation;
  for (int n = 0; n < objects; ++n) {
    ObservedObject object;
    object.class_id = static_cast<ClassId>(stream.bits() % 5);
    object.score = own_scores ? 0.2 + 0.8 * stream.uniform() : 1.0;
    const double z0 = 0.7 + 2.0 * stream.uniform(), slope = stream.uniform() - 0.5;
    const double u0 = 1.2 * stream.uniform() - 0.6, v0 = 0.8 * stream.uniform() - 0.4;
    const int columns = 5 + static_cast<int>(stream.bits() % 30);
    for (int v = 0; v < 24; ++v)
      for (int u = 0; u < columns; ++u) {
        const double z = z0 + slope * 0.005 * u + (u == 0 ? 0.3 * stream.uniform() : 0.0);
        object.positions.push_back({z * (u0 + 0.006 * u), z * (v0 + 0.006 * v), z});
      }
    observation.push_back(std::move(object));
  }
  return observation;
}

std::vector<Pose> random_draws(RandomStream& stream, int draws, double sigma_m, double sigma_rad) {
  PoseBelief belief;
  belief.T_odom_base =
      planar_pose(8 * stream.uniform() - 4, 8 * stream.uniform() - 4, 6.3 * stream.uniform());
  belief.covariance.diagonal() << sigma_m * sigma_m, sigma_m * sigma_m, 0.25 * sigma_m * sigma_m,
      0.1 * sigma_rad * sigma_rad, 0.1 * sigma_rad * sigma_rad, sigma_rad * sigma_rad;
  Pose T_base_depth = Pose::Identity();
  T_base_depth.linear() << 0, 0, 1, -1, 0, 0, 0, -1, 0;
  T_base_depth.translation() << 0.1, 0.0, 1.0;
  std::vector<Pose> poses =
      draw_poses(belief, draws, NoiseAt::base, CovarianceUse::diagonal, stream);
  for (Pose& pose : poses) pose = pose * T_base_depth;
  return poses;
}

struct Spread {
  double sigma_m, sigma_rad;
};
void PrintTo(const Spread& spread, std::ostream* out) {
  *out << spread.sigma_m << " m, " << spread.sigma_rad << " rad";
}

class ManyDraws : public ::testing::TestWithParam<Spread> {};

TEST_P(ManyDraws, AreThePlainPassesBitForBit) {
  RandomStream stream(11, "many draws");
  for (int round = 0; round < 40; ++round) {
    const Observation observation = random_patches(stream, 1 + round % 7, round % 2 == 1);
    const double edge_m = round % 3 == 0 ? 0.02 : round % 3 == 1 ? 0.05 : 0.13;
    const auto draws =
        random_draws(stream, 4 + round % 9, GetParam().sigma_m, GetParam().sigma_rad);
    const auto hits = place(observation, draws, edge_m);
    ASSERT_EQ(hits, testing::plain_place(observation, draws, edge_m)) << "round " << round;
    ASSERT_EQ(hits, testing::counted_place(observation, draws, edge_m)) << "round " << round;
    ASSERT_FALSE(hits.empty());
  }
}

INSTANTIATE_TEST_SUITE_P(Spreads, ManyDraws,
                         ::testing::Values(Spread{0.0, 0.0}, Spread{0.01, 0.002},
                                           Spread{0.03, 0.03}, Spread{0.1, 0.15},
                                           Spread{0.02, 0.25}, Spread{0.5, 1.0}));

TEST(ManyDraws, PositionsOnBoundariesFallAsInThePlainPasses) {
  Observation observation(2);
  observation[0].class_id = 1;
  observation[1].class_id = 2;
  for (int i = -12; i <= 12; ++i)
    for (int j = -12; j <= 12; ++j)
      observation[(i + j) & 1].positions.push_back({i * 0.0125, j * 0.025, 0.05 * (i - j)});
  std::vector<Pose> draws(9, Pose::Identity());
  for (int n = 0; n < 9; ++n) draws[n].translation() << 0.0125 * n, -0.05 * n, 0.00625 * n;
  EXPECT_EQ(place(observation, draws, 0.05), testing::plain_place(observation, draws, 0.05));
}

/// Draws are taken in batches of 128; sums of scores go on from batch to batch.
TEST(ManyDraws, AreThePlainPassesWhereverBatchesEnd) {
  RandomStream stream(12, "batches");
  for (const int draws : {15, 16, 17, 63, 64, 65, 127, 128, 129, 300}) {
    const Observation observation = random_patches(stream, 6, true);
    const auto poses = random_draws(stream, draws, 0.03, 0.02);
    EXPECT_EQ(place(observation, poses, 0.05), testing::plain_place(observation, poses, 0.05))
        << draws << " draws";
  }
}

TEST(ManyDraws, ClassesThatMeetEverywhereAreCountedAsInThePlainPasses) {
  RandomStream stream(13, "confetti");
  Observation observation;
  for (int n = 0; n < 12; ++n)
    observation.push_back({static_cast<ClassId>(n % 5), 0.3 + 0.05 * (n % 7), {}});
  for (int n = 0; n < 6000; ++n)
    observation[stream.bits() % 12].positions.push_back(
        {0.6 * stream.uniform() - 0.3, 0.6 * stream.uniform() - 0.3, 1.0 + 0.4 * stream.uniform()});
  for (const double sigma : {0.0, 0.02, 0.2}) {
    const auto draws = random_draws(stream, 20, sigma, sigma);
    EXPECT_EQ(place(observation, draws, 0.05), testing::plain_place(observation, draws, 0.05));
  }
}

TEST(ManyDraws, MoreScoresThanGroupsAndFarPositionsAreCountedToo) {
  Observation many_scores;
  for (int n = 0; n < 70; ++n)
    many_scores.push_back({static_cast<ClassId>(n % 3), (n + 1) / 70.0, {{0.01 * n, 0.02, 1.0}}});
  const std::vector<Pose> draws(5, Pose::Identity());
  EXPECT_EQ(place(many_scores, draws, 0.05), testing::plain_place(many_scores, draws, 0.05));
  const Observation far{{1, 1.0, {{0, 0, 1}, {900, 0, 1}}}, {2, 0.5, {{0, 0, 1}}}};
  EXPECT_EQ(place(far, draws, 0.05), testing::plain_place(far, draws, 0.05));
}

TEST(ManyDraws, NothingSeenGivesNothing) {
  const std::vector<Pose> draws(5, Pose::Identity());
  EXPECT_TRUE(place({}, draws, 0.05).empty());
  EXPECT_TRUE(place({{1, 1.0, {}}}, draws, 0.05).empty());
}

}  // namespace
}  // namespace mapscore
