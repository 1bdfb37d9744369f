// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#pragma once

namespace mapscore::eval {

/// Processor time of this thread since its start, in seconds.
[[nodiscard]] double thread_seconds();

/// Processor time that a method spent on one frame, in seconds. Measured, so not the same twice.
struct FrameTimes {
  double registration_s = 0.0;  ///< depth to colour, where some segmentation reads a point
  double segmentation_s = 0.0;  ///< of all detections
  double mapping_s = 0.0;       ///< drawing poses, placing, fusing

  [[nodiscard]] double total_s() const { return registration_s + segmentation_s + mapping_s; }
};

}  // namespace mapscore::eval
