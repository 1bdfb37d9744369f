// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#pragma once

#include "core/geometry/camera.hpp"
#include "core/segmentation/calibration_evidence.hpp"
#include "core/segmentation/detection.hpp"
#include "core/segmentation/registered_cloud.hpp"

#include <opencv2/core.hpp>

#include <memory>
#include <mutex>
#include <vector>

namespace mapscore {

/// One frame as a method sees it: what it believes of the cameras, a depth image, and detections in
/// the colour image. Copies share the registered cloud. Safe to read from several threads.
class Sight {
 public:
  /// Throws Error when the depth image is not of the depth camera's size, or a detection does not
  /// fit the colour image. The image is not copied and must not change any more.
  Sight(const Calibration& believed, cv::Mat1w depth, std::vector<Detection> detections);

  [[nodiscard]] const Calibration& believed() const { return believed_; }
  /// Planar depth in units of 1 / kDepthUnitsPerMetre; 0: none.
  [[nodiscard]] const cv::Mat1w& depth() const { return depth_; }
  [[nodiscard]] const std::vector<Detection>& detections() const { return detections_; }
  /// The points behind the pixels of the detections' masks, registered when they are first asked
  /// for.
  [[nodiscard]] const RegisteredCloud& cloud() const;

  /// What other frames tell of the believed calibration; nothing of a frame by itself.
  [[nodiscard]] const CalibrationEvidence& told() const { return told_; }
  /// The same frame, among others.
  [[nodiscard]] Sight among(const CalibrationEvidence& told) const {
    Sight one = *this;
    one.told_ = told;
    return one;
  }

 private:
  struct Registered {
    std::once_flag once;
    std::unique_ptr<const RegisteredCloud> cloud;
  };

  Calibration believed_;
  cv::Mat1w depth_;
  std::vector<Detection> detections_;
  CalibrationEvidence told_;
  std::shared_ptr<Registered> registered_ = std::make_shared<Registered>();
};

}  // namespace mapscore
