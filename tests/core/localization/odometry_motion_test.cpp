// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#include "core/localization/odometry_motion.hpp"

#include "core/error.hpp"
#include "core/geometry/pose.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace mapscore {
namespace {

void expect_same(const PlanarPose& a, const PlanarPose& b) {
  EXPECT_NEAR(a.x_m, b.x_m, 1e-12);
  EXPECT_NEAR(a.y_m, b.y_m, 1e-12);
  EXPECT_NEAR(wrapped_angle(a.yaw_rad - b.yaw_rad), 0.0, 1e-12);
}

TEST(PlanarPose, AgreesWithPosesInSpace) {
  RandomStream stream(1, "poses");
  for (int n = 0; n < 200; ++n) {
    const PlanarPose a{stream.normal(), stream.normal(), 3.1 * (2 * stream.uniform() - 1)};
    const PlanarPose b{stream.normal(), stream.normal(), n == 0 ? 1e-7 : stream.normal()};
    EXPECT_TRUE(spatial(a * b).isApprox(spatial(a) * spatial(b), 1e-12));
    expect_same(planar(spatial(a)), a);
    expect_same(inverse(a) * a, {});
    const Vector6 xi = log_pose(spatial(a));
    EXPECT_TRUE(log_planar(a).isApprox(Eigen::Vector3d(xi[0], xi[1], xi[5]), 1e-9));
    const PlanarPose small{1e-6 * b.x_m, 1e-6 * b.y_m, 1e-6 * b.yaw_rad};
    EXPECT_TRUE(log_planar(a * small * inverse(a)).isApprox(adjoint(a) * log_planar(small), 1e-5));
  }
}

TEST(OdometryMotion, PartsComposeToTheMotion) {
  RandomStream stream(2, "motions");
  for (int n = 0; n < 200; ++n) {
    const PlanarPose motion{stream.normal(), stream.normal(), 3 * (2 * stream.uniform() - 1)};
    const OdometryMotion parts = motion_parts(motion, 0.005);
    expect_same(motion_pose(parts), motion);
    EXPECT_LE(std::abs(parts.rot1_rad), 0.5 * std::numbers::pi + 1e-12);
  }
}

TEST(OdometryMotion, BackwardsIsNoTurn) {
  const OdometryMotion parts = motion_parts({-0.2, 0.001, 0.0}, 0.005);
  EXPECT_LT(parts.trans_m, 0.0);
  EXPECT_NEAR(parts.rot1_rad, -0.005, 1e-6);
  EXPECT_NEAR(parts.rot2_rad, 0.005, 1e-6);
}

TEST(OdometryMotion, TurnOnTheSpotIgnoresTheJitterOfItsWay) {
  const OdometryMotion parts = motion_parts({0.0001, -0.0012, 0.3}, 0.005);
  EXPECT_EQ(parts.rot1_rad, 0.0);
  EXPECT_DOUBLE_EQ(parts.rot2_rad, 0.3);
  const MotionSigmas sigmas = motion_sigmas(parts, {0.04, 0.0, 0.0, 0.01, 0.005});
  EXPECT_DOUBLE_EQ(sigmas.rot1_rad, 0.0);
  EXPECT_DOUBLE_EQ(sigmas.rot2_rad, 0.2 * 0.3);
  EXPECT_DOUBLE_EQ(sigmas.trans_m, 0.1 * 0.3);
}

TEST(OdometryMotion, StandingStillAddsNothing) {
  RandomStream stream(3, "still");
  const OdometryMotion parts = motion_parts({}, 0.005);
  const PlanarPose drawn = sample_motion(parts, motion_sigmas(parts, {}), stream);
  EXPECT_EQ(drawn, PlanarPose{});
}

TEST(OdometryMotion, DrawsHaveTheStatedCovariance) {
  const PlanarPose motion{0.30, -0.12, 0.5};
  const OdometryMotion parts = motion_parts(motion, 0.005);
  const MotionSigmas sigmas = motion_sigmas(parts, {0.01, 0.004, 0.01, 0.001, 0.005});
  RandomStream stream(4, "draws");
  Eigen::Matrix3d sampled = Eigen::Matrix3d::Zero();
  constexpr int kDraws = 100000;
  for (int n = 0; n < kDraws; ++n) {
    const Eigen::Vector3d xi = log_planar(inverse(motion) * sample_motion(parts, sigmas, stream));
    sampled += xi * xi.transpose() / kDraws;
  }
  const Eigen::Matrix3d stated = motion_covariance(parts, sigmas);
  for (int row = 0; row < 3; ++row)
    for (int column = 0; column < 3; ++column)
      EXPECT_NEAR(sampled(row, column), stated(row, column),
                  0.03 * std::sqrt(stated(row, row) * stated(column, column)));
}

TEST(OdometryMotion, RefusesNegativeAlphas) {
  EXPECT_THROW(static_cast<void>(motion_sigmas({}, {-0.1, 0, 0, 0, 0})), Error);
  EXPECT_THROW(static_cast<void>(motion_sigmas({}, {0, 0, 0, NAN, 0})), Error);
}

}  // namespace
}  // namespace mapscore
