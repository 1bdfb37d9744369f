// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#pragma once

#include "core/calibration/calibration_correction.hpp"
#include "core/calibration/outline_evidence.hpp"

#include <deque>
#include <vector>

namespace mapscore {

/// Which numbers of a correction are looked for: 1 or 0.
using FreeNumbers = CalibrationCorrection::Vector;

/// What a start tells of the numbers of a correction, as the diagonal of normal equations with
/// residuals of `sigma_px`: next to nothing, but where edges tell nothing it decides.
[[nodiscard]] CalibrationCorrection::Vector start_information(float sigma_px);

/// Gauss-Newton on the pooled equations with the weights of the last step (Welsch), pulled weakly
/// to no correction. `edges`: how many are used at most, of all frames together.
[[nodiscard]] CalibrationCorrection refined(const std::deque<OutlineEvidence>& frames,
                                            CalibrationCorrection from, float sigma_px, int steps,
                                            std::size_t edges, const FreeNumbers& free);

/// The corrections that a search over turns and shifts finds best, apart from each other, the best
/// first. Turns up to `turn_rad` about the image's axes and half of it about the view, shifts up to
/// `shift_m` in the image plane, at each of `times_s` between the streams.
[[nodiscard]] std::vector<CalibrationCorrection> searched(const std::deque<OutlineEvidence>& frames,
                                                          double turn_rad, double shift_m,
                                                          double focal_px,
                                                          const std::vector<double>& times_s,
                                                          std::size_t most);

/// Root mean square of the residuals of the edges that lie near outlines, px; 0 without any.
[[nodiscard]] double spread_px(const OutlineEvidence& frame,
                               const CalibrationCorrection& correction, float sigma_px);

/// Share of all outlines that edges explain.
[[nodiscard]] double explained_share(const std::deque<OutlineEvidence>& frames,
                                     const CalibrationCorrection& correction, float sigma_px);

}  // namespace mapscore
