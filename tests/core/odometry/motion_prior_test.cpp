// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#include "core/odometry/motion_prior.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace mapscore {
namespace {

constexpr double kRadPerDeg = std::numbers::pi / 180.0;

LastStep ahead(double way_m, double duration_s) {
  return {spatial({way_m, 0.0, 0.0}), duration_s};
}

TEST(MotionPrior, ARobotGoesOnAsItWent) {
  const MotionPrior motion = robot_motion(ahead(0.04, 0.1), 0.2);
  EXPECT_NEAR(motion.T_before_after.translation().x(), 0.08, 1e-12);
  EXPECT_NEAR(std::sqrt(motion.noise(0, 0)), 0.5 * 0.02 + 0.001, 1e-12);
  EXPECT_NEAR(std::sqrt(motion.noise(5, 5)), (85.0 * 0.02 + 0.1) * kRadPerDeg, 1e-12);
  // Images that stop for an hour: it has not gone on all the while, but may be anywhere.
  const MotionPrior later = robot_motion(ahead(0.04, 0.1), 3600.0);
  EXPECT_NEAR(later.T_before_after.translation().x(), 0.8, 1e-12);
  EXPECT_GT(std::sqrt(later.noise(0, 0)), 1e6);
}

TEST(MotionPrior, WithoutAStepBeforeNothingMoves) {
  EXPECT_TRUE(robot_motion({}, 0.1).T_before_after.isApprox(Pose::Identity()));
  EXPECT_TRUE(hand_motion({}, 0.1).T_before_after.isApprox(Pose::Identity()));
}

TEST(MotionPrior, ACameraInAHandForgetsItsSpeed) {
  const MotionPrior soon = hand_motion(ahead(0.04, 0.1), 0.1);
  const double kept = 1.0 - std::exp(-1.0);
  EXPECT_NEAR(soon.T_before_after.translation().x(), 0.04 * kept, 1e-12);
  // It may as well have kept it: that is one more standard deviation, along the motion alone.
  EXPECT_NEAR(soon.noise(0, 0) - soon.noise(1, 1), std::pow(0.04 * (1.0 - kept), 2), 1e-12);
  // After however long, no farther than the speed times the memory.
  EXPECT_NEAR(hand_motion(ahead(0.04, 0.1), 60.0).T_before_after.translation().x(), 0.04, 1e-12);
}

TEST(MotionPrior, WheelsSayNothingOfHeightAndTilt) {
  const MotionPrior motion = wheel_motion(Pose::Identity(), {});
  EXPECT_NEAR(std::sqrt(motion.noise(2, 2)), 0.005, 1e-12);
  EXPECT_NEAR(std::sqrt(motion.noise(3, 3)), 0.5 * kRadPerDeg, 1e-12);
  EXPECT_GT(wheel_motion(spatial({0.1, 0.0, 0.0}), {}).noise(0, 0), motion.noise(0, 0));
}

TEST(MotionPrior, OnTheFloorHeightIsWeighedByVariances) {
  PosePrior prior{Pose(Eigen::Translation3d(1.0, 2.0, 0.02)), sigmas6(0.1, 0.01, kRadPerDeg, 0.1)};
  const PosePrior level = on_floor(prior);
  EXPECT_NEAR(level.mean.translation().z(), 0.01, 1e-9);  // two equal variances: the mean of both
  EXPECT_NEAR(level.covariance(2, 2), 0.5e-4, 1e-12);
  EXPECT_EQ(level.covariance(0, 0), prior.covariance(0, 0));
  EXPECT_TRUE(level.on_floor);
}

}  // namespace
}  // namespace mapscore
