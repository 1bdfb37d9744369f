// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#pragma once

#include "eval/report/figures/script.hpp"

#include <string>
#include <vector>

namespace mapscore::eval {

/// Of titles, axes and the legend.
inline constexpr double kFont_pt = 8.0, kTitle_pt = 7.5;
inline constexpr double kPointsPerInch = 72.0;

/// Width of so many letters of the figures' font, by the mean letter of DejaVu Sans, which is wide.
[[nodiscard]] double text_width_in(std::size_t letters, double font_pt);
/// The words of a text in lines of that width; longer words are broken.
[[nodiscard]] std::vector<std::string> wrapped(const std::string& text, double width_in,
                                               double font_pt);

/// The text, where it is wider than that, with an ellipsis in the place of its middle.
[[nodiscard]] std::string shortened(const std::string& text, double width_in, double font_pt);

/// The sheet as its style's width asks: as many columns of panels as fit, those that do not below,
/// with their titles and axes, and texts broken to the room they have. Without a width the sheet.
/// In both no entry of the legend is wider than the sheet.
[[nodiscard]] FigureSheet arranged(const FigureSheet& sheet);

/// Where everything lies on an arranged sheet, which must outlive it. Lengths in inches from the
/// low left corner, places as shares of the sheet.
class Geometry {
 public:
  explicit Geometry(const FigureSheet& sheet);

  [[nodiscard]] double width_in() const { return width_in_; }
  [[nodiscard]] double height_in() const;
  [[nodiscard]] const std::vector<std::string>& caption() const { return caption_; }
  [[nodiscard]] int legend_rows() const { return legend_rows_; }
  /// gnuplot's margins of a panel.
  [[nodiscard]] std::string margins(int panel) const;
  /// Height of the middle of a panel's x label.
  [[nodiscard]] double x_label(int panel) const;
  [[nodiscard]] std::string legend_margins() const;
  /// Height of a line of the caption.
  [[nodiscard]] double caption_line(std::size_t line) const;

 private:
  [[nodiscard]] double bottom_in(int row) const;  ///< of the plotted area of a row's panels
  [[nodiscard]] double caption_in() const;
  [[nodiscard]] double below_in() const;
  [[nodiscard]] double x_label_in() const;
  [[nodiscard]] double row_gap_in() const;
  [[nodiscard]] bool has_titles_inside() const;
  [[nodiscard]] bool has_x_labels_inside() const;
  [[nodiscard]] std::string margins(double left, double right, double bottom, double top) const;

  const FigureSheet& sheet_;
  int rows_, legend_rows_ = 0;
  double title_rows_in_, x_label_rows_in_;  ///< of second and further lines
  double title_gap_in_, x_gap_in_, width_in_;
  std::vector<std::string> caption_;
};

}  // namespace mapscore::eval
