// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#pragma once

#include <cstddef>
#include <optional>
#include <string>

namespace mapscore::eval {

/// Left of the first column of panels, right of the last and between two, in inches.
inline constexpr double kLeft_in = 0.62, kRight_in = 0.12, kGap_in = 0.14;
/// The same where each panel has numbers of its own at its left.
inline constexpr double kGapWithNumbers_in = 0.42;

/// How the figures are set: as it stands here for the screen, with a width for print.
struct FigureStyle {
  std::optional<double> width_mm = {};  ///< of every figure; else as its panels need
  std::string font = "DejaVu Sans";
  bool caption = true;  ///< below the legend
  bool grey = false;    ///< no colours; line styles, marks and patterns instead

  /// Throws Error unless the width is from 60 to 400 mm and the font's name is of ASCII letters,
  /// digits, spaces, '-', '.' and '_', which no gnuplot script takes for anything else.
  void check() const;

  /// Size of notes, captions and names of tics: in print at least 7 pt.
  [[nodiscard]] double small_pt() const { return width_mm ? 7.0 : 6.5; }
  /// Of the PNG: of a screen, or of print.
  [[nodiscard]] double dots_per_inch() const { return width_mm ? 300.0 : 150.0; }

  /// How many of `asked` columns of panels stand side by side in the width, where none may be
  /// narrower than `least_in`, evenly over the rows; all of them without a width.
  [[nodiscard]] int columns(int asked, double least_in, double gap_in = kGap_in) const;
  /// In print, for the panels of a row and the gaps between them.
  [[nodiscard]] double page_in() const;
  /// Width of each of those panels' plotted area.
  [[nodiscard]] double panel_width_in(int asked, double least_in, double gap_in = kGap_in) const;
};

/// Panels of curves are no narrower in print; those that are read as a row may be.
inline constexpr double kLeastPanel_in = 1.1, kLeastInRow_in = 0.7;
/// A narrower panel has no room for five numbers below it.
inline constexpr double kNarrow_in = 1.4;

/// Of the n-th thing that differs: dark enough to stand on white, neighbours far apart.
[[nodiscard]] std::string grey_tone(std::size_t n);
/// gnuplot's dash type of the n-th curve without colours: eight before the first comes again, none
/// like a ceiling's.
[[nodiscard]] std::string grey_dash(std::size_t n);
/// gnuplot's fill style of the n-th kind of bar: in colour solid, else one of eight patterns.
[[nodiscard]] std::string bar_fill(std::size_t n, const FigureStyle& style);
/// Of the n-th band behind curves: faint in its curve's colour; without colours hatched, each of
/// six its own way, in one tone.
[[nodiscard]] std::string band_fill(std::size_t n, const std::string& colour,
                                    const FigureStyle& style);

/// A script with every `rgb '#rrggbb'` as the grey of its luma (ITU-R BT.601).
[[nodiscard]] std::string greyed(std::string script);

}  // namespace mapscore::eval
