// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#pragma once

#include "core/odometry/visual_odometry.hpp"
#include "eval/localization/believed_trajectory.hpp"
#include "eval/recording/recording.hpp"
#include "sim/faults/image_doses.hpp"

#include <array>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <span>
#include <string>
#include <vector>

namespace mapscore::eval {

/// What visual odometry of a study looks at, and which of its poses a map is made at.
struct VisualSettings {
  bool wheels = true;
  bool corrected = false;

  static void fields(auto& s, auto&& visit) {
    visit(s.wheels, Field{"wheels",
                          "the wheels' increments are a prior of each step; without them "
                          "the robot is expected to go on as it went"});
    visit(s.corrected,
          Field{"corrected",
                "of visual_slam: the poses after all loops of the drive, as of a map that is "
                "integrated anew at the corrected key frames; else those of the moment"});
  }
  bool operator==(const VisualSettings&) const = default;
};

/// How the depth images of a recording become poses.
struct VisualRun {
  VisualOdometryParams params;
  VisualSettings visual;
  Calibration believed;    ///< with the trial's faults of calibration
  sim::DepthDose depth;    ///< noise of the depth images
  std::uint64_t seed = 0;  ///< of the noise
};

/// What came of it.
struct VisualTrajectory {
  BelievedTrajectory believed;      ///< an entry a depth image, and in gaps between them
  std::vector<OdometryStep> steps;  ///< one a depth image
  std::size_t loops = 0;
  double without_images_s = 0.0;  ///< in gaps between depth images, where the wheels carried
  /// Frames by the way their pose came about, in the order of Tracking's words.
  [[nodiscard]] std::array<int, names_of(Tracking{}).size()> frames_by_tracking() const;
};

/// Throws Error, beginning with the file that lists the images and ending with how to mend it,
/// where none of them has depth enough to find a pose by: all that is believed would be made up.
void refuse_all_blind(std::span<const OdometryStep> steps, const std::string& file,
                      const std::string& mend);

/// Runs visual odometry or SLAM over all depth images of a recording from `T_map_base_start`, the
/// pose at the first one. `progress(images done, all)`. Throws Error as Recording and
/// VisualOdometry do, where the wheels are asked for and the recording has no odometry, and where
/// no image has depth (refuse_all_blind).
[[nodiscard]] VisualTrajectory run_visual(const Recording& recording, const VisualRun& run,
                                          const Pose& T_map_base_start,
                                          const std::function<void(int, int)>& progress = {});

}  // namespace mapscore::eval
