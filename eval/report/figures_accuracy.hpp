// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#pragma once

#include "eval/report/figures_layout.hpp"
#include "eval/report/figures_script.hpp"
#include "eval/report/summary.hpp"

#include <optional>

namespace mapscore::eval {

/// Precision, recall and F1 at tolerance 0, and by distance, pooled over the detected classes.
[[nodiscard]] FigureSheet accuracy_figure(const StudySummary& summary, const StudyLayout& layout);

/// F1 of each detected class; nothing where there is only one. Of more than twelve those with most
/// visible voxels are shown.
[[nodiscard]] std::optional<FigureSheet> class_figure(const StudySummary& summary,
                                                      const StudyLayout& layout);

}  // namespace mapscore::eval
