// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#pragma once

#include "core/calibration/calibrator.hpp"

#include <string>
#include <vector>

namespace mapscore::eval {

/// The first lines for a reader: the verdict, why, and how well the estimate is known.
[[nodiscard]] std::string calibration_summary(const CalibrationEstimate& estimate);

/// A line for each number that was looked for: its change and its standard deviation, in degrees,
/// millimetres, percent, pixels and milliseconds.
[[nodiscard]] std::string calibration_numbers(const CalibrationEstimate& estimate);

/// A line for each frame: what it contributed. `names`: what the frames are called.
[[nodiscard]] std::string calibration_frames(const CalibrationEstimate& estimate,
                                             const std::vector<int>& names);

/// The section `estimate` of a calibration file (docs/formats.md), from its key on: how `start` was
/// changed and how well that is known.
[[nodiscard]] std::string estimate_yaml(const CalibrationEstimate& estimate,
                                        const Calibration& start);

}  // namespace mapscore::eval
