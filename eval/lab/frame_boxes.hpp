// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#pragma once

#include "core/frame.hpp"
#include "core/geometry/camera.hpp"
#include "eval/recording/recording.hpp"

#include <Eigen/Geometry>
#include <cstddef>
#include <mutex>
#include <vector>

namespace mapscore::eval {

/// True boxes of the instances in each depth image of one recording. They depend on no trial, so
/// each frame's are made once, by the first trial that asks. Safe to use from several threads.
class FrameBoxes {
 public:
  explicit FrameBoxes(const Recording& recording);

  /// By instance id, as truth_boxes gives them; valid as long as this. `frame`: of the recording,
  /// with depth and depth_label. Throws Error when it lacks them.
  [[nodiscard]] const std::vector<Eigen::AlignedBox3d>& of(const Frame& frame);

 private:
  struct Entry {
    std::once_flag made;
    std::vector<Eigen::AlignedBox3d> boxes;
  };

  Calibration calibration_;
  std::size_t instance_count_;
  std::vector<Entry> entries_;  ///< by depth image
};

}  // namespace mapscore::eval
