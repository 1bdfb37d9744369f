// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#include "sim/robot/odometry.hpp"

#include "core/error.hpp"
#include "core/localization/planar_pose.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace mapscore::sim {
namespace {

TEST(Odometry, TicksRoundDown) {
  EXPECT_EQ(ticks_of(0.0, 4096), 0);
  EXPECT_EQ(ticks_of(2.0 * M_PI + 1e-9, 4096), 4096);
  EXPECT_EQ(ticks_of(-1e-9, 4096), -1);
  EXPECT_EQ(ticks_of(2.0 * M_PI * 0.99 / 8.0, 8), 0);
}

TEST(Odometry, StraightIsCircumferenceTimesTurns) {
  Odometry odometry({0.1, 0.4}, 1000);
  odometry.update({1000, 1000});
  odometry.update({1500, 1500});
  EXPECT_NEAR(odometry.T_odom_base().translation().x(), 1.5 * 2.0 * M_PI * 0.1, 1e-12);
  EXPECT_EQ(odometry.T_odom_base().translation().y(), 0.0);
}

// One update over a quarter circle must land where many small ones do: the arc is exact.
TEST(Odometry, AnArcInOneStepEqualsManySteps) {
  const WheelGeometry wheels{0.1, 0.4};
  Odometry once(wheels, 1 << 20), often(wheels, 1 << 20);
  const WheelTicks end{400000, 800000};
  once.update(end);
  for (int i = 1; i <= 1000; ++i) often.update({end.left * i / 1000, end.right * i / 1000});
  EXPECT_TRUE(once.T_odom_base().isApprox(often.T_odom_base(), 1e-9));
  const double turn = 0.1 * 2.0 * M_PI * 400000 / (1 << 20) / 0.4;
  const double radius = 0.4 * 1.5;  // of the middle: track / 2 (right + left) / (right - left)
  EXPECT_NEAR(planar(once.T_odom_base()).yaw_rad, turn, 1e-12);
  EXPECT_NEAR(once.T_odom_base().translation().x(), radius * std::sin(turn), 1e-12);
  EXPECT_NEAR(once.T_odom_base().translation().y(), radius * (1.0 - std::cos(turn)), 1e-12);
}

TEST(Odometry, RefusesWhatIsNotPositive) {
  EXPECT_THROW(Odometry({0.0, 0.4}, 4096), Error);
  EXPECT_THROW(Odometry({0.1, NAN}, 4096), Error);
  EXPECT_THROW(Odometry({0.1, 0.4}, 0), Error);
}

}  // namespace
}  // namespace mapscore::sim
