// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#pragma once

#include "eval/report/figures/script.hpp"
#include "eval/report/figures/style.hpp"
#include "eval/report/summary.hpp"

#include <utility>
#include <vector>

namespace mapscore::eval {

/// Of a study whose points lie over ranges (Sampling): precision, recall and F1 at tolerance 0 of
/// the pooled classes, a column each (F1 alone where print has no room for three), over every swept
/// path, a row each; a mark a point of the study and method. Among them the running mean of
/// neighbouring points, or of each value that points share, as of names. A block of the data file
/// is `x value` of one method in one panel, its marks or its means; an undefined score is left out.
[[nodiscard]] FigureSheet scatter_figure(const StudySummary& summary,
                                         const FigureStyle& style = {});

/// (mean x, mean y) of each `window` neighbours along x; fewer points than that have none.
[[nodiscard]] std::vector<std::pair<double, double>> running_mean(
    std::vector<std::pair<double, double>> points, std::size_t window);

}  // namespace mapscore::eval
