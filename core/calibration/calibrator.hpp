// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#pragma once

#include "core/calibration/calibration_correction.hpp"
#include "core/calibration/calibrator_settings.hpp"
#include "core/calibration/outline_evidence.hpp"
#include "core/segmentation/sight.hpp"

#include <cstddef>
#include <deque>
#include <optional>
#include <string>
#include <vector>

namespace mapscore {

enum class CalibrationVerdict {
  calibrated,   ///< the estimate explains the outlines better than the start, or as well
  confirmed,    ///< it differs from the start by no more than chance: the start is what is given
  not_better,   ///< the start explains the outlines better: it is what is given
  undetermined  ///< what was seen does not tell some direction; the start is what is given
};
/// Whether the frames told the calibration.
[[nodiscard]] constexpr bool is_known(CalibrationVerdict verdict) {
  return verdict == CalibrationVerdict::calibrated || verdict == CalibrationVerdict::confirmed;
}
constexpr auto names_of(CalibrationVerdict) {
  return std::to_array<std::string_view>({"calibrated", "confirmed", "not_better", "undetermined"});
}

/// What one frame did to an estimate.
struct FrameContribution {
  std::size_t edges = 0;   ///< depth edges near outlines
  double length_px = 0;    ///< of its outlines
  double explained = 0;    ///< share of them on which edges lie, within 1.5 px
  double information = 0;  ///< share of what is known of the weakest direction
  double residual_px = 0;  ///< root mean square of its edges that lie on outlines
  double left_out_px = 0;  ///< the same under the estimate without this frame
};

struct CalibrationEstimate {
  /// Limits beyond which an estimate is undetermined.
  static constexpr double kMostWeak_px = 1.0;
  static constexpr double kMostCondition = 250.0;  ///< one object has 900, twenty frames below 100

  CalibrationVerdict verdict = CalibrationVerdict::undetermined;
  /// Empty where calibrated; else why not, and what helps.
  std::string reason;
  /// Calibrated, but so near to the start, or ahead of it by so few outlines, that it may be worse.
  bool may_be_worse = false;
  CalibrationCorrection correction;  ///< what was found, to be used or not
  Calibration calibration;           ///< the start, corrected where the verdict is calibrated
  /// Of correction.vector() without the mask's size, order of Axis; 0 for what was not looked for.
  /// Where the verdict is undetermined it may be huge, or not finite.
  Eigen::Matrix<double, CalibrationCorrection::kAxes, CalibrationCorrection::kAxes> covariance =
      Eigen::Matrix<double, CalibrationCorrection::kAxes, CalibrationCorrection::kAxes>::Zero();
  float sigma_px = 0;     ///< width of the last fit: of edges about outlines
  double objects = 0;     ///< outlines that tell as much as all do: of equal ones their number; an
                          ///< object that frames show unmoved has one
  double condition = 0;   ///< of the normal equations, all numbers in pixels
  std::string weakest;    ///< the direction that is known least, in words
  double weakest_px = 0;  ///< its standard deviation in pixels
  double explained_start = 0, explained = 0;  ///< share of the outlines within 1.5 px of edges
  std::vector<FrameContribution> frames;
};

/// Finds how the depth camera lies to the colour camera from masks and depth images alone: for most
/// of its length the outline of an object is a step of depth, and a calibration is right where all
/// steps of all frames lie on outlines (docs/methods.md). Reads no truth and no colours.
/// One thread at a time.
class Calibrator {
 public:
  /// Throws Error on settings out of range.
  explicit Calibrator(const Calibration& start, const CalibratorSettings& settings = {});

  /// Takes a frame's masks and depth. Only frames whose motion is known tell a time offset. The
  /// oldest frame goes where there are more than `frames`. Throws Error when the
  /// frame believes in other cameras than the start.
  void add(const Sight& sight, const std::optional<FrameMotion>& motion = {});

  /// What the frames so far say. Same frames, same result, bit for bit.
  [[nodiscard]] CalibrationEstimate estimate() const;

 private:
  Calibration start_;
  CalibratorSettings settings_;
  std::deque<OutlineEvidence> frames_;
};

}  // namespace mapscore
