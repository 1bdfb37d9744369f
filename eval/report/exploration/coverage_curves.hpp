// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#pragma once

#include "eval/explore/exploration_summary.hpp"
#include "eval/report/figures/script.hpp"

#include <vector>

namespace mapscore::eval {

/// Coverage and F1 over metres, and coverage over time, from top to bottom; a column a scene. A
/// line is the mean over the starts, a band its spread: 95 % interval, or least and greatest of
/// fewer than ten. An exploration that has ended keeps what it has. A block of the data file is one
/// line: `x mean low high`.
[[nodiscard]] FigureSheet exploration_curves(const Study& study,
                                             const std::vector<ExplorationGroup>& groups,
                                             const FigureStyle& style = {});

}  // namespace mapscore::eval
