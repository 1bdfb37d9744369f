// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#pragma once

#include "eval/report/axes.hpp"
#include "eval/report/figures/style.hpp"
#include "eval/report/summary.hpp"

#include <cstddef>
#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace mapscore::eval {

/// A line of a figure: one method, and one value of every swept axis from the third on.
struct Curve {
  std::string name;  ///< "direct", "direct, N = 10"
  std::string method;
  std::size_t tail = 0;  ///< position in the product of the axes from the third on
  std::string colour;    ///< #rrggbb of Okabe and Ito's palette, made for colour-blind readers too
  int point = 7;         ///< gnuplot's point type
  std::string dash = "1";  ///< gnuplot's dash type

  /// "lw 1.4 dt 1 lc rgb '#0072B2'".
  [[nodiscard]] std::string line() const;
  /// Of its marks: "pt 7 ps 0.8 lw 0.5 lc rgb '#0072B2'", a thin line, since gnuplot's PDF notches
  /// discs and cuts the corners of triangles that are drawn with a broad one.
  [[nodiscard]] std::string mark(double size) const;
  /// Element of `plot`: `data` ("data index 0 using 1:2") as the line and the marks on it.
  [[nodiscard]] std::string marked_line(const std::string& data, double size) const;
  /// Of `linespoints`, for the legend.
  [[nodiscard]] std::string legend() const;
};

/// The n-th colour of the figures: #rrggbb of Okabe and Ito's palette, over again after seven.
[[nodiscard]] std::string palette_colour(std::size_t n);

/// The n-th curve of a figure that has one for each method, by its title.
[[nodiscard]] Curve curve_of(const Study& study, const std::string& method, std::size_t n,
                             const FigureStyle& style);

/// Which trial stands where in the figures of a study: x, column of panels, curve.
class StudyLayout {
 public:
  explicit StudyLayout(const StudySummary& summary, const FigureStyle& style = {});

  [[nodiscard]] const FigureStyle& style() const { return style_; }

  /// The first swept axis; the methods when nothing is swept.
  [[nodiscard]] const FigureAxis& x() const { return x_; }
  /// The second swept axis, whole; nothing where there is none.
  [[nodiscard]] const std::optional<FigureAxis>& second() const { return second_; }
  /// Heads of the columns of panels: values of the second axis, or one empty text. In print, of
  /// numbers that have no room side by side, as many from the least to the greatest as have.
  [[nodiscard]] const std::vector<std::string>& columns() const { return columns_; }
  [[nodiscard]] const std::vector<Curve>& curves() const { return curves_; }
  /// Nothing is swept: a bar a method.
  [[nodiscard]] bool bars() const { return bars_; }
  /// The first swept axis has names, not numbers: nothing lies between two of its values.
  [[nodiscard]] bool named() const { return !bars_ && !x_.numeric; }
  /// "STEM_by_dose", or by what runs along x: "STEM_by_method", "STEM_by_source".
  [[nodiscard]] std::string figure_name(const std::string& stem) const;

  /// Position in StudySummary::trials (and in its ceilings), if that curve has a point there.
  [[nodiscard]] std::optional<std::size_t> trial(const Curve& curve, std::size_t column,
                                                 std::size_t x) const;
  /// The same at a value of the second axis.
  [[nodiscard]] std::optional<std::size_t> trial_at(const Curve& curve, std::size_t value,
                                                    std::size_t x) const;
  /// The same with that many columns of panels at most, from the least to the greatest; one: the
  /// middle.
  [[nodiscard]] StudyLayout with_columns(std::size_t most) const;
  /// What a caption says of values that have no column; else empty.
  [[nodiscard]] std::string columns_caption() const;

 private:
  FigureStyle style_;
  FigureAxis x_;
  std::optional<FigureAxis> second_;
  std::vector<std::string> columns_{""};
  std::vector<std::size_t> shown_{0};  ///< value of the second axis of each column
  std::vector<Curve> curves_;
  bool bars_ = false;
  std::size_t tails_ = 1;
  std::map<std::pair<std::string, std::size_t>, std::size_t> trials_;  ///< by method and cell
};

/// Between two numbers at an axis of that length: 1, 2 or 5 times a power of ten, so that there are
/// at most five of them, or three along a narrow panel.
[[nodiscard]] double tic_step(double range, double length_in);

/// Names along the x axis of a panel.
struct NameTics {
  std::string setting;     ///< `set xtics ...`
  double height_in = 0.0;  ///< of the labels, for FigureSheet::x_tics_in
};

/// The names at 0, 1, 2, ... of a panel, where each has `place_in` of its width: on one line where
/// all fit, or else broken between words, or else turned.
[[nodiscard]] NameTics name_tics(const std::vector<std::string>& names, double place_in,
                                 const FigureStyle& style = {});

}  // namespace mapscore::eval
