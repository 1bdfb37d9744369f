// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#include "eval/foreign/trial_folder.hpp"

#include "eval/foreign/id_layers.hpp"
#include "files/file_bytes.hpp"
#include "files/png.hpp"

#include <utility>

namespace mapscore::eval {
namespace {

cv::Size size_in(const CameraModel& camera) {
  return {camera.width_px, camera.height_px};
}

}  // namespace

TrialFolder::TrialFolder(std::filesystem::path folder)
    : folder_(std::move(folder)), sheet_(read_sheet(folder_)) {
  for (const TrialDetection& row : sheet_.detections)
    (row.frame ? of_frame_[*row.frame] : of_every_frame_).push_back(row);
}

void TrialFolder::believe(const Calibration& calibration) {
  const auto of_size = [](CameraModel camera, const CameraModel& images) {
    camera.width_px = images.width_px;
    camera.height_px = images.height_px;
    return camera;
  };
  const Calibration of_trial = sheet_.believed;
  sheet_.believed = calibration;
  sheet_.believed.color = of_size(calibration.color, of_trial.color);
  sheet_.believed.depth = of_size(calibration.depth, of_trial.depth);
}

Sight TrialFolder::sight(int position) const {
  const TrialFrame& frame = this->frame(position);
  const Calibration& believed = sheet_.believed;
  const std::filesystem::path depth = folder_ / frame.depth;
  std::vector<TrialDetection> meanings = of_every_frame_;
  if (const auto own = of_frame_.find(frame.index); own != of_frame_.end())
    meanings.insert(meanings.end(), own->second.begin(), own->second.end());
  const auto layer = [&](int number) {
    const std::filesystem::path file = folder_ / layer_path(frame.label, number);
    return decode_grey16_png(read_file(file), size_in(believed.color), file.string());
  };
  return {believed, decode_grey16_png(read_file(depth), size_in(believed.depth), depth.string()),
          detections_of(meanings, sheet_.classes, layer)};
}

cv::Mat3b TrialFolder::color(int position) const {
  const std::filesystem::path file = folder_ / frame(position).color;
  return decode_color_png(read_file(file), size_in(sheet_.believed.color), file.string());
}

}  // namespace mapscore::eval
