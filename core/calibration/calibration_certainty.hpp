// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#pragma once

#include "core/calibration/calibration_correction.hpp"
#include "core/calibration/calibration_search.hpp"
#include "core/calibration/outline_evidence.hpp"

#include <Eigen/Core>
#include <deque>
#include <string>
#include <vector>

namespace mapscore {

/// How well a correction is known.
struct CalibrationCertainty {
  CalibrationCorrection::Matrix covariance = CalibrationCorrection::Matrix::Zero();
  /// Greatest over least eigenvalue of the normal equations, all numbers in pixels.
  double condition = 0;
  std::string weakest;    ///< the direction that is known least, in words (weakest_direction)
  double weakest_px = 0;  ///< its standard deviation, px
  double objects = 0;     ///< outlines that tell as much as all do: of equal ones their number
  std::vector<double> information;  ///< by frame: share of what is known of that direction
  /// By frame: what the correction would be without it, to first order.
  std::vector<CalibrationCorrection> without;
};

/// Of a correction that solves the equations with Welsch weights of `sigma_px`. An estimate of
/// mask outlines that waver solves sum(w r J) = 0, whose derivative A is measured by differences
/// over steps of 0.4 sigma, since weights, facing and gradients change with the correction too.
/// What errs together is one error, whatever its number of pixels: an outline, which is an object's
/// in one frame, and in all frames that show it unmoved (OutlineEvidence::repeated_in), as those of
/// a robot that stands. With N and g its normal matrix and gradient and H the sum of all N,
///
///     covariance = 0.4 sum(d d^T) + 0.5 p/n s^2 A^-1 H A^-T
///     d = A^-1 H (H - N)^-1 g, the change without one outline
///     s^2 = sum(g^T H^-1 g) / sum(tr(H^-1 N) - tr((H^-1 N)^2))
///
/// of p numbers from n outlines. The first sum is the jackknife of clusters (R. M. Bell, D. F.
/// McCaffrey, Survey Methodology 28, 2002), which is too wide where outlines are many and says
/// little where they are few; there the second, one variance for all, steadies it. The factors
/// are measured (docs/methods.md), not derived. The covariance is not finite, or huge, where one
/// outline alone tells some number. `free`: 1 for the numbers that were looked for. Numbers count
/// as pixels that they move outlines by, by `pixels`.
[[nodiscard]] CalibrationCertainty certainty_of(const std::deque<OutlineEvidence>& frames,
                                                const CalibrationCorrection& correction,
                                                float sigma_px,
                                                const CalibrationCorrection::Vector& free,
                                                const CalibrationCorrection::Vector& pixels);

}  // namespace mapscore
