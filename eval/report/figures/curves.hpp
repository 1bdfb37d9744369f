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

/// What one panel of curves shows.
struct CurvePanel {
  std::string group;  ///< of StudySummary::groups()
  std::string metric;
  std::size_t column = 0;  ///< of StudyLayout::columns()
  std::string title, y_label;
  bool x_title = true, y_tic_labels = true;
};

/// Collects panels of curves over the x axis, with spread and ceilings: lines over numbers, points
/// side by side over names, bars over methods. A block of the data file is one curve of one panel:
/// `x value low high registration_ceiling lattice_ceiling`, `-` where undefined.
class CurveFigure {
 public:
  CurveFigure(const StudySummary& summary, const StudyLayout& layout, std::string name,
              int columns);

  void add(const CurvePanel& panel);
  /// The figure; `y` reaches from the least figure in it, or 0 for bars, to 1.
  [[nodiscard]] FigureSheet finish(std::string caption);

 private:
  struct Block {
    std::string ceiling[2];  ///< texts of the columns of ceilings, to draw equal ones once
  };
  [[nodiscard]] Block add_block(const CurvePanel& panel, const Curve& curve);
  [[nodiscard]] std::vector<std::string> x_settings();
  [[nodiscard]] std::vector<std::string> legend() const;

  const StudySummary& summary_;
  const StudyLayout& layout_;
  FigureSheet sheet_;
  int blocks_ = 0;
  double least_ = 1.0;
};

/// A figure in the data file: `-` where undefined.
[[nodiscard]] std::string figure_number(const std::optional<double>& value);

/// What every figure of a study says below: scene, voxels, detected set, seeds.
[[nodiscard]] std::string study_caption(const StudySummary& summary);
/// What the bars of spread are; nothing for one seed.
[[nodiscard]] std::string spread_caption(const Study& study, const char* marks = "Bars");

}  // namespace mapscore::eval
