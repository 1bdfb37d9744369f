// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#pragma once

#include "core/calibration/calibration_correction.hpp"

#include <string>

namespace mapscore {

/// The change of a correction that outlines tell least.
struct WeakestDirection {
  CalibrationCorrection::Vector by = CalibrationCorrection::Vector::Zero();  ///< 1 px of it
  double sigma_px = 0;   ///< its standard deviation; infinite where nothing tells it
  double condition = 0;  ///< greatest over least eigenvalue of the normal matrix, in pixels
  std::string words;     ///< such as "turn about y with shift along x"
};

/// The least known direction of the normal matrix, once the masks' size is solved for, where each
/// 20 edges have one error of `spread_px` (at least 0.5); or that of `covariance`, where it is
/// less certain there. `free`: 1 for the numbers that were looked for. `pixels`: what a unit of
/// each number moves outlines by.
[[nodiscard]] WeakestDirection weakest_direction(const CalibrationCorrection::Matrix& normal,
                                                 const CalibrationCorrection::Matrix& covariance,
                                                 const CalibrationCorrection::Vector& free,
                                                 const CalibrationCorrection::Vector& pixels,
                                                 double spread_px);

}  // namespace mapscore
