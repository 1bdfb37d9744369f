// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#pragma once

#include "core/geometry/camera.hpp"
#include "core/parameters.hpp"

#include <opencv2/core.hpp>

namespace mapscore {

/// When a frame is one to keep: the robot has moved or turned far enough since the last one kept,
/// or sees little of what it saw there.
struct KeyFrameRule {
  double key_way_m = 0.3;
  Degrees key_turn_deg{15};
  double key_overlap = 0.6;

  static void fields(auto& s, auto&& visit) {
    visit(s.key_way_m, Field{"key_way_m", "way after which a frame is a key frame", above(0, 100)});
    visit(s.key_turn_deg,
          Field{"key_turn_deg", "turn after which a frame is a key frame", above(0, 360)});
    visit(s.key_overlap,
          Field{"key_overlap",
                "a frame of which the last key frame saw less than this share is a key frame",
                {0, 1}});
  }
  bool operator==(const KeyFrameRule&) const = default;
};

/// Share of a depth image's points (every 16th pixel of every 16th row) that lie in the view of the
/// same camera at another pose of the robot, within its range; 0 of an image without depth. What
/// hides them there does not count. `T_other_base`: of this frame's base in the other's.
[[nodiscard]] double overlap(const cv::Mat1w& depth, const Calibration& believed,
                             const Pose& T_other_base);

/// Whether a frame is a key frame, given the pose of its base in the last key frame's.
[[nodiscard]] bool is_key_frame(const KeyFrameRule& rule, const cv::Mat1w& depth,
                                const Calibration& believed, const Pose& T_key_base);

}  // namespace mapscore
