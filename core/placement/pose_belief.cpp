// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#include "core/placement/pose_belief.hpp"

#include "core/error.hpp"

#include <cmath>

namespace mapscore {
namespace {

/// Share of an axis's variance that counts as none.
constexpr double kNoShare = 1e-14;
/// An entry above this, of the variances, that a root leaves of a covariance makes it indefinite.
constexpr double kIndefinite = 1e-12;

/// Any root, not triangular: Cholesky's columns of the axis with the greatest share left of its
/// variance, so that rounding does no harm where the covariance is singular or nearly so.
Covariance6 pivoted_root(const Covariance6& covariance) {
  const double scale = covariance.cwiseAbs().maxCoeff();
  if (scale == 0.0) return Covariance6::Zero();
  const Vector6 variance = covariance.diagonal().cwiseMax(kIndefinite * scale);
  Covariance6 left = covariance.selfadjointView<Eigen::Lower>(), root = Covariance6::Zero();
  for (int column = 0; column < 6; ++column) {
    int axis = 0;
    if (left.diagonal().cwiseQuotient(variance).maxCoeff(&axis) <= kNoShare) break;
    root.col(column) = left.col(axis) / std::sqrt(left(axis, axis));
    root(axis, column) = std::sqrt(left(axis, axis));
    left -= root.col(column) * root.col(column).transpose();
    left.row(axis).setZero();
    left.col(axis).setZero();
  }
  const Vector6 sigma = variance.cwiseSqrt();
  if ((left.array().abs() > kIndefinite * (sigma * sigma.transpose()).array()).any())
    throw Error("covariance: must be positive semi-definite; check its signs and correlations");
  return root;
}

}  // namespace

Covariance6 covariance_root(const Covariance6& covariance) {
  if (!covariance.allFinite() || !covariance.isApprox(covariance.transpose(), 1e-9))
    throw Error(
        "covariance: must be finite and symmetric; give the full 6x6 matrix, x y z roll pitch yaw");
  // Gram-Schmidt of the rows makes the triangular root of any other.
  Covariance6 rows = pivoted_root(covariance), root = Covariance6::Zero();
  for (int axis = 0; axis < 6; ++axis) {
    const double pivot = rows.row(axis).squaredNorm();
    if (pivot <= kNoShare * covariance(axis, axis)) continue;
    root(axis, axis) = std::sqrt(pivot);
    const auto direction = (rows.row(axis) / root(axis, axis)).eval();
    for (int later = axis + 1; later < 6; ++later) {
      root(later, axis) = rows.row(later).dot(direction);
      rows.row(later) -= root(later, axis) * direction;
    }
  }
  return root;
}

std::vector<Pose> draw_poses(const PoseBelief& belief, const Draws& draws, RandomStream& stream) {
  if (draws.N < 1) throw Error("N: the number of draws must be at least 1");
  Covariance6 root = covariance_root(belief.covariance);  // no use of it excuses a bad one
  if (draws.covariance == CovarianceUse::diagonal)
    root = belief.covariance.diagonal().cwiseMax(0.0).cwiseSqrt().asDiagonal();
  const Pose mean = belief.T_map_odom * belief.T_odom_base;
  std::vector<Pose> poses(static_cast<std::size_t>(draws.N), mean);
  if (root.isZero(0.0)) return poses;
  for (Pose& pose : poses) {
    Vector6 standard;
    for (double& number : standard) number = stream.normal();
    const Pose noise = exp_pose(root * standard);  // of xi ~ N(0, L L^T)
    pose = draws.noise_at == NoiseAt::base ? mean * noise
                                           : belief.T_map_odom * noise * belief.T_odom_base;
  }
  return poses;
}

}  // namespace mapscore
