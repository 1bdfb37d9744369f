// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#pragma once

#include "core/classes.hpp"
#include "core/frame.hpp"
#include "core/geometry/camera.hpp"
#include "core/objects/simulated_perception.hpp"
#include "eval/lab/recorded_surfaces.hpp"
#include "eval/recording/recording.hpp"
#include "eval/study/perception_settings.hpp"
#include "eval/study/study.hpp"

#include <opencv2/core.hpp>

#include <optional>
#include <vector>

namespace mapscore::eval {

/// The label images of simulated perception in place of a recording's: a sensor without faults,
/// which knows the true pose and calibration and votes with the noise-free depth image. Immutable,
/// safe to share between threads.
class SimulatedLabels {
 public:
  /// Throws Error when the file of the objects is refused, holds too many, or there is neither file
  /// nor truth.
  SimulatedLabels(const SimulatedPerception& settings, const Study& config,
                  const Recording& recording, const ClassTable& table);

  /// The recording's table; where a file is given, with its objects as further instances.
  [[nodiscard]] const ClassTable& table() const { return table_; }
  /// Instance ids per colour pixel. Reads the frame's `depth`, stamp and pose.
  [[nodiscard]] cv::Mat1w of(const Frame& frame) const;

 private:
  [[nodiscard]] std::vector<PerceivedModel> models_at(double stamp_s) const;

  SimulatedPerception settings_;
  Calibration calibration_;
  ClassTable table_;
  RecordedShapes shapes_;               ///< of the truth, where they move
  std::vector<PerceivedModel> models_;  ///< in the scene's world, where nothing moves
};

/// Simulated perception, where a study has it.
[[nodiscard]] std::optional<SimulatedLabels> simulated_labels(const Study& config,
                                                              const Recording& recording,
                                                              const ClassTable& table);

}  // namespace mapscore::eval
