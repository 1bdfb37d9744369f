// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#include "eval/localization/believed_trajectory.hpp"

#include "core/error.hpp"
#include "eval/localization/odometry_run.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace mapscore::eval {
namespace {

std::vector<OdometryPose> straight() {
  return {{1.0, Pose::Identity()}, {1.5, planar_pose(1.0, 0, 0)}, {2.0, planar_pose(2.0, 0, 0.4)}};
}

TEST(BelievedTrajectory, MovesWithTheOdometryFromTheLatestEntry) {
  BelievedTrajectory believed{{}, straight()};
  const Covariance6 small = 0.01 * Covariance6::Identity(), large = 4.0 * small;
  believed.entries = {{1.0, {planar_pose(5, 0, 0), Pose::Identity(), small}},
                      {1.7, {planar_pose(7, 1, 0), Pose::Identity(), large}}};
  const PoseBelief before = believed.at(1.6999), after = believed.at(1.7);
  EXPECT_NEAR(before.T_odom_base.translation().x(), 1.3998, 1e-12);
  EXPECT_NEAR(planar(after.T_odom_base).yaw_rad, 0.16, 1e-12);
  EXPECT_EQ(before.T_map_odom.translation().x(), 5.0);
  EXPECT_EQ(after.T_map_odom.translation().x(), 7.0);
  EXPECT_EQ(before.covariance, small);
  EXPECT_EQ(after.covariance, large);
  EXPECT_EQ(believed.at(1.5).T_odom_base.matrix(), believed.odometry[1].T_odom_base.matrix());
}

TEST(BelievedTrajectory, ReachesOneSpacingBeyondItsEnds) {
  const BelievedTrajectory believed{{{1.0, {}}}, straight()};
  EXPECT_EQ(believed.at(0.5).T_odom_base.translation().x(), 0.0);
  EXPECT_EQ(believed.at(2.5).T_odom_base.translation().x(), 2.0);
  EXPECT_THROW((void)believed.at(0.4999), Error);
  EXPECT_THROW((void)believed.at(2.5001), Error);
  EXPECT_THROW((void)believed.at(NAN), Error);
  EXPECT_THROW((void)odometry_at({}, 0.0), Error);
}

TEST(OdometryRun, KeepsItsStartAndGrowsUncertain) {
  std::vector<OdometryPose> odometry;
  for (int n = 0; n <= 160; ++n) odometry.push_back({0.05 * n, planar_pose(0.03 * n, 0, 0)});
  OdometryNoise noise;
  noise.alpha1 = noise.alpha4 = 0.0;
  noise.alpha2 = 0.01;
  noise.alpha3 = 0.04;
  const PlanarPose start{2.0, 3.0, M_PI / 2};
  const BelievedTrajectory believed = odometry_only(odometry, start, noise);
  const PoseEstimate end = planar_estimate(believed.at(8.0));
  EXPECT_NEAR(end.mean.x_m, 2.0, 1e-12);
  EXPECT_NEAR(end.mean.y_m, 7.8, 1e-12);
  // 80 independent steps of 6 cm, the first length of 5 cm or more: variances add; those of rot1
  // and rot2 to the heading.
  EXPECT_NEAR(end.covariance(0, 0), 80 * 0.04 * 0.06 * 0.06, 1e-9);
  EXPECT_NEAR(end.covariance(2, 2), 80 * 2 * 0.01 * 0.06 * 0.06, 1e-9);
  // Each turn swings the rest of the way: sum over steps of (rest of the way)^2.
  double swing = 0.0;
  for (int k = 1; k <= 80; ++k)
    swing += 0.01 * 0.06 * 0.06 * 0.06 * 0.06 * ((k - 1) * (k - 1) + k * k);
  EXPECT_NEAR(end.covariance(1, 1), swing, 1e-9);
  EXPECT_EQ(planar_estimate(believed.at(0.0)).covariance, Eigen::Matrix3d::Zero());
}

}  // namespace
}  // namespace mapscore::eval
