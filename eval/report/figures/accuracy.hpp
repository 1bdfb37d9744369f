// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#pragma once

#include "eval/report/figures/layout.hpp"
#include "eval/report/figures/script.hpp"
#include "eval/report/summary.hpp"

#include <optional>
#include <string>
#include <vector>

namespace mapscore::eval {

/// Precision, recall and F1 at tolerance 0, and by distance, pooled over the detected classes.
[[nodiscard]] FigureSheet accuracy_figure(const StudySummary& summary, const StudyLayout& layout);

/// Detected classes with something to see, in the table's order; of more than twelve those with
/// most visible voxels.
[[nodiscard]] std::vector<const SemanticClass*> classes_shown(const StudySummary& summary);

/// Says that classes are left out, where some are.
[[nodiscard]] std::string cut_caption(const StudySummary& summary, std::size_t shown);

inline constexpr const char* kCeilingsCaption =
    "Lattice ceiling: true labels on the depth pixels, true pose. Registration ceiling: the same "
    "method with every fault at zero.";

/// F1 of each detected class, a panel each. Nothing for a single class, nor where the first axis
/// has names, for which class_bars_figure is drawn.
[[nodiscard]] std::optional<FigureSheet> class_figure(const StudySummary& summary,
                                                      const StudyLayout& layout);

}  // namespace mapscore::eval
