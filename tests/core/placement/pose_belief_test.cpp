// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#include "core/placement/pose_belief.hpp"

#include "tests/support/expect_error.hpp"

#include <gtest/gtest.h>

#include <Eigen/QR>
#include <algorithm>
#include <cmath>
#include <limits>

namespace mapscore {
namespace {

using mapscore::testing::expect_error;

/// Of the size of x y z (m), roll pitch yaw (rad).
Vector6 usual_sigmas() {
  Vector6 sigma;
  sigma << 0.1, 0.08, 0.01, 0.002, 0.003, 0.03;
  return sigma;
}

/// A covariance of so low a rank; y follows x but for a share `apart` of its own.
Covariance6 random_covariance(RandomStream& stream, int rank, double apart) {
  Eigen::MatrixXd root(6, rank);
  for (double& number : root.reshaped()) number = stream.normal();
  for (int column = 0; column < rank; ++column)
    root(1, column) = root(0, column) + apart * root(1, column);
  root = (usual_sigmas().asDiagonal() * root).eval();
  const Covariance6 product = root * root.transpose();
  return 0.5 * (product + product.transpose());
}

/// The greatest difference of entries, over the roots of the variances of both axes.
double relative_error(const Covariance6& found, const Covariance6& covariance) {
  const Vector6 sigma = covariance.diagonal().cwiseSqrt();
  return (found - covariance).cwiseQuotient(sigma * sigma.transpose()).cwiseAbs().maxCoeff();
}

TEST(CovarianceRoot, IsTriangularAndGivesTheCovarianceOfAnyRank) {
  RandomStream stream(1, "covariances");
  for (const double apart : {1.0, 0.01})
    for (int rank = 1; rank <= 6; ++rank)
      for (int n = 0; n < 300; ++n) {
        const Covariance6 covariance = random_covariance(stream, rank, apart);
        const Covariance6 root = covariance_root(covariance);
        EXPECT_LT(relative_error(root * root.transpose(), covariance), 1e-12) << rank;
        EXPECT_EQ(Covariance6(root.triangularView<Eigen::StrictlyUpper>()), Covariance6::Zero());
        EXPECT_GE(root.diagonal().minCoeff(), 0.0);
      }
}

TEST(CovarianceRoot, OfADiagonalIsItsSquareRootsBitForBit) {
  RandomStream stream(2, "diagonals");
  for (int n = 0; n < 1000; ++n) {
    Vector6 variances;
    for (double& variance : variances)
      variance = stream.uniform() < 0.3 ? 0.0 : std::pow(10.0, -12.0 * stream.uniform());
    const Covariance6 roots = variances.cwiseSqrt().asDiagonal();
    EXPECT_EQ(covariance_root(variances.asDiagonal()), roots);
  }
}

/// Where the greatest variance is another one, the root stays the same one.
TEST(CovarianceRoot, DoesNotJumpWhereTheOrderOfVariancesChanges) {
  Covariance6 less = usual_sigmas().cwiseAbs2().asDiagonal();
  less(0, 0) = 0.0064 * (1 - 1e-9);
  less(0, 1) = less(1, 0) = 0.003;
  less(1, 5) = less(5, 1) = 0.001;
  Covariance6 more = less;
  more(0, 0) = 0.0064 * (1 + 1e-9);
  EXPECT_LT((covariance_root(more) - covariance_root(less)).cwiseAbs().maxCoeff(), 1e-9);
}

TEST(CovarianceRoot, DrawsMoveLittleByALittleCorrelation) {
  PoseBelief plain, correlated;
  plain.covariance = correlated.covariance = usual_sigmas().cwiseAbs2().asDiagonal();
  for (int row = 0; row < 6; ++row)
    for (int column = 0; column < row; ++column)
      correlated.covariance(row, column) = correlated.covariance(column, row) = 1e-12;
  const Draws draws{100, NoiseAt::base, CovarianceUse::full};
  RandomStream stream(3, "draws"), same = stream;
  const auto poses = draw_poses(plain, draws, stream), moved = draw_poses(correlated, draws, same);
  for (std::size_t n = 0; n < poses.size(); ++n) {
    const double change = (poses[n].matrix() - moved[n].matrix()).cwiseAbs().maxCoeff();
    EXPECT_GT(change, 0.0);
    EXPECT_LT(change, 1e-7);  // 1e-12 over a sigma of 0.002, times a few normals
  }
}

TEST(CovarianceRoot, AnAxisThatOthersDetermineHasNoColumn) {
  // y is twice x, roll and pitch have no variance, yaw follows x by half.
  Covariance6 covariance = Covariance6::Zero(), root = Covariance6::Zero();
  root(0, 0) = 0.1;
  root(1, 0) = 0.2;
  root(2, 2) = 0.3;
  root(5, 0) = 0.01;
  root(5, 5) = 0.02;
  covariance = root * root.transpose();
  EXPECT_LT((covariance_root(covariance) - root).cwiseAbs().maxCoeff(), 1e-15);
  EXPECT_EQ(covariance_root(covariance).col(1), Vector6::Zero());
  EXPECT_EQ(covariance_root(covariance).col(3), Vector6::Zero());
}

TEST(CovarianceRoot, RefusesTheIndefinite) {
  const auto refused = [](const Covariance6& covariance) {
    expect_error("covariance: must be positive semi-definite; check its signs and correlations",
                 [&] { (void)covariance_root(covariance); });
  };
  RandomStream stream(4, "indefinite");
  for (int n = 0; n < 300; ++n) {
    Covariance6 numbers;
    for (double& number : numbers.reshaped()) number = stream.normal();
    const Covariance6 axes = Eigen::HouseholderQR<Covariance6>(numbers).householderQ();
    Vector6 eigenvalues;
    for (double& value : eigenvalues) value = 0.1 + stream.uniform();
    eigenvalues[n % 6] = -std::pow(10.0, -10.0 * stream.uniform());
    const Covariance6 E = axes * eigenvalues.asDiagonal() * axes.transpose();
    refused(0.5 * (E + E.transpose()));
  }
  Covariance6 one = Covariance6::Zero();
  one(2, 2) = -1e-4;
  refused(one);
  one.setZero();
  one(0, 5) = one(5, 0) = 1e-4;  // of axes without a variance
  refused(one);
  one.diagonal().setConstant(1e-4);
  one(0, 5) = one(5, 0) = 1.001e-4;
  refused(one);
}

}  // namespace
}  // namespace mapscore
