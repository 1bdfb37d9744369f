// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#pragma once

#include "core/geometry/camera.hpp"
#include "core/geometry/pose.hpp"

#include <Eigen/Core>
#include <optional>

namespace mapscore {

/// What may be wrong with a calibration, as the error of a start: turn and shift of the depth
/// camera in the colour camera's optical frame, the colour camera's focal length and principal
/// point, the time between the streams, and the size of the masks, which is no calibration but
/// moves outlines too.
struct CalibrationCorrection {
  /// Places of the numbers below in `vector()`.
  enum Axis { turn_x, turn_y, turn_z, shift_x, shift_y, shift_z, focal, centre_u, centre_v, time };
  static constexpr int kAxes = 10;      ///< of a calibration
  static constexpr int kMaskSize = 10;  ///< place of `offset_px`
  static constexpr int kNumbers = 11;
  using Vector = Eigen::Matrix<double, kNumbers, 1>;
  using Matrix = Eigen::Matrix<double, kNumbers, kNumbers>;

  Pose rigid = Pose::Identity();  ///< p_color = rigid * T_start_color_depth * p_depth
  double log_focal = 0;           ///< colour focal lengths are exp(log_focal) times those believed
  Eigen::Vector2d centre_px{0, 0};  ///< added to the colour camera's principal point
  double time_s = 0;  ///< the labels were seen this long after the depth image they are paired with
  double offset_px = 0;  ///< objects end this far beyond the outlines of their masks

  /// The correction after a small change: radians, metres, logarithm, pixels, seconds, pixels.
  [[nodiscard]] CalibrationCorrection changed(const Vector& by) const;
  /// As such a change of none.
  [[nodiscard]] Vector vector() const;
  /// The start, corrected; `time_s` and `offset_px` are no part of it.
  [[nodiscard]] Calibration applied(const Calibration& start) const;
};

}  // namespace mapscore
