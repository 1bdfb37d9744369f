// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#include "eval/lab/folder_poses.hpp"

#include "eval/localization/visual_run.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <vector>

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

std::string odd_stamps(std::span<const StampedImage> images) {
  std::vector<double> gaps_s;
  for (std::size_t n = 1; n < images.size(); ++n) {
    gaps_s.push_back(images[n].stamp_s - images[n - 1].stamp_s);
    if (gaps_s.back() > kLongestGap_s)
      return fmt::format(
          "depth.txt: {} s comes {:.6g} s after the image before; stamps are seconds, and over "
          "such a gap a pose is little more than a guess",
          images[n].stamp_s, gaps_s.back());
  }
  if (gaps_s.empty()) return "";
  const auto middle = gaps_s.begin() + static_cast<std::ptrdiff_t>(gaps_s.size() / 2);
  std::ranges::nth_element(gaps_s, middle);
  if (*middle >= kShortestGap_s) return "";
  return fmt::format(
      "depth.txt: from {} s on images come {:.3g} s apart; stamps are seconds, and in so short a "
      "time no camera is expected to move",
      images.front().stamp_s, *middle);
}

}  // namespace mapscore::eval
