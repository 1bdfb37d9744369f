// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#include "eval/localization/localization_score.hpp"

#include "core/localization/nees.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <numeric>

namespace mapscore::eval {
namespace {

FrameError error_of(const PoseBelief& belief, const TrajectoryPose& truth) {
  const PoseEstimate estimate = planar_estimate(belief);
  const Pose T_mean = belief.T_map_odom * belief.T_odom_base;
  const PlanarPose T_map_base = planar(truth.T_world_base);
  FrameError error;
  error.stamp_s = truth.stamp_s;
  error.position_m =
      std::hypot(estimate.mean.x_m - T_map_base.x_m, estimate.mean.y_m - T_map_base.y_m);
  error.heading_rad = std::abs(wrapped_angle(estimate.mean.yaw_rad - T_map_base.yaw_rad));
  if (!estimate.covariance.isZero(0.0)) error.nees = nees(estimate, T_map_base);
  error.sigma_m = std::sqrt(estimate.covariance.topLeftCorner<2, 2>().trace());
  error.error = log_planar(inverse(estimate.mean) * T_map_base);
  error.sigma = estimate.covariance.diagonal().cwiseSqrt();
  error.distance_m = (T_mean.translation() - truth.T_world_base.translation()).norm();
  error.rotation_rad = rotation_angle(truth.T_world_base.linear().transpose() * T_mean.linear());
  if (is_spatial(belief)) error.spatial_nees = nees(belief, truth.T_world_base);
  return error;
}

double quantile(const std::vector<double>& sorted, double share) {
  const double at = share * static_cast<double>(sorted.size() - 1);
  const auto below = static_cast<std::size_t>(at);
  const std::size_t above = std::min(below + 1, sorted.size() - 1);
  return std::lerp(sorted[below], sorted[above], at - static_cast<double>(below));
}

ErrorSummary summary_of(std::vector<double> errors) {
  if (errors.empty()) return {};
  std::ranges::sort(errors);
  const double sum = std::accumulate(errors.begin(), errors.end(), 0.0);
  return {sum / static_cast<double>(errors.size()), quantile(errors, 0.5), quantile(errors, 0.95),
          errors.back()};
}

}  // namespace

LocalizationScore score_localization(const BelievedTrajectory& believed,
                                     const std::vector<TrajectoryPose>& truth) {
  LocalizationScore score;
  std::vector<double> positions_m, headings_deg;
  std::vector<PoseBelief> beliefs;
  std::vector<Pose> poses;
  int in_band = 0, with_nees = 0;
  for (const TrajectoryPose& pose : truth) {
    poses.push_back(pose.T_world_base);
    beliefs.push_back(believed.at(pose.stamp_s));
    FrameError error = error_of(beliefs.back(), pose);
    if (!score.converged_s && error.sigma_m < kConvergedSigma) score.converged_s = pose.stamp_s;
    error.converged = score.converged_s.has_value();
    score.frames.push_back(error);
    if (!error.converged) continue;
    positions_m.push_back(error.position_m);
    headings_deg.push_back(error.heading_rad * 180.0 / std::numbers::pi);
    if (!error.nees) continue;
    ++with_nees;
    if (kNeesBand.holds(*error.nees)) ++in_band;
  }
  if (with_nees > 0) score.nees_share = static_cast<double>(in_band) / with_nees;
  score.position_m = summary_of(std::move(positions_m));
  score.heading_deg = summary_of(std::move(headings_deg));
  score.all = trajectory_errors(poses, beliefs);
  return score;
}

std::vector<TrajectoryPose> true_poses(const Recording& recording) {
  std::vector<TrajectoryPose> truth;
  for (int frame = 0; frame < recording.frame_count(); ++frame)
    truth.push_back({recording.color_stamp_s(frame), recording.T_world_base_of_color(frame)});
  return truth;
}

LocalizationScore score_localization(const BelievedTrajectory& believed,
                                     const Recording& recording) {
  return score_localization(believed, true_poses(recording));
}

}  // namespace mapscore::eval
