// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#include "eval/report/figures/tolerance_figure.hpp"

#include "eval/report/figures/curves.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <string>

namespace mapscore::eval {
namespace {

constexpr int kPointsOfCurve = 60;
constexpr double kLeastTolerance_in = 1.0;  ///< two have room in a column, with their numbers

/// Trials and curve of one search, and the marks of its answer.
class SearchMarks {
 public:
  SearchMarks(FigureSheet& sheet, Panel& panel, const ToleranceRow& row,
              const ToleranceLayout& layout)
      : sheet_(sheet),
        panel_(panel),
        row_(row),
        place_(layout.curve(row.method)),
        look_(layout.curves[place_]) {}

  void add() {
    add_answer();
    add_trials();
    if (row_.tolerance.curve) add_curve(*row_.tolerance.curve);
    if (row_.tolerance.step) add_step(*row_.tolerance.step);
  }

 private:
  [[nodiscard]] double in_unit(double dose) const { return dose * row_.axis.at.front(); }
  [[nodiscard]] std::string start(const char* what, const char* columns) {
    return sheet_.start_block(
        fmt::format("{}; {}; {}; {}", row_.axis.title(), row_.group, look_.name, what), columns);
  }

  void add_answer() {
    const Tolerance& of = row_.tolerance;
    if (const auto interval = interval_shown(row_))
      panel_.settings.push_back(fmt::format(
          "set object rectangle from first {:.9g}, graph 0 to first {:.9g}, graph 1 behind {}",
          interval->first, interval->second, band_fill(place_, look_.colour, sheet_.style)));
    if (of.dose)
      panel_.settings.push_back(fmt::format(
          "set arrow from first {0:.9g}, graph 0 to first {0:.9g}, graph 1 nohead back lw 1 dt {2} "
          "lc rgb '{1}'",
          in_unit(*of.dose), look_.colour, look_.dash));
  }

  void add_trials() {
    const std::string block = start("trials", "dose score seed");
    for (std::size_t seed = 0; seed < row_.trials.size(); ++seed)
      sheet_.data += fmt::format("{:.9g} {} {}\n", in_unit(row_.trials[seed].dose),
                                 figure_number(row_.trials[seed].score), seed);
    panel_.elements.push_back(
        fmt::format("{} using 1:2 with points {} notitle", block, look_.mark(0.8)));
  }

  void add_curve(const DoseCurve& curve) {
    const std::string block = start("curve", "dose score low high");
    const double first = row_.tolerance.points.front().dose;
    const double last = row_.tolerance.points.back().dose;
    for (int n = 0; n <= kPointsOfCurve; ++n) {
      const double dose = first + (last - first) * n / kPointsOfCurve, score = curve.at(dose);
      sheet_.data += fmt::format("{:.9g} {:.9g} {:.9g} {:.9g}\n", in_unit(dose), score,
                                 score - curve.half_width(dose), score + curve.half_width(dose));
    }
    panel_.elements.push_back(
        fmt::format("{} using 1:2 with lines {} notitle", block, look_.line()));
  }

  void add_step(const DoseStep& step) {
    const std::string block = start("step", "dose score");
    const double at = in_unit(*step.crossing.dose);
    sheet_.data +=
        fmt::format("{:.9g} {:.9g}\n{:.9g} {:.9g}\n{:.9g} {:.9g}\n{:.9g} {:.9g}\n",
                    in_unit(row_.tolerance.points.front().dose), step.above, at, step.above, at,
                    step.below, in_unit(row_.tolerance.points.back().dose), step.below);
    panel_.elements.push_back(
        fmt::format("{} using 1:2 with lines {} notitle", block, look_.line()));
  }

