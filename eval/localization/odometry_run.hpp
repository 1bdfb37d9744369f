// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#pragma once

#include "core/localization/odometry_motion.hpp"
#include "eval/localization/believed_trajectory.hpp"
#include "eval/recording/odometry_file.hpp"

#include <vector>

namespace mapscore::eval {

/// Dead reckoning: T_map_odom as the true start gives it, throughout. One entry a line of the
/// odometry, whose covariance grows from 0: over each motion D of 5 cm or 0.05 rad it becomes
/// Ad C Ad^T + Q, Ad the adjoint of D^-1 and Q the covariance of the motion model.
/// T_map_base_start: true pose at the first line. Throws Error when there is no line, or an alpha
/// is negative.
[[nodiscard]] BelievedTrajectory odometry_only(const std::vector<OdometryPose>& odometry,
                                               const PlanarPose& T_map_base_start,
                                               const OdometryNoise& noise);

}  // namespace mapscore::eval
