// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#pragma once

#include "eval/report/figures/layout.hpp"
#include "eval/report/figures/script.hpp"
#include "eval/report/tolerance_report.hpp"

#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace mapscore::eval {

/// The answers for a fault and group.
struct TolerancePanel {
  std::string title;  ///< what tells it from the other panels: fault, group, both; alone nothing
  std::vector<const ToleranceRow*> rows = {};
};

/// How answers stand in a figure: a panel a fault and group, a curve a method, in their order.
/// Views the rows.
struct ToleranceLayout {
  ToleranceLayout(const Study& study, const std::vector<ToleranceRow>& rows,
                  const FigureStyle& style);

  std::vector<TolerancePanel> panels;
  std::vector<Curve> curves;

  /// Position of the method's curve.
  [[nodiscard]] std::size_t curve(const std::string& method) const;
  /// Without panels yet, at most three in a row, with the curves in its legend.
  [[nodiscard]] FigureSheet sheet(const std::string& name, const FigureStyle& style,
                                  double least_panel_in = kLeastPanel_in,
                                  double gap_in = kGap_in) const;
};

/// Ends of a tolerance's interval in the unit of the axis, of an open side the end of the range;
/// nothing where the verdict is neither `found` nor `open`.
[[nodiscard]] std::optional<std::pair<double, double>> interval_shown(const ToleranceRow& row);

/// A panel a fault and group, a colour (or mark and line style) a method: the score of every trial
/// over the dose, the curve that the tolerance was read from, the target as a dashed line, the
/// tolerance as a vertical line and its interval_shown as a band. A block of the data file is the
/// trials of one search (`dose score seed`) or its curve (`dose score low high`), doses in the unit
/// of the axis.
[[nodiscard]] FigureSheet tolerance_figure(const Study& study, const ToleranceAim& aim,
                                           const std::vector<ToleranceRow>& rows,
                                           const FigureStyle& style = {});

}  // namespace mapscore::eval
