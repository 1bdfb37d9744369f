// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#include "core/placement/pose_belief.hpp"

#include "core/error.hpp"

#include <Eigen/Cholesky>

namespace mapscore {

Covariance6 covariance_root(const Covariance6& covariance) {
  const double scale = covariance.cwiseAbs().maxCoeff();
  if (!covariance.allFinite() || !covariance.isApprox(covariance.transpose(), 1e-9))
    throw Error(
        "covariance: must be finite and symmetric; give the full 6x6 matrix, x y z roll pitch yaw");
  if (scale == 0.0) return Covariance6::Zero();
  if (covariance.isDiagonal(0.0) && covariance.diagonal().minCoeff() >= 0.0)
    return covariance.diagonal().cwiseSqrt().asDiagonal();
  const Eigen::LDLT<Covariance6> ldlt(covariance);
  if (ldlt.info() != Eigen::Success || ldlt.vectorD().minCoeff() < -1e-12 * scale)
    throw Error("covariance: must be positive semi-definite; check its signs and correlations");
  const Covariance6 lower = ldlt.matrixL();
  const Covariance6 root = lower * ldlt.vectorD().cwiseMax(0.0).cwiseSqrt().asDiagonal();
  return ldlt.transpositionsP().transpose() * root;
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
