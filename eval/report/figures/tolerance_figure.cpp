// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#include "eval/report/figures/tolerance_figure.hpp"

#include "eval/report/figures/curves.hpp"
#include "eval/report/figures/layout.hpp"

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
  SearchMarks(FigureSheet& sheet, Panel& panel, const ToleranceRow& row, Curve curve)
      : sheet_(sheet), panel_(panel), row_(row), look_(std::move(curve)) {}

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

  /// A band open at one side reaches to the end of the range.
  void add_answer() {
    const Tolerance& of = row_.tolerance;
    if (of.low && of.high)
      panel_.settings.push_back(fmt::format(
          "set object rectangle from first {:.9g}, graph 0 to first {:.9g}, graph 1 behind fc rgb "
          "'{}' fs transparent solid 0.2 noborder",
          in_unit(*of.low), in_unit(*of.high), look_.colour));
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
        fmt::format("{} using 1:2 with points pt {} ps 0.35 lc rgb '{}' notitle", block,
                    look_.point, look_.colour));
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
  Curve look_;
};

Panel panel_of(const Study& study, const ToleranceAim& aim, const ToleranceRow& row) {
  return {class_title(study, row.group),
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
std::string tics_of(const ToleranceRow& row, const std::vector<ToleranceRow>& rows,
                    double width_in) {
  double least = row.search.target, greatest = row.search.target;
  for (const ToleranceRow& other : rows)
    if (other.path == row.path && other.group == row.group)
      for (const DoseTrial& trial : other.trials) {
        least = std::min(least, trial.score.value_or(least));
        greatest = std::max(greatest, trial.score.value_or(greatest));
      }
  const double doses = (row.search.high - row.search.low) * row.axis.at.front();
  return fmt::format("set xtics {:.9g}; set ytics {:.9g}", tic_step(doses, width_in),
                     tic_step(greatest - least, kNarrow_in));
}

}  // namespace

FigureSheet tolerance_figure(const Study& study, const ToleranceAim& aim,
                             const std::vector<ToleranceRow>& rows, const FigureStyle& style) {
  FigureSheet sheet;
  sheet.name = "tolerance";
  sheet.style = style;
  sheet.least_panel_in = kLeastTolerance_in;
  std::map<std::pair<std::string, std::string>, std::size_t> panels;  // by fault and group
  std::vector<const ToleranceRow*> firsts;                            // of each panel
  std::map<std::string, Curve> curves;                                // by method
  for (const ToleranceRow& row : rows) {
    const auto [panel, is_new] = panels.try_emplace({row.path, row.group}, sheet.panels.size());
    if (is_new) {
      sheet.panels.push_back(panel_of(study, aim, row));
      firsts.push_back(&row);
    }
    const auto [curve, is_new_method] =
        curves.try_emplace(row.method, curve_of(study, row.method, curves.size(), style));
    if (is_new_method)
      sheet.add_legend("linespoints " + curve->second.line_with_points(0.6), curve->second.name);
    SearchMarks(sheet, sheet.panels[panel->second], row, curve->second).add();
  }
  sheet.columns = static_cast<int>(std::min<std::size_t>(3, sheet.panels.size()));
  for (std::size_t n = 0; n < sheet.panels.size(); ++n)
    if (n % static_cast<std::size_t>(sheet.columns) != 0) sheet.panels[n].y_label.clear();
  sheet.panel_width_in =
      sheet.style.panel_width_in(sheet.columns, sheet.least_panel_in, kGapWithNumbers_in);
  for (std::size_t n = 0; n < sheet.panels.size(); ++n)
    sheet.panels[n].settings.push_back(tics_of(*firsts[n], rows, sheet.panel_width_in));
  sheet.add_legend("lines lw 0.8 dt (4,3) lc rgb '#444444'", "target");
  sheet.caption = fmt::format(
      "{}: largest dose at which {}, voxels of {:.6g} cm. Points: trials, each of its own seed; "
      "curve: what the tolerance is read from; vertical line and band: tolerance and its 95 % "
      "interval.",
      study.name, aim.text(), 100.0 * study.voxel_m);
  return sheet;
}

}  // namespace mapscore::eval
