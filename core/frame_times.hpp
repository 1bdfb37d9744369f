// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#pragma once

namespace mapscore {

/// Processor time of this thread since its start, in seconds.
[[nodiscard]] double thread_seconds();

/// Processor time that a method spent on one frame, in seconds. Measured, so not the same twice.
struct FrameTimes {
  double segmentation_s = 0.0;  ///< registration, where a segmentation reads a point, and all
                                ///< detections
  double mapping_s = 0.0;       ///< drawing poses, placing, carving, fusing

  [[nodiscard]] double total_s() const { return segmentation_s + mapping_s; }
};

}  // namespace mapscore
