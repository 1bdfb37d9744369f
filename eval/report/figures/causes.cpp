// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#include "eval/report/colours.hpp"
#include "eval/report/figures/curves.hpp"
#include "eval/report/figures/figures.hpp"
#include "files/text.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

namespace mapscore::eval {
namespace {

struct Cause {
  const char* name;
  std::int64_t ClassCounts::*count;
  Colour colour;
};

/// One of the two sides of the score: what is wrong, and out of how many.
struct Side {
  const char* label;
  std::int64_t ClassCounts::*whole;
  std::array<Cause, 3> causes;
};

const std::array<Side, 2> kSides{
    Side{"false / predicted",
         &ClassCounts::predicted,
         {Cause{"false: near", &ClassCounts::false_near, kNearColour},
          Cause{"false: leak", &ClassCounts::false_leak, kLeakColour},
          Cause{"false: floating", &ClassCounts::false_floating, kFloatingColour}}},
    Side{"missed / visible",
         &ClassCounts::visible,
         {Cause{"missed: mislabelled", &ClassCounts::missed_mislabelled, kMislabelledColour},
          Cause{"missed: unlabelled", &ClassCounts::missed_unlabelled, kUnlabelledColour},
          Cause{"missed: unmapped", &ClassCounts::missed_unmapped, kMissedColour}}}};

std::string hex_of(const Colour& colour) {
  return fmt::format("#{:02X}{:02X}{:02X}", colour.r, colour.g, colour.b);
}

class CauseFigure {
 public:
  CauseFigure(const StudySummary& summary, const StudyLayout& layout)
      : summary_(summary), layout_(layout) {
    sheet_.name = layout.figure_name("causes");
    sheet_.columns = layout.bars() ? 1 : static_cast<int>(layout.curves().size());
    sheet_.panel_width_in = layout.bars() ? 4.0 : panel_width_in(sheet_.columns);
    sheet_.panel_height_in = 1.2;
  }

  void add_row(const Side& side, std::size_t column, bool first_row, bool last_row) {
    if (layout_.bars()) return add_panel(side, column, layout_.curves(), {}, side.label, last_row);
    for (const Curve& curve : layout_.curves()) {
      const bool first = &curve == &layout_.curves().front();
      add_panel(side, column, {curve}, first_row ? curve.name : "", first ? side.label : "",
                last_row);
      sheet_.panels.back().y_tic_labels = first;
    }
  }

  [[nodiscard]] FigureSheet finish() {
    for (std::size_t p = 0; p < sheet_.panels.size(); ++p)
      sheet_.panels[p].settings.push_back(y_settings(greatest_[sides_[p]]));
    for (const Side& side : kSides)
      for (const Cause& cause : side.causes)
        sheet_.add_legend("boxes fs solid 1 noborder lc rgb '" + hex_of(cause.colour) + "'",
                          cause.name);
    sheet_.caption = study_caption(summary_) +
                     " Counts pooled over classes and seeds. near: within a voxel of the own "
                     "surface; leak: on another surface; floating: elsewhere. mislabelled: another "
                     "class is predicted there; unlabelled: in the map below the threshold; "
                     "unmapped: not in the map.";
    return std::move(sheet_);
  }

 private:
  /// One scale for all panels of a side.
  [[nodiscard]] std::string y_settings(double greatest) const {
    const double headroom = layout_.columns().size() > 1 ? 1.2 : 1.02;  // for the label inside
    const double top = std::clamp(std::ceil(20.0 * headroom * greatest) / 20.0, 0.05, 1.2);
    return fmt::format("set yrange [0:{:.2f}]; set ytics {}", top,
                       top > 0.5   ? 0.2
                       : top > 0.2 ? 0.1
                       : top > 0.1 ? 0.05
                                   : 0.02);
  }

