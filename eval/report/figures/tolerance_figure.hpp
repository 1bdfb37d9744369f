// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#pragma once

#include "eval/report/figures/script.hpp"
#include "eval/report/tolerance_report.hpp"

#include <vector>

namespace mapscore::eval {

/// A panel a fault and group, a colour (or mark and line style) a method: the score of every trial
/// over the dose, the curve that the tolerance was read from, the target as a dashed line, the
/// tolerance as a vertical line and its interval as a band. A block of the data file is the trials
/// of one search
/// (`dose score seed`) or its curve (`dose score low high`), doses in the unit of the axis.
[[nodiscard]] FigureSheet tolerance_figure(const Study& study, const ToleranceAim& aim,
                                           const std::vector<ToleranceRow>& rows,
                                           const FigureStyle& style = {});

}  // namespace mapscore::eval
