// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#include "core/mapping/mapped_frames.hpp"

#include "core/error.hpp"

namespace mapscore {

FrameChoice::FrameChoice(const MappedFrames& mapped) : mapped_(mapped) {
  std::visit([](const auto& kind) { check_ranges(kind); }, mapped);
}

bool FrameChoice::takes(const cv::Mat1w& depth, const Calibration& believed,
                        const Pose& T_map_base) {
  const auto* rule = std::get_if<KeyFramesAlone>(&mapped_);
  if (rule == nullptr) return true;
  if (depth.cols != believed.depth.width_px || depth.rows != believed.depth.height_px)
    throw Error(
        "key frames: a depth image is not of the depth camera's size; give its calibration");
  if (cv::countNonZero(depth) == 0) return false;
  if (T_map_key_ && !is_key_frame(*rule, depth, believed, T_map_key_->inverse() * T_map_base))
    return false;
  T_map_key_ = T_map_base;
  return true;
}

}  // namespace mapscore
