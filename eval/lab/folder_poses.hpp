// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#pragma once

#include "core/odometry/visual_odometry.hpp"
#include "eval/foreign/labelled_folder.hpp"
#include "eval/recording/stamp_list.hpp"
#include "eval/results/tracking_counts.hpp"

#include <functional>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace mapscore::eval {

/// Of consecutive depth images: no camera is faster, and over a longer gap nobody knows the motion.
inline constexpr double kShortestGap_s = 1e-3, kLongestGap_s = 60.0;

/// Where a folder's camera was, as its depth images tell.
struct FolderPoses {
  std::vector<TrajectoryPose>
      trajectory;  ///< of the base, in that of the first image; one an image
  TrackingCounts tracking;
  std::optional<double> first_untracked_s;  ///< stamp of the first such image
  double sigma_m = 0.0;  ///< largest standard deviation of a position, at its moment, as believed
};

/// Runs visual odometry, or where `params` close loops visual SLAM, over all depth images of a
/// folder, without wheels, as of a camera that may move freely. With loops each pose is that after
/// all of them. `progress(images done, all)`. Throws Error as LabelledFolder::read_depth, and where
/// no image has depth enough to begin with.
[[nodiscard]] FolderPoses find_poses(const LabelledFolder& folder, VisualOdometryParams params,
                                     const std::function<void(int, int)>& progress = {});

/// What is odd of the stamps of depth images, whose seconds decide how far a camera may have moved:
/// two that are more than kLongestGap_s apart, or all of them (their median) closer than
/// kShortestGap_s, as of another unit. Empty where nothing is.
[[nodiscard]] std::string odd_stamps(std::span<const StampedImage> images);

}  // namespace mapscore::eval
