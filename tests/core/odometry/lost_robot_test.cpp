// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#include "core/odometry/visual_odometry.hpp"
#include "tests/core/odometry/flat_depth.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

namespace mapscore {
namespace {

using testing::BoxFlat;
using testing::furnished_room;

TEST(LostRobot, ACameraSetDownElsewhereOnTheSameFloorSaysSo) {
  // As high and as steep as before: its floor lies where the floor lay.
  const Calibration camera = testing::odometry_camera();
  VisualOdometryParams free;
  free.wheeled = false;
  VisualOdometry visual(free, camera, planar_pose(2.0, 1.5, 0.2));
  const auto seen = [&](int n, const Pose& pose) {
    return visual.add({0.1 * n, testing::flat_depth(furnished_room(), pose, camera), {}});
  };
  for (int n = 0; n < 10; ++n)
    EXPECT_NE(seen(n, planar_pose(2.0 + 0.02 * n, 1.5, 0.2)).tracking, Tracking::lost) << n;
  const OdometryStep step = seen(10, planar_pose(3.6, 3.4, 2.7));
  EXPECT_EQ(step.tracking, Tracking::lost);
  EXPECT_GT(std::sqrt(step.covariance(0, 0)), 0.4);
}

TEST(LostRobot, ARobotSetDownElsewhereWithItsWheelsAtRestSaysSo) {
  const Calibration camera = testing::odometry_camera();
  for (const Pose& elsewhere : {planar_pose(3.6, 3.4, 2.7), planar_pose(4.0, 2.5, -2.0),
                                planar_pose(2.0, 3.0, 1.7), planar_pose(3.0, 2.0, 3.0)}) {
    VisualOdometry visual({}, camera, planar_pose(2.0, 1.5, 0.2));
    OdometryStep step;
    for (int n = 0; n < 11; ++n) {
      const Pose pose = n < 10 ? planar_pose(2.0, 1.5, 0.2) : elsewhere;
      step = visual.add(
          {0.1 * n, testing::flat_depth(furnished_room(), pose, camera), Pose::Identity()});
    }
    EXPECT_EQ(step.tracking, Tracking::lost) << elsewhere.translation().transpose();
    EXPECT_GT(std::sqrt(step.covariance(0, 0)), 0.4);
  }
}

/// Bare floor, and a row of boxes 2 m ahead of (15, 15).
BoxFlat hall_with_boxes() {
  BoxFlat flat(30.0, 30.0);
  for (const double y : {12.5, 14.5, 16.5}) flat.add(17.0, y, 0, 17.5, y + 1.0, 1.0);
  return flat;
}

TEST(LostRobot, CarriedToBareFloorItSaysSoAtOnce) {
  // Nothing upright is in sight there, and any floor fits any other: but the boxes are gone.
  const Calibration camera = testing::odometry_camera();
  VisualOdometry visual({}, camera, planar_pose(15.0, 15.0, 0.0));
  OdometryStep step;
  for (int n = 0; n < 11; ++n)
    step = visual.add({0.1 * n,
                       testing::flat_depth(hall_with_boxes(),
                                           planar_pose(15.0, n < 10 ? 15.0 : 22.0, 0.0), camera),
                       Pose::Identity()});
  EXPECT_EQ(step.tracking, Tracking::lost);
  EXPECT_GT(std::sqrt(step.covariance(0, 0)), 0.4);
}

/// A robot turns away from a row of boxes to bare floor, is put `carried_m` back there, and turns
/// to the boxes again; its wheels feel the turns alone.
std::vector<OdometryStep> turned_away_and_back(double carried_m) {
  const Calibration camera = testing::odometry_camera();
  VisualOdometry visual({}, camera, planar_pose(15.0, 15.0, 0.0));
  std::vector<OdometryStep> steps;
  for (int n = 0; n < 80; ++n) {
    const double yaw = std::numbers::pi * std::min({n / 35.0, 1.0, (79 - n) / 35.0});
    const Pose pose = planar_pose(n < 40 ? 15.0 : 15.0 - carried_m, 15.0, yaw);
    steps.push_back(visual.add({0.1 * n, testing::flat_depth(hall_with_boxes(), pose, camera),
                                planar_pose(0.0, 0.0, yaw)}));
  }
  return steps;
}

TEST(LostRobot, CarriedAwayBeforeBareFloorItSaysSoWhenItSeesThroughWhatItKnows) {
  const auto is_restarted = [](const OdometryStep& step) {
    return step.tracking == Tracking::restarted;
  };
  const std::vector<OdometryStep> left = turned_away_and_back(0.0);
  EXPECT_TRUE(std::ranges::none_of(left, is_restarted));
  const std::vector<OdometryStep> carried = turned_away_and_back(0.8);
  EXPECT_EQ(carried[40].tracking, Tracking::tracked);
  EXPECT_TRUE(std::ranges::any_of(carried, is_restarted));
  EXPECT_GT(std::sqrt(carried.back().covariance(0, 0)), 0.4);
}

TEST(LostRobot, OneWrongImageDoesNotUnsettleARobotThatIsWhereItBelieves) {
  const BoxFlat hall(3.0, 200.0), elsewhere = furnished_room();
  const Calibration camera = testing::odometry_camera();
  VisualOdometry visual({}, camera, planar_pose(1.5, 100.0, 0.0));
  std::vector<OdometryStep> steps;
  for (int n = 0; n < 20; ++n) {
    const Pose way = planar_pose(0.0, 0.06 * n, 0.0), pose = planar_pose(1.5, 100.0, 0.0) * way;
    const cv::Mat1w depth = n == 15
                                ? testing::flat_depth(elsewhere, planar_pose(2.0, 2.0, 0.6), camera)
                                : testing::flat_depth(hall, pose, camera);
    steps.push_back(visual.add({0.1 * n, depth, way}));
  }
  EXPECT_EQ(steps[15].tracking, Tracking::lost);
  EXPECT_GT(std::sqrt(steps[15].covariance(0, 0)), 0.4) << "it may have been carried away";
  EXPECT_EQ(steps[16].tracking, Tracking::tracked);
  // The wall says nothing of the way along it: there, too, it is where it was, as it was.
  EXPECT_LT(std::sqrt(steps[16].covariance(1, 1)), 1.5 * std::sqrt(steps[14].covariance(1, 1)));
}

}  // namespace
}  // namespace mapscore
