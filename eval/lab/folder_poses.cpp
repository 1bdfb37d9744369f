// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#include "eval/lab/folder_poses.hpp"

#include "eval/localization/visual_run.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>

namespace mapscore::eval {

FolderPoses find_poses(const LabelledFolder& folder, VisualOdometryParams params,
                       const std::function<void(int, int)>& progress) {
  params.wheeled = false;
  VisualOdometry odometry(params, folder.calibration(), Pose::Identity());
  VisualTrajectory visual;
  FolderPoses found;
  for (const StampedImage& image : folder.depth_images()) {
    const OdometryStep step = odometry.add({image.stamp_s, folder.read_depth(image), {}});
    if (is_untracked(step.tracking) && !found.first_untracked_s)
      found.first_untracked_s = step.stamp_s;
    found.sigma_m =
        std::max(found.sigma_m, std::sqrt(step.covariance.topLeftCorner<3, 3>().trace()));
    found.trajectory.push_back({step.stamp_s, step.T_map_base});
    visual.steps.push_back(step);
    if (progress)
      progress(static_cast<int>(visual.steps.size()),
               static_cast<int>(folder.depth_images().size()));
  }
  visual.loops = odometry.loops();
  found.tracking = TrackingCounts::of(visual);
  refuse_all_blind(visual.steps, "depth.txt",
                   "check --depth_scale and --range_m, or give groundtruth.txt");
  if (params.loops)
    for (std::size_t n = 0; const CorrectedPose& pose : odometry.corrected())
      found.trajectory[n++].T_world_base = pose.T_map_base;
  return found;
}

}  // namespace mapscore::eval
