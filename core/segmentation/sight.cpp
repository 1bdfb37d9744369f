// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#include "core/segmentation/sight.hpp"

#include "core/error.hpp"

#include <utility>

namespace mapscore {

Sight::Sight(const Calibration& believed, cv::Mat1w depth, std::vector<Detection> detections)
    : believed_(believed), depth_(std::move(depth)), detections_(std::move(detections)) {
  check(believed_);
  if (depth_.cols != believed_.depth.width_px || depth_.rows != believed_.depth.height_px)
    throw Error(
        "depth image: not of the depth camera's size; give the intrinsics it was taken with");
  for (const Detection& detection : detections_)
    check(detection, believed_.color.width_px, believed_.color.height_px);
}

const RegisteredCloud& Sight::cloud() const {
  std::call_once(registered_->once, [this] {
    registered_->cloud = std::make_unique<const RegisteredCloud>(register_depth(
        depth_, believed_,
        pixels_wanted(detections_, believed_.color.width_px, believed_.color.height_px)));
  });
  return *registered_->cloud;
}

}  // namespace mapscore
