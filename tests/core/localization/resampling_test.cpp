// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#include "core/localization/resampling.hpp"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <limits>

namespace mapscore {
namespace {

TEST(LowVariance, EachParticleAsOftenAsItsWeightSays) {
  RandomStream stream(1, "weights");
  for (int trial = 0; trial < 100; ++trial) {
    std::vector<double> logs(1 + stream.bits() % 50);
    for (double& log_weight : logs) log_weight = 3.0 * stream.normal();
    const std::vector<double> weights = normalised_weights(logs);
    const std::size_t count = 1 + stream.bits() % 200;
    const auto picks = low_variance_picks(weights, count, stream.uniform());
    ASSERT_EQ(picks.size(), count);
    std::vector<double> times(weights.size(), 0.0);
    for (const std::size_t pick : picks) ++times[pick];
    for (std::size_t n = 0; n < weights.size(); ++n)
      EXPECT_LT(std::abs(times[n] - static_cast<double>(count) * weights[n]), 1.0 + 1e-9);
  }
}

TEST(LowVariance, ByHand) {
  const std::array<double, 3> weights = {0.5, 0.0, 0.5};
  EXPECT_EQ(low_variance_picks(weights, 4, 0.0), (std::vector<std::size_t>{0, 0, 2, 2}));
  EXPECT_EQ(low_variance_picks(weights, 1, 0.75), (std::vector<std::size_t>{2}));
}

TEST(Weights, SurviveExtremeLogarithms) {
  const double never = -std::numeric_limits<double>::infinity();
  const auto weights = normalised_weights(std::array<double, 4>{-5000.0, -5000.0, -9000.0, never});
  EXPECT_DOUBLE_EQ(weights[0], 0.5);
  EXPECT_EQ(weights[2], 0.0);
  EXPECT_EQ(weights[3], 0.0);
  EXPECT_DOUBLE_EQ(effective_sample_size(weights), 2.0);
}

TEST(Kld, BoundByHand) {
  KldParams params;
  params.min_particles = 1;
  params.epsilon = 0.05;
  params.z_quantile = 2.33;
  EXPECT_EQ(kld_bound(0, params), 1u);
  EXPECT_EQ(kld_bound(1, params), 1u);
  // 9/0.1 (1 - 2/81 + sqrt(2/81) 2.33)^3 = 90 * 1.341437^3 = 217.2...
  EXPECT_EQ(kld_bound(10, params), 218u);
  params.min_particles = 500;
  EXPECT_EQ(kld_bound(10, params), 500u);
  EXPECT_EQ(kld_bound(1000000, params), params.max_particles);
}

TEST(Kld, BoundIsTheChiSquareQuantile) {
  KldParams params;
  params.min_particles = 1;
  // 0.99 quantiles of chi-square with 9 and 99 degrees of freedom; Wilson-Hilferty is that close.
  EXPECT_NEAR(static_cast<double>(kld_bound(10, params)), 21.666 / 0.1, 2.0);
  EXPECT_NEAR(static_cast<double>(kld_bound(100, params)), 134.642 / 0.1, 5.0);
}

TEST(Kld, ParticlesFollowTheSpread) {
  RandomStream poses_stream(2, "spread"), stream(3, "kld");
  std::vector<PlanarPose> narrow(4000), wide(4000);
  for (PlanarPose& pose : narrow) pose = {0.03 + 0.01 * poses_stream.normal(), 0.05, 0.04};
  for (PlanarPose& pose : wide)
    pose = {5 * poses_stream.normal(), 5 * poses_stream.normal(), poses_stream.normal()};
  const std::vector<double> weights(4000, 1.0 / 4000);
  const KldParams params;
  EXPECT_EQ(kld_particles(narrow, weights, params, stream), params.min_particles);
  EXPECT_EQ(kld_particles(wide, weights, params, stream), params.max_particles);
  std::vector<double> lone(4000, 0.0);
  lone[17] = 1.0;  // only what has weight counts
  EXPECT_EQ(kld_particles(wide, lone, params, stream), params.min_particles);
}

}  // namespace
}  // namespace mapscore
