// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#pragma once

#include "eval/report/figures/layout.hpp"
#include "eval/report/figures/script.hpp"
#include "eval/report/summary.hpp"

namespace mapscore::eval {

/// Precision against recall while the threshold falls, a line a curve, with a mark at the threshold
/// that the study works with; pooled over the detected classes and seeds. A panel a value of the
/// first axis (of more than three numbers the least, middle and greatest), at the middle of the
/// second. A block of the data file is one line, `recall precision threshold`, or the mark on it.
[[nodiscard]] FigureSheet precision_recall_figure(const StudySummary& summary,
                                                  const StudyLayout& layout);

/// Reliability diagram: the share of true voxels against their mean probability, by bins of a
/// tenth, with the diagonal; below it the share of voxels in each bin. Panels as above. A block of
/// the data file is one line: `low high voxels share_of_voxels mean_probability share_true`.
[[nodiscard]] FigureSheet reliability_figure(const StudySummary& summary,
                                             const StudyLayout& layout);

}  // namespace mapscore::eval
