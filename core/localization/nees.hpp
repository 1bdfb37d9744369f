// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#pragma once

#include "core/localization/planar_pose.hpp"
#include "core/placement/pose_belief.hpp"

#include <Eigen/Cholesky>
#include <Eigen/Core>
#include <limits>

namespace mapscore {

/// Least pivot of Cholesky on the correlations, from 0 to 1, with which a covariance is regular.
inline constexpr double kLeastPivot = 1e-12;

/// Normalised estimation error squared xi^T C^-1 xi of an error with n axes. Of an honest estimate
/// it is chi-square with n degrees of freedom: its mean is n, and 95 % lie within the band of n. Y.
/// Bar-Shalom, X.-R. Li, T. Kirubarajan, Estimation with Applications to Tracking and Navigation
/// (2001), section 5.4. Each axis is measured in its own sigma first, so that neither metres beside
/// radians nor tiny variances lose digits. Infinite when the covariance is singular: a variance
/// that is not above 0, or an axis of whose correlations the others leave less than kLeastPivot.
template <int n>
[[nodiscard]] double nees(const Eigen::Matrix<double, n, 1>& xi,
                          const Eigen::Matrix<double, n, n>& covariance) {
  constexpr double kInfinite = std::numeric_limits<double>::infinity();
  if (!(covariance.diagonal().array() > 0.0).all() || !covariance.allFinite()) return kInfinite;
  const Eigen::Matrix<double, n, 1> scale = covariance.diagonal().cwiseSqrt().cwiseInverse();
  const Eigen::LLT<Eigen::Matrix<double, n, n>> llt(scale.asDiagonal() * covariance *
                                                    scale.asDiagonal());
  if (llt.info() != Eigen::Success) return kInfinite;
  if ((llt.matrixLLT().diagonal().array().square() < kLeastPivot).any()) return kInfinite;
  return llt.matrixL().solve(scale.cwiseProduct(xi)).squaredNorm();
}

/// In the plane, xi = Log(T_mean^-1 T_true), x y yaw: three degrees of freedom.
[[nodiscard]] double nees(const PoseEstimate& estimate, const PlanarPose& T_map_base_true);

/// In space, xi = Log(T_mean^-1 T_true), x y z roll pitch yaw: six degrees of freedom.
[[nodiscard]] double nees(const PoseBelief& belief, const Pose& T_map_base_true);

/// Whether a belief speaks of all six axes: each has a variance above 0. That of a source in the
/// plane has none of z, roll and pitch.
[[nodiscard]] bool is_spatial(const PoseBelief& belief);

/// Quantiles 0.025 and 0.975 of chi-square.
struct NeesBand {
  double low, high;

  [[nodiscard]] constexpr bool holds(double nees) const { return nees >= low && nees <= high; }
};
inline constexpr NeesBand kNeesBand{0.215795, 9.348404};    ///< three degrees of freedom
inline constexpr NeesBand kNeesBand6{1.237344, 14.449375};  ///< six

}  // namespace mapscore
