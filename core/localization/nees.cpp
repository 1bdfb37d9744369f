// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#include "core/localization/nees.hpp"

namespace mapscore {

double nees(const PoseEstimate& estimate, const PlanarPose& T_map_base_true) {
  return nees<3>(log_planar(inverse(estimate.mean) * T_map_base_true), estimate.covariance);
}

double nees(const PoseBelief& belief, const Pose& T_map_base_true) {
  const Pose T_map_base = belief.T_map_odom * belief.T_odom_base;
  return nees<6>(log_pose(T_map_base.inverse() * T_map_base_true), belief.covariance);
}

bool is_spatial(const PoseBelief& belief) {
  return (belief.covariance.diagonal().array() > 0.0).all();
}

}  // namespace mapscore
