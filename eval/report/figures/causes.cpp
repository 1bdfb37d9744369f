// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#include "eval/report/colours.hpp"
#include "eval/report/figures/curves.hpp"
#include "eval/report/figures/figures.hpp"
#include "eval/report/figures/geometry.hpp"
#include "files/text.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

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

/// Of the causes of a side without colours.
constexpr std::array<const char*, 3> kGreys{"#404040", "#A0A0A0", "#E8E8E8"};
/// Height of a line of the second axis' value over that of the lowest panel.
constexpr double kHeadRow = 0.135;

std::string hex_of(const Colour& colour) {
  return fmt::format("#{:02X}{:02X}{:02X}", colour.r, colour.g, colour.b);
}

class CauseFigure {
 public:
  CauseFigure(const StudySummary& summary, const StudyLayout& layout)
      : summary_(summary), layout_(layout) {
    sheet_.name = layout.figure_name("causes");
    sheet_.columns = layout.bars() ? 1 : static_cast<int>(layout.curves().size());
    sheet_.style = layout.style();
    sheet_.least_panel_in = kLeastInRow_in;
    sheet_.panel_width_in =
        layout.bars() && !sheet_.style.width_mm
            ? 4.0
            : sheet_.style.panel_width_in(sheet_.columns, sheet_.least_panel_in);
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
        sheet_.add_legend(fmt::format("boxes {} {}", fill(), ink(side, cause)), cause.name);
    sheet_.caption = study_caption(summary_) + layout_.columns_caption() +
                     " Counts pooled over classes and seeds. near: within a voxel of the own "
                     "surface; leak: on another surface; floating: elsewhere. mislabelled: another "
                     "class is predicted there; unlabelled: in the map below the threshold; "
                     "unmapped: not in the map.";
    return std::move(sheet_);
  }

 private:
  [[nodiscard]] const char* fill() const {
    return sheet_.style.grey ? "fs solid 1 border lc rgb '#000000'" : "fs solid 1 noborder";
  }

  [[nodiscard]] std::string ink(const Side& side, const Cause& cause) const {
    if (!sheet_.style.grey) return "lc rgb '" + hex_of(cause.colour) + "'";
    return fmt::format("lw 0.5 lc rgb '{}'",
                       kGreys[static_cast<std::size_t>(&cause - side.causes.data())]);
  }

  /// One scale for all panels of a side; over 1, where shares end, only the label inside.
  [[nodiscard]] std::string y_settings(double greatest) const {
    const bool labelled = layout_.columns().size() > 1;
    double headroom = labelled ? 1.2 : 1.0;
    if (labelled && sheet_.style.width_mm)
      headroom = std::max(headroom, 1.0 / (0.93 - kHeadRow * head_rows_));
    const double top =
        std::clamp(std::ceil(20.0 * std::max(1.02, headroom) * greatest) / 20.0, 0.05, headroom);
    const double step = top > 0.5 ? 0.2 : top > 0.2 ? 0.1 : top > 0.1 ? 0.05 : 0.02;
    return fmt::format("set yrange [0:{:.2f}]; set ytics 0,{},1{}", top, step,
                       top > 1.0 ? "; set border 1; set arrow 1 from graph 0, first 0 to graph 0, "
                                   "first 1 nohead lc rgb '#444444' lw 0.7"
                                 : "");
  }

  /// The value of the second axis, in print broken to the panel's width.
  [[nodiscard]] std::string head_label(std::string head) {
    const double font_pt = sheet_.style.small_pt();
    if (sheet_.style.width_mm) {
      const auto lines = wrapped(head, sheet_.panel_width_in + kGap_in / 2, font_pt);
      head = fmt::to_string(fmt::join(lines, "\n"));
      head_rows_ = std::clamp(static_cast<double>(lines.size()), head_rows_, 4.0);
    }
    return fmt::format("set label 1 {} at graph 0.03,0.93 left font ',{}'", gnuplot_quoted(head),
                       font_pt);
  }

  void add_panel(const Side& side, std::size_t column, const std::vector<Curve>& curves,
                 const std::string& title, const std::string& y_label, bool last_row) {
    Panel panel{title, last_row && !layout_.bars() ? layout_.x().title() : "", y_label};
    add_block(side, column, curves);
    panel.settings = x_settings(sheet_, axis_of_names("", layout_.x().values), 1.0);
    panel.settings.insert(panel.settings.end(),
                          {"set style data histograms", "set style histogram rowstacked",
                           fmt::format("set style {}", std::string(fill()).replace(0, 2, "fill")),
                           "set boxwidth 0.75"});
    if (const std::string& head = layout_.columns()[column]; !head.empty())
      panel.settings.push_back(head_label(head));
    for (std::size_t c = 0; c < side.causes.size(); ++c)
      panel.elements.push_back(fmt::format("data index {} using {} {} notitle", sheet_.blocks - 1,
                                           c + 2, ink(side, side.causes[c])));
    sides_.push_back(side.whole == kSides.front().whole ? 0 : 1);
    sheet_.panels.push_back(std::move(panel));
  }

  void add_block(const Side& side, std::size_t column, const std::vector<Curve>& curves) {
    const std::string& head = layout_.columns()[column];
    std::string names = layout_.x().name;
    for (const Cause& cause : side.causes) names += fmt::format(" \"{}\"", cause.name);
    sheet_.start_block(
        fmt::format("{}; {}{}", curves.size() == 1 ? curves.front().name : "all methods",
                    side.label, head.empty() ? "" : "; " + head),
        names);
    for (std::size_t x = 0; x < layout_.x().at.size(); ++x)
      for (const Curve& curve : curves)
        if (const auto trial = layout_.trial(curve, column, x)) add_bar(side, x, *trial);
  }

  void add_bar(const Side& side, std::size_t x, std::size_t trial) {
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
  }

  const StudySummary& summary_;
  const StudyLayout& layout_;
  FigureSheet sheet_;
  std::vector<std::size_t> sides_;    ///< of each panel
  double head_rows_ = 0.0;            ///< most lines of a label inside
  std::array<double, 2> greatest_{};  ///< highest bar of each side
};

}  // namespace

FigureSheet causes_figure(const StudySummary& summary, const StudyLayout& layout) {
  const auto curves = static_cast<int>(layout.curves().size());
  const std::size_t most = layout.style().columns(curves, kLeastInRow_in) < curves ? 1 : 2;
  if (layout.style().width_mm && layout.columns().size() > most)  // or a page does not hold it
    return causes_figure(summary, layout.with_columns(most));
  CauseFigure figure(summary, layout);
  const std::size_t columns = layout.columns().size();
  for (std::size_t column = 0; column < columns; ++column)
    for (const Side& side : kSides)
      figure.add_row(side, column, column == 0 && &side == &kSides.front(),
                     column + 1 == columns && &side == &kSides.back());
  return figure.finish();
}

}  // namespace mapscore::eval
