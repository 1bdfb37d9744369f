// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#include "sim/robot/drive_simulation.hpp"
#include "tests/sim/robot/drive_scenes.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <cstddef>
#include <string>
#include <vector>

namespace mapscore::sim::testing {
namespace {

constexpr std::size_t kSpan = 5;  ///< samples: 0.1 s
constexpr double kSpanS = 0.1;

double yaw_of(const Pose& T_from_base) {
  return std::atan2(T_from_base.linear()(1, 0), T_from_base.linear()(0, 0));
}

/// Speed ahead and turn rate of a pose over spans of 0.1 s.
struct Rates {
  std::vector<double> ahead_mps, turn_radps;
};

Rates rates_of(const DriveLog& log, const Pose DriveSample::*pose) {
  Rates rates;
  for (std::size_t n = kSpan; n < log.samples.size(); ++n) {
    const Pose moved = (log.samples[n - kSpan].*pose).inverse() * (log.samples[n].*pose);
    rates.ahead_mps.push_back(moved.translation().x() / kSpanS);
    rates.turn_radps.push_back(yaw_of(moved) / kSpanS);
  }
  return rates;
}

/// By how long the wheels' rate lags behind the base's: least squares of base - wheels on the
/// acceleration of the wheels. A constant share of slip does not count.
double lag_s(const std::vector<double>& wheels, const std::vector<double>& base) {
  double product = 0.0, square = 0.0;
  for (std::size_t n = kSpan; n + kSpan < wheels.size(); ++n) {
    const double acceleration = (wheels[n + kSpan] - wheels[n - kSpan]) / (2.0 * kSpanS);
    product += acceleration * (base[n] - wheels[n]);
    square += acceleration * acceleration;
  }
  return product / square;
}

// The wheels drive the base: it cannot be ahead of them when they speed up, nor behind when they
// brake, but for the tread's creep under the driving force.
TEST(WheelLag, TheBaseGoesWhereTheWheelsTakeIt) {
  const World world = floor_world();
  const DriveLog straight =
      simulate_drive(world, robot_file(), drive_along({{0, 0, 0}, {1, 0, 0}, {2, 0, 0}}));
  const DriveLog turn = simulate_drive(world, robot_file(), drive_along({{0, 0, 0}, {0, 0, 3.0}}));
  const double ahead_s = lag_s(rates_of(straight, &DriveSample::T_odom_base).ahead_mps,
                               rates_of(straight, &DriveSample::T_world_base).ahead_mps);
  const double turn_s = lag_s(rates_of(turn, &DriveSample::T_odom_base).turn_radps,
                              rates_of(turn, &DriveSample::T_world_base).turn_radps);
  EXPECT_NEAR(ahead_s, 0.0, 0.005);
  EXPECT_NEAR(turn_s, 0.0, 0.005);
  RecordProperty("lag_ms", std::to_string(1000.0 * ahead_s));
  RecordProperty("turn_lag_ms", std::to_string(1000.0 * turn_s));
}

}  // namespace
}  // namespace mapscore::sim::testing
