// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#include "eval/localization/localization_score.hpp"

#include "core/error.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

namespace mapscore::eval {
namespace {

/// Five frames at the truth (n, 0, 0); the belief is off by `off[n]`, with the sigma of each axis.
LocalizationScore score_of(const std::vector<PlanarPose>& off, const std::vector<double>& sigma) {
  BelievedTrajectory believed;
  std::vector<TrajectoryPose> truth;
  for (std::size_t n = 0; n < off.size(); ++n) {
    const auto at = static_cast<double>(n);
    truth.push_back({at, planar_pose(at, 0, 0)});
    believed.odometry.push_back({at, planar_pose(at + off[n].x_m, off[n].y_m, off[n].yaw_rad)});
    believed.entries.push_back({at, {}});
    believed.entries.back().belief.covariance.diagonal().setConstant(sigma[n] * sigma[n]);
  }
  return score_localization(believed, truth);
}

TEST(LocalizationScore, CountsFromConvergenceOn) {
  const double degree = std::numbers::pi / 180.0;
  const LocalizationScore score =
      score_of({{9, 0, 0}, {0.03, 0.04, 0}, {0.1, 0, -2 * degree}, {0, 0, 0}, {0, -0.2, 0}},
               {0.2, 0.1, 0.1, 0.1, 0.3});
  ASSERT_EQ(score.converged_s, 1.0);  // sqrt(2) 0.2 m is more than 0.2 m, sqrt(2) 0.1 m less
  EXPECT_EQ(std::ranges::count_if(score.frames, &FrameError::converged), 4);
  EXPECT_FALSE(score.frames[0].converged);
  EXPECT_TRUE(score.frames[4].converged);  // once is enough
  EXPECT_NEAR(score.position_m.mean, (0.05 + 0.1 + 0.0 + 0.2) / 4, 1e-12);
  EXPECT_NEAR(score.position_m.median, 0.075, 1e-12);
  EXPECT_NEAR(score.position_m.p95, 0.1 + 0.85 * 0.1, 1e-12);
  EXPECT_NEAR(score.position_m.max, 0.2, 1e-12);
  EXPECT_NEAR(score.heading_deg.mean, 0.5, 1e-9);
  EXPECT_NEAR(score.frames[1].nees.value(), 0.25, 1e-12);
  EXPECT_NEAR(score.frames[4].nees.value(), 4.0 / 9.0, 1e-12);
  EXPECT_EQ(score.nees_share, 0.75);  // the exact frame lies below the band
}

TEST(LocalizationScore, HeadingWrapsAndExactBeliefsHaveNoShare) {
  const double nearly = std::numbers::pi - 0.01;
  BelievedTrajectory believed{{{0.0, {}}}, {{0.0, planar_pose(0, 0, -nearly)}}};
  const LocalizationScore score = score_localization(believed, {{0.0, planar_pose(0, 0, nearly)}});
  EXPECT_NEAR(score.heading_deg.max, 0.02 * 180 / std::numbers::pi, 1e-9);
  EXPECT_FALSE(score.nees_share.has_value());
  EXPECT_THROW((void)score_localization(believed, {{0.1, Pose::Identity()}}), Error);
}

TEST(LocalizationScore, WhatNeverConvergesHasNoFigures) {
  const LocalizationScore score = score_of({{0, 0, 0}, {0, 0, 0}}, {1.0, 1.0});
  EXPECT_FALSE(score.converged_s.has_value());
  EXPECT_FALSE(score.nees_share.has_value());
  EXPECT_EQ(std::ranges::count_if(score.frames, &FrameError::converged), 0);
}

}  // namespace
}  // namespace mapscore::eval
