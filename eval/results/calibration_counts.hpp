// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#pragma once

#include "eval/score/metric.hpp"

#include <array>
#include <cstdint>

namespace mapscore::eval {

/// How a trial's estimated calibration came out, and what it is off the true one; added over
/// trials.
struct CalibrationCounts {
  std::int64_t calibrations = 0;          ///< estimates
  std::int64_t calibrations_refused = 0;  ///< of them; the believed calibration was kept
  /// Distance and angle between what the trial then believed of T_color_depth and the truth.
  std::int64_t calibration_error_um = 0, calibration_error_urad = 0;

  static auto counts() {
    return std::to_array<CountField<CalibrationCounts>>({
        {"calibrations", &CalibrationCounts::calibrations},
        {"calibrations_refused", &CalibrationCounts::calibrations_refused},
        {"calibration_error_um", &CalibrationCounts::calibration_error_um},
        {"calibration_error_urad", &CalibrationCounts::calibration_error_urad},
    });
  }
  bool operator==(const CalibrationCounts&) const = default;
};

}  // namespace mapscore::eval
