// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#pragma once

#include "eval/statistics/dose_fit.hpp"
#include "eval/statistics/tolerance.hpp"

#include <cstddef>
#include <optional>
#include <vector>

namespace mapscore::eval {

// Where the search for a tolerance looks (docs/tolerance.md, "Stages"). Points are ordered by dose.

/// Degree of the curve through a window.
inline constexpr int kDoseDegree = 2;
/// Fewest points of a window.
inline constexpr std::size_t kLeastPoints = 8;

/// Where a fine stage looks.
struct DoseFocus {
  double centre = 0.0, half_width = 0.0;
};

/// The most points about a focus through which a curve holds.
struct DoseWindow {
  std::vector<DosePoint> points;
  bool bent = false;             ///< no curve holds, even through the fewest
  std::optional<DoseStep> step;  ///< of a bent window
};

/// The focus after the first stage; at least one point.
[[nodiscard]] DoseFocus first_focus(const ToleranceSearch& search,
                                    const std::vector<DosePoint>& points);

/// The window of `points` (at least kLeastPoints, of four doses) about a focus.
[[nodiscard]] DoseWindow window_about(const DoseFocus& focus, const std::vector<DosePoint>& points,
                                      double target);

/// The focus after a further stage, by all points so far: as wide as the scatter asks for;
/// closer to where the points cross the target when the window's curve does not hold or surely does
/// not cross it.
[[nodiscard]] DoseFocus refined(const ToleranceSearch& search, const DoseFocus& focus,
                                const std::vector<DosePoint>& points);

}  // namespace mapscore::eval
