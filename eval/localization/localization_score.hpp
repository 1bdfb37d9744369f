// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#pragma once

#include "eval/localization/believed_trajectory.hpp"
#include "eval/localization/trajectory_errors.hpp"
#include "eval/recording/recording.hpp"
#include "eval/recording/stamp_list.hpp"

#include <optional>
#include <vector>

namespace mapscore::eval {

/// Error of the belief at one frame.
struct FrameError {
  double stamp_s = 0.0;
  double position_m = 0.0;   ///< distance on the floor from the true place
  double heading_rad = 0.0;  ///< of the believed yaw, from 0 to pi
  /// See core's nees; infinite where the covariance is singular, nothing where all of it is 0.
  std::optional<double> nees;
  double sigma_m = 0.0;    ///< square root of the trace of the position's covariance
  bool converged = false;  ///< at this frame or before it
  /// Log(T_mean^-1 T_true) in the plane, x y yaw in the robot's axes (metres, radians), and what
  /// the belief says of it: a standard deviation each.
  Eigen::Vector3d error = Eigen::Vector3d::Zero(), sigma = Eigen::Vector3d::Zero();
  double distance_m = 0.0;             ///< in space from the true place
  double rotation_rad = 0.0;           ///< angle in space between the attitudes
  std::optional<double> spatial_nees;  ///< of a belief that has a variance of all six axes
};

/// Of the frames after convergence.
struct ErrorSummary {
  double mean = 0.0, median = 0.0, p95 = 0.0, max = 0.0;
};

struct LocalizationScore {
  std::vector<FrameError> frames;
  std::optional<double> converged_s;     ///< stamp of the first frame that is; nothing: never
  ErrorSummary position_m, heading_deg;  ///< of the converged frames
  /// Of the converged frames that have a NEES, the share that lies in kNeesBand; nothing where none
  /// has.
  std::optional<double> nees_share;
  TrajectoryErrors all;  ///< of all frames, converged or not, in space
};

/// A belief has converged when it says so itself: from the first frame on at which the root of the
/// trace of the position's covariance is below this.
inline constexpr double kConvergedSigma = 0.2;

/// Compares a belief with true poses T_map_base_footprint at their stamps. What is not said to be
/// in space is in the plane: the pose's height and tilt do not count. Quantiles are those of sorted
/// frames, linear between neighbours. Throws Error where the belief does not reach a stamp.
[[nodiscard]] LocalizationScore score_localization(const BelievedTrajectory& believed,
                                                   const std::vector<TrajectoryPose>& truth);

/// The true pose at each colour image of a recording, in the scene's world.
[[nodiscard]] std::vector<TrajectoryPose> true_poses(const Recording& recording);

/// As above, at each colour image of a recording.
[[nodiscard]] LocalizationScore score_localization(const BelievedTrajectory& believed,
                                                   const Recording& recording);

}  // namespace mapscore::eval
