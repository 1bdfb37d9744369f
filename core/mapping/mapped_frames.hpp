// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#pragma once

#include "core/geometry/camera.hpp"
#include "core/geometry/pose.hpp"
#include "core/odometry/key_frames.hpp"
#include "core/parameters.hpp"

#include <opencv2/core.hpp>

#include <optional>
#include <string_view>
#include <variant>

namespace mapscore {

struct AllFrames : NoFields {
  static constexpr std::string_view kKind = "all";
  static constexpr std::string_view kMeaning = "every frame is mapped";
};

/// Key frames alone are mapped, as in maps above ORB-SLAM2 (R. Mur-Artal, J. D. Tardos, ORB-SLAM2,
/// 2017; its rule is of features, this one of pose and depth).
struct KeyFramesAlone : KeyFrameRule {
  static constexpr std::string_view kKind = "key_frames";
  static constexpr std::string_view kMeaning =
      "key frames alone are mapped (docs/methods.md), by the poses that the robot believes";
};

/// Which of the frames enter a map.
using MappedFrames = std::variant<AllFrames, KeyFramesAlone>;

/// Chooses them, one frame after the other. Used by one thread at a time.
class FrameChoice {
 public:
  /// Throws Error when a parameter is out of range.
  explicit FrameChoice(const MappedFrames& mapped);

  /// Whether a frame is mapped. Of key frames: the first one with depth is, and then each that
  /// is_key_frame tells from the last one; one without any depth is not. `depth` and `believed`: as
  /// the method sees them; `T_map_base`: as the robot believes it. Ask once a frame, in their
  /// order. Throws Error when the image is not of the camera's size.
  [[nodiscard]] bool takes(const cv::Mat1w& depth, const Calibration& believed,
                           const Pose& T_map_base);

 private:
  MappedFrames mapped_;
  std::optional<Pose> T_map_key_;  ///< of the last key frame
};

}  // namespace mapscore