  /// Doses are written from the data file; names so that they have room.
  [[nodiscard]] std::string x_tics() {
    if (!layout_.named()) return "set xtics autofreq norotate";
    const auto places = static_cast<double>(layout_.x().values.size() + 1);
    const NameTics tics = name_tics(layout_.x().values, sheet_.panel_width_in / places);
    sheet_.x_tics_in = tics.height_in;
    return tics.setting;
  }

  void add_panel(const Side& side, std::size_t column, const std::vector<Curve>& curves,
                 const std::string& title, const std::string& y_label, bool last_row) {
    Panel panel{title, last_row && !layout_.bars() ? layout_.x().title() : "", y_label};
    const bool empty = add_block(side, column, curves) == 0;  // gnuplot finds no range by itself
    panel.settings = {
        "set style data histograms",
        "set style histogram rowstacked",
        "set style fill solid 1 noborder",
        "set boxwidth 0.75",
        empty ? fmt::format("set xrange [-1:{}]", layout_.x().values.size()) : "set xrange [*:*]",
        x_tics()};
    if (const std::string& head = layout_.columns()[column]; !head.empty())
      panel.settings.push_back(
          fmt::format("set label 1 {} at graph 0.03,0.93 left font ',6.5'", gnuplot_quoted(head)));
    for (std::size_t c = 0; c < side.causes.size(); ++c)
      panel.elements.push_back(
          fmt::format("data index {} using {}{} lc rgb '{}' notitle", sheet_.blocks - 1, c + 2,
                      layout_.named() ? "" : ":xtic(1)", hex_of(side.causes[c].colour)));
    sides_.push_back(side.whole == kSides.front().whole ? 0 : 1);
    sheet_.panels.push_back(std::move(panel));
  }

  /// Returns how many bars have a height.
  std::size_t add_block(const Side& side, std::size_t column, const std::vector<Curve>& curves) {
    std::size_t bars = 0;
    const std::string& head = layout_.columns()[column];
    std::string names = layout_.x().name;
    for (const Cause& cause : side.causes) names += fmt::format(" \"{}\"", cause.name);
    sheet_.start_block(
        fmt::format("{}; {}{}", curves.size() == 1 ? curves.front().name : "all methods",
                    side.label, head.empty() ? "" : "; " + head),
        names);
    for (std::size_t x = 0; x < layout_.x().at.size(); ++x)
      for (const Curve& curve : curves)
        if (const auto trial = layout_.trial(curve, column, x)) bars += add_bar(side, x, *trial);
    return bars;
  }

  /// Whether the bar has a height: its whole is not 0.
  bool add_bar(const Side& side, std::size_t x, std::size_t trial) {
    const ClassCounts counts = pooled_counts(summary_.trials[trial], summary_.table);
    sheet_.data += gnuplot_column(layout_.x().values[x]);
    double height = 0.0;
    for (const Cause& cause : side.causes) {
      const auto share = ratio(counts.*cause.count, counts.*side.whole);
      height += share.value_or(0.0);
      sheet_.data += ' ' + figure_number(share);
    }
    sheet_.data += '\n';
    double& greatest = greatest_[side.whole == kSides.front().whole ? 0 : 1];
    greatest = std::max(greatest, height);
    return counts.*side.whole > 0;
  }

  const StudySummary& summary_;
  const StudyLayout& layout_;
  FigureSheet sheet_;
  std::vector<std::size_t> sides_;    ///< of each panel
  std::array<double, 2> greatest_{};  ///< highest bar of each side
};

}  // namespace

FigureSheet causes_figure(const StudySummary& summary, const StudyLayout& layout) {
  CauseFigure figure(summary, layout);
  const std::size_t columns = layout.columns().size();
  for (std::size_t column = 0; column < columns; ++column)
    for (const Side& side : kSides)
      figure.add_row(side, column, column == 0 && &side == &kSides.front(),
                     column + 1 == columns && &side == &kSides.back());
  return figure.finish();
}

}  // namespace mapscore::eval
