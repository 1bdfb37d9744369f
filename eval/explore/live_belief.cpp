// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#ifdef MAPSCORE_SIMULATOR

#include "eval/explore/live_belief.hpp"

#include "eval/localization/localization_run.hpp"
#include "sim/robot/drive_simulation.hpp"

namespace mapscore::eval {
LiveBelief::LiveBelief(const Task& task, const Pose& T_map_world)
    : task_(task), T_map_world_(T_map_world) {
  const PoseSource source = task.config.localization.source;
  sim::PoseNoise noise = task.config.faults.pose;
  if (source == PoseSource::truth) noise = {};
  by_odometry_ = source == PoseSource::odometry;
  covariance_ = sim::reported_covariance(noise);
  errors_.emplace(sim::covariance_of(noise), noise.kind, trial_seed(task));
}

PoseBelief LiveBelief::at_next_frame(const sim::DriveLog& log, double stamp_s) {
  if (by_odometry_) return by_odometry(log, stamp_s);
  error_ = errors_->next();
  return {Pose::Identity(), mean_at(log, stamp_s), covariance_};
}

Pose LiveBelief::mean_at(const sim::DriveLog& log, double stamp_s) {
  if (by_odometry_) return T_map_odom_ * odometry_up_to(log, stamp_s);
  return T_map_world_ * (sim::pose_at(log, stamp_s) * error_);
}

Pose LiveBelief::odometry_up_to(const sim::DriveLog& log, double stamp_s) {
  for (std::size_t n = odometry_.size(); n < log.samples.size(); ++n)
    odometry_.push_back({log.samples[n].stamp_s, log.samples[n].T_odom_base});
  return odometry_at(odometry_, stamp_s);
}

PoseBelief LiveBelief::by_odometry(const sim::DriveLog& log, double stamp_s) {
  static_cast<void>(odometry_up_to(log, stamp_s));
  const Pose& T_world_start = log.samples.front().T_world_base;
  const BelievedTrajectory believed = odometry_only(
      odometry_, planar(T_world_start), task_.config.localization.odometry_noise.values);
  PoseBelief belief = believed.at(stamp_s);
  belief.T_map_odom.pretranslate(Eigen::Vector3d(0.0, 0.0, T_world_start.translation().z()));
  belief.T_map_odom = T_map_odom_ = T_map_world_ * belief.T_map_odom;
  belief.covariance *= task_.config.faults.pose.reported_scale;
  return belief;
}

}  // namespace mapscore::eval

#endif
