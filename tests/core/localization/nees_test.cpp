// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#include "core/localization/nees.hpp"

#include "core/random_stream.hpp"

#include <gtest/gtest.h>

#include <Eigen/LU>
#include <cmath>
#include <numbers>

namespace mapscore {
namespace {

/// A regular covariance with axes of all sizes.
Covariance6 some_covariance() {
  RandomStream stream(3, "covariance");
  Covariance6 root = Covariance6::Zero();
  for (int row = 0; row < 6; ++row)
    for (int column = 0; column <= row; ++column)
      root(row, column) = (row < 3 ? 0.05 : 0.002) * stream.normal();
  root.diagonal().array() += 0.01;
  return root * root.transpose();
}

TEST(Nees, IsTheSquareOfWhatASigmaIsOff) {
  const Eigen::Vector3d xi(0.2, -0.1, 0.3);
  EXPECT_NEAR(nees<3>(xi, Eigen::Vector3d(0.04, 0.01, 0.09).asDiagonal().toDenseMatrix()), 3.0,
              1e-12);
  Eigen::Matrix2d correlated;
  correlated << 2, 1, 1, 2;  // inverse [2 -1; -1 2] / 3
  EXPECT_NEAR(nees<2>(Eigen::Vector2d(1, 3), correlated), 14.0 / 3.0, 1e-12);
}

TEST(Nees, IsThatOfTheInverse) {
  const Covariance6 covariance = some_covariance();
  Vector6 xi;
  xi << 0.1, -0.05, 0.02, 0.01, -0.02, 0.03;
  EXPECT_NEAR(nees<6>(xi, covariance) / xi.dot(covariance.inverse() * xi), 1.0, 1e-9);
}

TEST(Nees, DoesNotDependOnTheUnitOfAnAxis) {
  const Covariance6 covariance = some_covariance();
  Vector6 xi, scale;
  xi << 0.1, -0.05, 0.02, 0.01, -0.02, 0.03;
  scale << 1e3, 1, 1e-6, 1, 1e6, 1;
  const Covariance6 scaled = scale.asDiagonal() * covariance * scale.asDiagonal();
  EXPECT_NEAR(nees<6>(scale.cwiseProduct(xi), scaled) / nees<6>(xi, covariance), 1.0, 1e-9);
}

TEST(Nees, OfSmallVariancesIsFinite) {
  const Eigen::Matrix3d tiny = Eigen::Vector3d(1e-14, 1e-2, 1e-10).asDiagonal();
  EXPECT_NEAR(nees<3>(Eigen::Vector3d(1e-7, 0.1, 1e-5), tiny), 3.0, 1e-9);
}

TEST(Nees, OfASingularCovarianceIsInfinite) {
  Eigen::Matrix3d covariance = Eigen::Matrix3d::Identity();
  covariance(2, 2) = 0.0;
  EXPECT_TRUE(std::isinf(nees<3>(Eigen::Vector3d::Zero(), covariance)));
  covariance = Eigen::Matrix3d::Ones();  // one axis is all that is unknown
  EXPECT_TRUE(std::isinf(nees<3>(Eigen::Vector3d(1, 1, 1), covariance)));
  covariance(0, 0) += 1e-14;
  EXPECT_TRUE(std::isinf(nees<3>(Eigen::Vector3d(1, 1, 1), covariance)));
  covariance = -Eigen::Matrix3d::Identity();
  EXPECT_TRUE(std::isinf(nees<3>(Eigen::Vector3d(1, 1, 1), covariance)));
}

TEST(Nees, OfHonestBeliefsInSpaceLiesInTheBandOfSix) {
  const Covariance6 covariance = some_covariance();
  const Covariance6 root = covariance_root(covariance);
  PoseBelief belief;
  belief.T_map_odom = planar_pose(1, 2, 0.7);
  belief.T_odom_base = exp_pose((Vector6() << 3, -1, 0.5, 0.2, -0.4, 1.1).finished());
  belief.covariance = covariance;
  RandomStream stream(8, "nees of six");
  constexpr int kDraws = 20000;
  int low = 0, high = 0;
  double sum = 0.0;
  for (int n = 0; n < kDraws; ++n) {
    Vector6 drawn;
    for (double& axis : drawn) axis = stream.normal();
    const double squared =
        nees(belief, belief.T_map_odom * belief.T_odom_base * exp_pose(root * drawn));
    sum += squared;
    low += squared < kNeesBand6.low;
    high += squared > kNeesBand6.high;
  }
  EXPECT_NEAR(sum / kDraws, 6.0, 0.1);
  EXPECT_NEAR(low, 0.025 * kDraws, 70);
  EXPECT_NEAR(high, 0.025 * kDraws, 70);
}

TEST(Nees, SpeaksOfSpaceWhereAllSixAxesHaveAVariance) {
  PoseBelief belief;
  belief.covariance = spatial_covariance(Eigen::Matrix3d::Identity());
  EXPECT_FALSE(is_spatial(belief));
  belief.covariance = Covariance6::Identity();
  EXPECT_TRUE(is_spatial(belief));
  belief.covariance(2, 2) = 0.0;
  EXPECT_FALSE(is_spatial(belief));
}

TEST(LogPose, IsTheInverseOfTheExponential) {
  RandomStream stream(5, "log");
  for (const double size : {1e-9, 1e-4, 0.1, 0.5}) {
    Vector6 xi;
    for (double& axis : xi) axis = size * stream.normal();
    EXPECT_LT((log_pose(exp_pose(xi)) - xi).norm(), 1e-9 * size) << size;
  }
  EXPECT_TRUE(log_pose(Pose::Identity()).isZero(0.0));
  const Pose turned = planar_pose(1, 0, 0.5 * std::numbers::pi);
  EXPECT_NEAR(log_pose(turned)[5], 0.5 * std::numbers::pi, 1e-12);
  EXPECT_LT((log_pose(turned).head<2>() - log_planar(planar(turned)).head<2>()).norm(), 1e-12);
}

}  // namespace
}  // namespace mapscore
