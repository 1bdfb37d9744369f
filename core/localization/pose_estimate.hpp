// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#pragma once

#include "core/geometry/pose.hpp"
#include "core/localization/planar_pose.hpp"

#include <Eigen/Core>
#include <span>

namespace mapscore {

/// A pose T_map_base and the covariance of its error xi, T_true = T_mean Exp(xi): x y yaw in the
/// axes of base_footprint (metres, radians).
struct PoseEstimate {
  PlanarPose mean;
  Eigen::Matrix3d covariance = Eigen::Matrix3d::Zero();
};

/// Of weighted poses (weights sum to 1): mean position, circular mean of yaw, atan2(sum w sin yaw,
/// sum w cos yaw), and the mean of xi xi^T about it.
[[nodiscard]] PoseEstimate estimate_of(std::span<const PlanarPose> poses,
                                       std::span<const double> weights);

/// The covariance in the order x y z roll pitch yaw; zero for z, roll and pitch.
[[nodiscard]] Covariance6 spatial_covariance(const Eigen::Matrix3d& covariance);

/// Normalised estimation error squared xi^T covariance^-1 xi, xi = Log(T_mean^-1 T_true). Of an
/// honest estimate it is chi-square with three degrees of freedom: 95 % lie within kNeesBand. Y.
/// Bar-Shalom, X.-R. Li, T. Kirubarajan, Estimation with Applications to Tracking and Navigation
/// (2001), section 5.4. Infinite when the covariance is singular.
[[nodiscard]] double nees(const PoseEstimate& estimate, const PlanarPose& T_map_base_true);

/// Quantiles 0.025 and 0.975 of chi-square with three degrees of freedom.
struct NeesBand {
  double low, high;
};
inline constexpr NeesBand kNeesBand{0.215795, 9.348404};

}  // namespace mapscore
