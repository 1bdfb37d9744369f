// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#pragma once

#include "eval/report/figures/layout.hpp"
#include "eval/report/figures/script.hpp"
#include "eval/report/summary.hpp"

namespace mapscore::eval {

/// Stacked bars: false voxels by cause over the predicted ones, missed voxels by cause over the
/// visible ones, pooled over the detected classes and seeds. A column a curve, two rows a value of
/// the second axis.
[[nodiscard]] FigureSheet causes_figure(const StudySummary& summary, const StudyLayout& layout);

}  // namespace mapscore::eval
