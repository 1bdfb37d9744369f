// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#include "sim/robot/waypoint_controller.hpp"

#include "core/error.hpp"
#include "sim/recorder/recorded_drive.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace mapscore::sim {
namespace {

constexpr double kStepS = 0.02;

/// A robot that does as it is told.
void move(const VelocityCommand& command, PlanarPose& robot) {
  robot.yaw_rad += command.omega_radps * kStepS;
  robot.x_m += command.v_mps * std::cos(robot.yaw_rad) * kStepS;
  robot.y_m += command.v_mps * std::sin(robot.yaw_rad) * kStepS;
}

TEST(WaypointController, KeepsItsLimitsAndReachesItsWaypoints) {
  const ControllerParams params;
  const std::vector<Drive::Waypoint> waypoints = {
      {0, 0, 0}, {1, 1, -3.0}, {1, 1, 1.0}, {-1, 0.5, 2}};
  WaypointController controller(waypoints, params);
  PlanarPose robot;
  VelocityCommand last;
  int steps = 0;
  while (!controller.done()) {
    const std::size_t target = controller.target();
    const VelocityCommand command = controller.command(robot, kStepS);
    EXPECT_LE(std::abs(command.v_mps), params.speed_mps + 1e-12);
    EXPECT_LE(std::abs(command.omega_radps), params.turn_rate_radps + 1e-12);
    EXPECT_LE(std::abs(command.v_mps - last.v_mps), params.acceleration_mps2 * kStepS + 1e-12);
    EXPECT_LE(std::abs(command.omega_radps - last.omega_radps),
              params.turn_acceleration_radps2 * kStepS + 1e-12);
    move(command, robot);
    last = command;
    if (controller.target() != target) {
      EXPECT_NEAR(robot.x_m, waypoints[target].x_m, 0.005);
      EXPECT_NEAR(robot.y_m, waypoints[target].y_m, 0.005);
      EXPECT_NEAR(std::remainder(robot.yaw_rad - waypoints[target].yaw_rad, 2 * M_PI), 0.0, 0.005);
    }
    ASSERT_LT(++steps, 5000);
  }
}

TEST(WaypointController, SteersBackToTheLegWhenPushedOff) {
  WaypointController controller({{0, 0, 0}, {4, 0, 0}}, {});
  PlanarPose robot;
  double offset_m = 0.0;
  for (int step = 0; robot.x_m < 3.0; ++step) {
    ASSERT_LT(step, 2000);
    move(controller.command(robot, kStepS), robot);
    if (step == 100) robot.y_m += 0.15;
    offset_m = robot.y_m;
  }
  EXPECT_NEAR(offset_m, 0.0, 0.005);
}

TEST(WaypointController, SetsOutAnewWhenFarOffAtTheEnd) {
  WaypointController controller({{0, 0, 0}, {1, 0, 0}}, {});
  PlanarPose robot;
  bool pushed = false;
  for (int step = 0; !controller.done(); ++step) {
    ASSERT_LT(step, 5000);
    move(controller.command(robot, kStepS), robot);
    if (!pushed && robot.x_m > 0.9) {
      robot.y_m += 0.5;
      pushed = true;
    }
  }
  EXPECT_TRUE(pushed);
  EXPECT_NEAR(std::hypot(robot.x_m - 1.0, robot.y_m), 0.0, 0.04);
}

TEST(WaypointController, OneWaypointIsReachedAtOnce) {
  EXPECT_TRUE(WaypointController({{1, 2, 3}}, {}).done());
}

TEST(WaypointController, RefusesLimitsThatAreNotPositive) {
  ControllerParams params;
  params.acceleration_mps2 = 0.0;
  EXPECT_THROW(WaypointController({{0, 0, 0}}, params), Error);
}

}  // namespace
}  // namespace mapscore::sim
