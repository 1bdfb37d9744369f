// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#pragma once

#include "eval/report/figures/style.hpp"

#include <cstddef>
#include <filesystem>
#include <string>
#include <vector>

namespace mapscore::eval {

/// One panel of a figure, in gnuplot's words.
struct Panel {
  std::string title, x_label, y_label;  ///< outside of the panel; empty where a neighbour says it
  bool y_tic_labels = true;
  std::vector<std::string> settings = {};  ///< "set ..." lines, valid for this panel only
  std::vector<std::string> elements = {};  ///< of `plot`; the data file is `data`; none: a gap
};

/// One entry of a figure's legend.
struct FigureKey {
  std::string plotting;  ///< `with` of `plot NaN with`
  std::string title;     ///< shortened where it is wider than the figure
};

/// A figure: panels in rows and columns, the legend and a caption below them.
struct FigureSheet {
  std::string name;  ///< of its files, without a suffix
  int columns = 1;
  double panel_width_in = 2.2, panel_height_in = 1.7;  ///< of the plotted area
  double x_tics_in = 0.16;                             ///< height of the labels of the x tics
  FigureStyle style;
  double least_panel_in = kLeastPanel_in;  ///< with a width in print fewer columns, not narrower
  bool to_scale = false;                   ///< in print keep the panel's height to its width
  std::vector<Panel> panels;               ///< row by row; the last row may be short
  std::vector<FigureKey> legend;
  std::string caption;  ///< wrapped to the width
  std::string data;     ///< text of the data file
  int blocks = 0;       ///< of the data

  /// Starts a block of the data file; returns `data index N`.
  std::string start_block(const std::string& what, const std::string& names);
  void add_legend(const std::string& plotting, const std::string& title);
};

/// Makes a folder where it is not there. Throws Error.
void make_folder(const std::filesystem::path& folder);

/// Writes NAME.gp and NAME.dat, runs gnuplot for NAME.png, .pdf and .svg, aside, and moves all five
/// into `folder`, which is made where it is not there. Returns the three pictures. Throws Error,
/// and leaves nothing new, when gnuplot is missing, fails (with its own words) or leaves a picture
/// cut short, or the folder cannot be made.
[[nodiscard]] std::vector<std::filesystem::path> draw(const FigureSheet& sheet,
                                                      const std::filesystem::path& folder);

}  // namespace mapscore::eval
