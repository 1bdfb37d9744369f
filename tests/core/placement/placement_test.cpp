// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#include "core/placement/placement.hpp"

#include "core/placement/pose_belief.hpp"
#include "core/random_stream.hpp"
#include "tests/core/not_finite.hpp"
#include "tests/core/placement/counted_draws.hpp"
#include "tests/core/placement/plain_draws.hpp"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <limits>
#include <numbers>
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
      draw_poses(belief, Draws{draws, NoiseAt::base, CovarianceUse::diagonal}, stream);
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

TEST(ManyDraws, AreThePlainPassesForAnyNumber) {
  RandomStream stream(12, "numbers");
  for (const int draws : {1, 2, 3, 4, 5, 10, 30, 100, 129}) {
    const Observation observation = random_patches(stream, 6, true);
    const auto poses = random_draws(stream, draws, 0.03, 0.02);
    EXPECT_EQ(place(observation, poses, 0.05), testing::plain_place(observation, poses, 0.05))
        << draws << " draws";
  }
}

TEST(ManyDraws, OfTheWholeCovarianceAboutEitherFrameAreThePlainPasses) {
  RandomStream stream(14, "covariances");
  PoseBelief belief;
  belief.T_map_odom = planar_pose(-20, 3, 1);
  belief.T_odom_base = planar_pose(-1, -2, 2.5);
  Covariance6 root;
  for (double& entry : root.reshaped()) entry = 0.04 * stream.uniform() - 0.02;
  belief.covariance = root * root.transpose();
  for (const NoiseAt noise_at : {NoiseAt::base, NoiseAt::odom})
    for (const CovarianceUse use : {CovarianceUse::diagonal, CovarianceUse::full}) {
      const Observation observation = random_patches(stream, 6, true);
      const auto poses = draw_poses(belief, Draws{30, noise_at, use}, stream);
      EXPECT_EQ(place(observation, poses, 0.05), testing::plain_place(observation, poses, 0.05));
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

TEST(ManyDraws, ObjectsOfOneClassCountTogetherAndTheBestScoreStands) {
  Observation many;
  for (int n = 0; n < 70; ++n)
    many.push_back({static_cast<ClassId>(n % 3), (n + 1) / 70.0, {{0.01 * n, 0.02, 1.0}}});
  const std::vector<Pose> draws(5, Pose::Identity());
  EXPECT_EQ(place(many, draws, 0.05), testing::plain_place(many, draws, 0.05));
  const Observation far{{1, 1.0, {{0, 0, 1}, {900, 0, 1}}}, {2, 0.5, {{0, 0, 1}}}};
  EXPECT_EQ(place(far, draws, 0.05), testing::plain_place(far, draws, 0.05));
}

/// Neighbours a quarter of a voxel apart, coordinates on quarters of a voxel of either sign, so
/// that many lie on faces, edges and corners of voxels; now and then one that is far, huge or no
/// number.
Observation lattice_points(RandomStream& stream, double edge_m, bool with_strays) {
  const Eigen::Vector3d strays[] = {
      {testing::kNan, 0, 0}, {0, 1e300, 0}, {33000 * edge_m, 0, 0}, {0, 0, -2e6 * edge_m}};
  Observation observation;
  for (int n = 0; n < 4; ++n) {
    ObservedObject object{static_cast<ClassId>(stream.bits() % 3), 0.5 + 0.1 * n, {}};
    const Eigen::Vector3d low =
        (8 * Eigen::Array3d(stream.uniform(), stream.uniform(), stream.uniform()) - 4).round();
    for (int v = 0; v < 12; ++v)
      for (int u = 0; u < 12; ++u) {
        object.positions.push_back(edge_m * (low + 0.25 * Eigen::Vector3d(u, v, (u + n * v) / 4)));
        if (with_strays && stream.bits() % 50 == 0)
          object.positions.push_back(strays[stream.bits() % 4]);
      }
    observation.push_back(std::move(object));
  }
  return observation;
}

/// Poses that keep lattice points on the lattice, poses that do not, poses far off, and matrices
/// that are no rotations.
Pose hostile_pose(RandomStream& stream, double edge_m) {
  Pose pose = Pose::Identity();
  const auto steps = [&] { return std::round(40 * stream.uniform() - 20); };
  pose.translation() = 0.25 * edge_m * Eigen::Vector3d(steps(), steps(), steps());
  switch (stream.bits() % 12) {
    case 0:
      pose.linear() = exp_rotation({0, 0, 6.3 * stream.uniform()});
      break;
    case 1:
      pose.linear() = exp_rotation({0, 0, std::numbers::pi / 2});
      break;
    case 2:
      pose.translation().x() = 1e7 * edge_m * (stream.uniform() - 0.5);
      break;
    case 3:
      pose.translation().y() = 600000 * edge_m;
      break;
    case 4:
      pose.translation().z() = std::numeric_limits<double>::infinity();
      break;
    case 5:
      pose.linear() *= stream.uniform() < 0.5 ? 30.0 : 0.0;
      break;
    case 6:
      pose.linear() = exp_rotation({0.3, -0.2, 0.1});
      break;
    default:
      break;
  }
  return pose;
}

TEST(ManyDraws, OfHostilePointsAtHostilePosesAreThePlainPasses) {
  RandomStream stream(15, "hostile");
  std::size_t hits = 0;
  for (int round = 0; round < 1500; ++round) {
    const double edge_m = round % 2 == 0 ? 0.05 : 0.0625;
    const Observation observation = lattice_points(stream, edge_m, round % 3 == 0);
    std::vector<Pose> poses;
    const bool tame = round % 5 < 2;
    for (int n = 0; n < std::array{1, 4, 7, 30}[static_cast<std::size_t>(round % 4)]; ++n) {
      poses.push_back(hostile_pose(stream, edge_m));
      if (tame) poses.back().linear().setIdentity();
    }
    const auto placed = place(observation, poses, edge_m);
    ASSERT_EQ(placed, testing::counted_place(observation, poses, edge_m)) << "round " << round;
    hits += placed.size();
  }
  EXPECT_GT(hits, 100000u);
}

TEST(ManyDraws, OfOnePointAreThePlainPasses) {
  RandomStream stream(16, "one point");
  for (int round = 0; round < 200; ++round) {
    const Observation observation{{3, 0.7, {{0.05 * (round % 5 - 2), 0.1, 0.6}}}, {1, 0.4, {}}};
    const auto poses = random_draws(stream, 1 + round % 40, 0.01 * (round % 3), 0.01);
    EXPECT_EQ(place(observation, poses, 0.05), testing::plain_place(observation, poses, 0.05));
  }
}

TEST(ManyDraws, NothingSeenGivesNothing) {
  const std::vector<Pose> draws(5, Pose::Identity());
  EXPECT_TRUE(place({}, draws, 0.05).empty());
  EXPECT_TRUE(place({{1, 1.0, {}}}, draws, 0.05).empty());
  EXPECT_TRUE(place({{1, 1.0, {{0, 0, 1}}}}, {}, 0.05).empty()) << "no draws";
}

}  // namespace
}  // namespace mapscore
