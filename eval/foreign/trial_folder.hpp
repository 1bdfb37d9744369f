// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#pragma once

#include "core/segmentation/sight.hpp"
#include "eval/foreign/trial_sheet.hpp"

#include <opencv2/core.hpp>

#include <cstddef>
#include <filesystem>
#include <map>
#include <vector>

namespace mapscore::eval {

/// A trial that was written as a folder (docs/formats.md), read for mapping. Safe to share between
/// threads.
class TrialFolder {
 public:
  /// Throws Error as read_sheet.
  explicit TrialFolder(std::filesystem::path folder);

  [[nodiscard]] const TrialSheet& sheet() const { return sheet_; }
  [[nodiscard]] int frame_count() const { return static_cast<int>(sheet_.frames.size()); }
  [[nodiscard]] const TrialFrame& frame(int position) const {
    return sheet_.frames.at(static_cast<std::size_t>(position));
  }

  /// Replaces what the trial's method believes of the cameras; images keep their sizes.
  void believe(const Calibration& calibration);

  /// What the method sees of the frame at a position of the list. Throws Error where an image is
  /// missing, damaged or of another size.
  [[nodiscard]] Sight sight(int position) const;
  /// Its colour image, likewise.
  [[nodiscard]] cv::Mat3b color(int position) const;

 private:
  std::filesystem::path folder_;
  TrialSheet sheet_;
  std::vector<TrialDetection> of_every_frame_;
  std::map<int, std::vector<TrialDetection>> of_frame_;  ///< by TrialFrame::index
};

}  // namespace mapscore::eval
