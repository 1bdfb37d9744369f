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

/// A y axis from 0 to what a panel's values and spreads need.
struct OwnAxis {
  double least_top = 0.0;                          ///< to which it reaches in any case
  std::optional<double> dashed_at = std::nullopt;  ///< a line across the panel
};

/// What one panel of curves shows.
struct CurveScore {
  std::string group;  ///< of StudySummary::groups()
  std::string metric;
  std::string title;      ///< above its panel, where scores stand side by side
  std::string row_title;  ///< left of its row, where it has one
  /// Of a figure whose panels share no axis, which has no ceilings.
  std::optional<OwnAxis> own_axis = std::nullopt;
};

/// Curves over the x axis, with spread and ceilings: lines over numbers, points side by side over
/// names, bars over methods. A row a score, a column a value of the second axis; where there is
/// none, three scores a row, with `y_label` left of it. The scores' `y` reaches from the least
/// figure, or 0 for bars, to 1. A block of the data file is one curve of one panel: `x value low
/// high registration_ceiling lattice_ceiling`, `-` where undefined.
[[nodiscard]] FigureSheet curve_figure(const StudySummary& summary, const StudyLayout& layout,
                                       const std::string& stem,
                                       const std::vector<CurveScore>& scores,
                                       const std::string& y_label, const std::string& caption);

inline constexpr const char* kCeilingsCaption =
    "Lattice ceiling: true labels on the depth pixels, true pose. Registration ceiling: the same "
    "method with every fault at zero.";

/// `set` lines of the x axis of a panel: of numbers, or of names with so many of their places,
/// which are 1 wide, beside the first and the last. Makes room for the names in the sheet.
[[nodiscard]] std::vector<std::string> x_settings(FigureSheet& sheet, const FigureAxis& x,
                                                  double padding);

/// `set` line of an axis of scores from the least one to 1.
[[nodiscard]] std::string score_settings(double least);

/// A figure in the data file: `-` where undefined.
[[nodiscard]] std::string figure_number(const std::optional<double>& value);

/// What every figure of a study says below: scene, voxels, detected set, seeds.
[[nodiscard]] std::string study_caption(const StudySummary& summary);
/// What the bars of spread are; nothing for one seed.
[[nodiscard]] std::string spread_caption(const Study& study, const char* marks = "Bars");

}  // namespace mapscore::eval
