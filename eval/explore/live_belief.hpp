// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#pragma once

#include "core/placement/pose_belief.hpp"
#include "eval/recording/stamp_list.hpp"
#include "eval/results/task_list.hpp"
#include "sim/faults/pose_fault.hpp"
#include "sim/robot/drive_session.hpp"

#include <optional>
#include <vector>

namespace mapscore::eval {

/// Where a robot believes to be while it drives: what PoseSources say of the recording afterwards,
/// for the sources that need nothing that comes later. Used by one thread at a time.
class LiveBelief {
 public:
  /// `task` must outlive it. Throws Error where the source cannot be computed on the way.
  LiveBelief(const Task& task, const Pose& T_map_world);

  /// The belief at the next frame, in frame map. `log`: the drive up to that stamp at least.
  [[nodiscard]] PoseBelief at_next_frame(const sim::DriveLog& log, double stamp_s);
  /// T_map_base that is believed at a stamp between two frames: the error is that of the last.
  [[nodiscard]] Pose mean_at(const sim::DriveLog& log, double stamp_s);

 private:
  [[nodiscard]] Pose odometry_up_to(const sim::DriveLog& log, double stamp_s);
  [[nodiscard]] PoseBelief by_odometry(const sim::DriveLog& log, double stamp_s);

  const Task& task_;
  Pose T_map_world_;
  bool by_odometry_ = false;
  Covariance6 covariance_;
  std::optional<sim::PoseErrors> errors_;
  Pose error_ = Pose::Identity();  ///< of the last frame, in the axes of base_footprint
  std::vector<OdometryPose> odometry_;
  Pose T_map_odom_ = Pose::Identity();  ///< stays, for odometry alone
};

}  // namespace mapscore::eval