  FigureSheet& sheet_;
  Panel& panel_;
  const ToleranceRow& row_;
  std::size_t place_;  ///< of its curve
  const Curve& look_;
};

Panel panel_of(const std::string& title, const ToleranceAim& aim, const ToleranceRow& row) {
  return {title,
          row.axis.title(),
          (aim.target ? "" : "change of ") + metric_text(aim.metric, Reader::paper),
          true,
          {"unset object; unset arrow",
           fmt::format("set xrange [{:.9g}:{:.9g}]", row.search.low * row.axis.at.front(),
                       row.search.high * row.axis.at.front()),
           "set yrange [*:*]"},
          {fmt::format("{:.9g} with lines lw 0.8 dt (4,3) lc rgb '#444444' notitle",
                       row.search.target)}};
}

/// `set` lines of a panel: as many numbers as have room beside and below the trials of its rows.
std::string tics_of(const TolerancePanel& panel, double width_in) {
  const ToleranceRow& row = *panel.rows.front();
  double least = row.search.target, greatest = row.search.target;
  for (const ToleranceRow* other : panel.rows)
    for (const DoseTrial& trial : other->trials) {
      least = std::min(least, trial.score.value_or(least));
      greatest = std::max(greatest, trial.score.value_or(greatest));
    }
  const double doses = (row.search.high - row.search.low) * row.axis.at.front();
  return fmt::format("set xtics {:.9g}; set ytics {:.9g}", tic_step(doses, width_in),
                     tic_step(greatest - least, kNarrow_in));
}

}  // namespace

ToleranceLayout::ToleranceLayout(const Study& study, const std::vector<ToleranceRow>& rows,
                                 const FigureStyle& style) {
  const auto several = [&](std::string ToleranceRow::*name) {
    return std::ranges::any_of(
        rows, [&](const ToleranceRow& row) { return row.*name != rows.front().*name; });
  };
  const bool faults = several(&ToleranceRow::path), groups = several(&ToleranceRow::group);
  for (const ToleranceRow& row : rows) {
    const auto fits = [&](const TolerancePanel& panel) {
      return panel.rows.front()->path == row.path && panel.rows.front()->group == row.group;
    };
    auto panel = std::ranges::find_if(panels, fits);
    if (panel == panels.end()) {
      const std::string group = groups ? class_title(study, row.group) : "";
      panels.push_back({(faults ? row.axis.name : "") + (faults && groups ? ", " : "") + group});
      panel = panels.end() - 1;
    }
    panel->rows.push_back(&row);
    if (std::ranges::find(curves, row.method, &Curve::method) == curves.end())
      curves.push_back(curve_of(study, row.method, curves.size(), style));
  }
}

std::size_t ToleranceLayout::curve(const std::string& method) const {
  return static_cast<std::size_t>(std::ranges::find(curves, method, &Curve::method) -
                                  curves.begin());
}

FigureSheet ToleranceLayout::sheet(const std::string& name, const FigureStyle& style,
                                   double least_panel_in, double gap_in) const {
  FigureSheet sheet;
  sheet.name = name;
  sheet.style = style;
  sheet.least_panel_in = least_panel_in;
  sheet.columns = static_cast<int>(std::min<std::size_t>(3, panels.size()));
  sheet.panel_width_in = style.panel_width_in(sheet.columns, least_panel_in, gap_in);
  for (const Curve& curve : curves) sheet.add_legend(curve.legend(), curve.name);
  return sheet;
}

std::optional<std::pair<double, double>> interval_shown(const ToleranceRow& row) {
  const Tolerance& of = row.tolerance;
  if (of.verdict != ToleranceVerdict::found && of.verdict != ToleranceVerdict::open)
    return std::nullopt;
  const double unit = row.axis.at.front();
  return std::pair(of.low.value_or(row.search.low) * unit,
                   of.high.value_or(row.search.high) * unit);
}

FigureSheet tolerance_figure(const Study& study, const ToleranceAim& aim,
                             const std::vector<ToleranceRow>& rows, const FigureStyle& style) {
  const ToleranceLayout layout(study, rows, style);
  FigureSheet sheet = layout.sheet("tolerance", style, kLeastTolerance_in, kGapWithNumbers_in);
  for (const TolerancePanel& shown : layout.panels) {
    Panel panel = panel_of(shown.title, aim, *shown.rows.front());
    if (sheet.panels.size() % static_cast<std::size_t>(sheet.columns) != 0) panel.y_label.clear();
    for (const ToleranceRow* row : shown.rows) SearchMarks(sheet, panel, *row, layout).add();
    panel.settings.push_back(tics_of(shown, sheet.panel_width_in));
    sheet.panels.push_back(std::move(panel));
  }
  sheet.add_legend("lines lw 0.8 dt (4,3) lc rgb '#444444'", "target");
  sheet.caption = fmt::format(
      "{}: largest dose at which {}, voxels of {:.6g} cm. Points: trials, each of its own seed; "
      "curve: what the tolerance is read from; vertical line and band: tolerance and its 95 % "
      "interval, to the end of the range where it is open.",
      study.name, aim.text(), 100.0 * study.voxel_m);
  return sheet;
}

}  // namespace mapscore::eval
