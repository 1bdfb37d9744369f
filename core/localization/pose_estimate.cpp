// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#include "core/localization/pose_estimate.hpp"

#include <Eigen/Cholesky>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>

namespace mapscore {

PoseEstimate estimate_of(std::span<const PlanarPose> poses, std::span<const double> weights) {
  PoseEstimate estimate;
  double cosine = 0.0, sine = 0.0;
  for (std::size_t n = 0; n < poses.size(); ++n) {
    estimate.mean.x_m += weights[n] * poses[n].x_m;
    estimate.mean.y_m += weights[n] * poses[n].y_m;
    cosine += weights[n] * std::cos(poses[n].yaw_rad);
    sine += weights[n] * std::sin(poses[n].yaw_rad);
  }
  estimate.mean.yaw_rad = std::atan2(sine, cosine);
  const PlanarPose T_mean_map = inverse(estimate.mean);
  for (std::size_t n = 0; n < poses.size(); ++n) {
    const Eigen::Vector3d xi = log_planar(T_mean_map * poses[n]);
    estimate.covariance += weights[n] * xi * xi.transpose();
  }
  return estimate;
}

Covariance6 spatial_covariance(const Eigen::Matrix3d& covariance) {
  constexpr std::array<int, 3> kAxes = {0, 1, 5};
  Covariance6 spatial = Covariance6::Zero();
  for (int row = 0; row < 3; ++row)
    for (int column = 0; column < 3; ++column)
      spatial(kAxes[static_cast<std::size_t>(row)], kAxes[static_cast<std::size_t>(column)]) =
          covariance(row, column);
  return spatial;
}

double nees(const PoseEstimate& estimate, const PlanarPose& T_map_base_true) {
  const Eigen::Vector3d xi = log_planar(inverse(estimate.mean) * T_map_base_true);
  const Eigen::LLT<Eigen::Matrix3d> llt(estimate.covariance);
  if (llt.info() != Eigen::Success) return std::numeric_limits<double>::infinity();
  return xi.dot(llt.solve(xi));
}

}  // namespace mapscore
