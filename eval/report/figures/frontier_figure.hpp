// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#pragma once

#include "eval/report/figures/script.hpp"
#include "eval/report/tolerance_report.hpp"

#include <vector>

namespace mapscore::eval {

/// A panel a fault and group, a line a method: the tolerance of the fault over the doses of the
/// second one, which together cost just what the aim allows, with its interval_shown as a bar. A
/// triangle at an end of the range: the tolerance lies beyond it. Methods whose bars would cover
/// each other at a dose stand side by side there, within a millimetre of paper. Every row has a
/// second fault. A block of the data file is one line (`second tolerance low high aside`) or its
/// triangles (`second above below aside`), in the units of the axes.
[[nodiscard]] FigureSheet frontier_figure(const Study& study, const ToleranceAim& aim,
                                          const std::vector<ToleranceRow>& rows,
                                          const FigureStyle& style = {});

}  // namespace mapscore::eval
