// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#include "eval/report/figures/frontier_figure.hpp"

#include "eval/report/figures/curves.hpp"
#include "eval/report/figures/layout.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <string>
#include <utility>

namespace mapscore::eval {
namespace {

constexpr double kSideMargin = 0.05;  ///< beside the doses, in parts of their range

using Rows = std::vector<const ToleranceRow*>;

/// One method's line in one panel, beside those of the others by `aside` on the x axis.
void add_line(FigureSheet& sheet, Panel& panel, const Rows& rows, const Curve& curve,
              double aside) {
  const ToleranceRow& any = *rows.front();
  const double unit = any.axis.at.front();
  const auto start = [&](const char* what, const char* columns) {
    return sheet.start_block(
        fmt::format("{}; {}; {}; {}", any.axis.title(), any.group, any.method, what), columns);
  };
  const auto in_unit = [unit](const std::optional<double>& dose) {
    return figure_number(dose ? std::optional(*dose * unit) : std::nullopt);
  };
  const std::string line = start("tolerances", "second tolerance low high");
  for (const ToleranceRow* row : rows) {
    const Tolerance& of = row->tolerance;
    sheet.data += fmt::format("{:.9g} {} {} {}\n", row->second->axis.at.front(), in_unit(of.dose),
                              in_unit(of.low.value_or(row->search.low)),
                              in_unit(of.high.value_or(row->search.high)));
  }
  const std::string beyond = start("beyond the range", "second above below");
  for (const ToleranceRow* row : rows) {
    const auto end = [&](ToleranceVerdict verdict, double dose) {
      return in_unit(row->tolerance.verdict == verdict ? std::optional(dose) : std::nullopt);
    };
    sheet.data += fmt::format("{:.9g} {} {}\n", row->second->axis.at.front(),
                              end(ToleranceVerdict::above, row->search.high),
                              end(ToleranceVerdict::below, row->search.low));
  }
  const std::string ink = fmt::format("lc rgb '{}'", curve.colour);
  const auto plot = [&](const std::string& of, const char* columns, const std::string& with) {
    panel.elements.push_back(
        fmt::format("{} using ($1{:+.6g}):{} with {} {} notitle", of, aside, columns, with, ink));
  };
  plot(line, "(valid(2) ? $3 : NaN):(0):($4-$3)", "vectors nohead lw 1");
  plot(line, "2", "lines lw 1.4 dt " + curve.dash);
  plot(line, "2", fmt::format("points pt {} ps 0.8", curve.point));
  plot(beyond, "2", "points pt 8 ps 1");
  plot(beyond, "3", "points pt 10 ps 1");
}

}  // namespace

FigureSheet frontier_figure(const Study& study, const ToleranceAim& aim,
                            const std::vector<ToleranceRow>& rows, const FigureStyle& style) {
  FigureSheet sheet;
  sheet.name = "frontier";
  sheet.style = style;
  std::vector<Curve> curves;
  std::vector<std::pair<std::string, std::string>> panels;  // fault and group
  for (const ToleranceRow& row : rows) {
    if (std::ranges::find(curves, row.method, &Curve::method) == curves.end())
      curves.push_back(curve_of(study, row.method, curves.size(), style));
    const std::pair key{row.path, row.group};
    if (std::ranges::find(panels, key) == panels.end()) panels.push_back(key);
  }
  for (const auto& [path, group] : panels) {
    std::map<std::string, Rows> lines;
    for (const ToleranceRow& row : rows)
      if (row.path == path && row.group == group) lines[row.method].push_back(&row);
    const ToleranceRow& first = *lines.begin()->second.front();
    const double unit = first.axis.at.front();
    Panel& panel = sheet.panels.emplace_back(
        Panel{class_title(study, group), first.second->axis.title(), first.axis.title()});
    const double left = first.second->axis.at.front();
    const double right = lines.begin()->second.back()->second->axis.at.front();
    panel.settings = {style.width_mm ? "" : "set ylabel offset 0,0",
                      "set xtics autofreq; set ytics autofreq",
                      fmt::format("set xrange [{:.9g}:{:.9g}]", left - kSideMargin * (right - left),
                                  right + kSideMargin * (right - left)),
                      fmt::format("set yrange [{:.9g}:{:.9g}]", first.search.low * unit,
                                  first.search.high * unit)};
    for (std::size_t n = 0; n < curves.size(); ++n)
      add_line(sheet, panel, lines.at(curves[n].method), curves[n],
               kSideMargin * (right - left) *
                   ((static_cast<double>(n) + 0.5) / static_cast<double>(curves.size()) - 0.5));
  }
  for (const Curve& curve : curves)
    sheet.add_legend("linespoints " + curve.line_with_points(0.8), curve.name);
  sheet.columns = static_cast<int>(std::min<std::size_t>(3, sheet.panels.size()));
  sheet.panel_width_in = sheet.style.panel_width_in(sheet.columns, sheet.least_panel_in);
  sheet.caption = fmt::format(
      "{}: largest dose of the one fault at which {} under the dose of the other along x, voxels "
      "of {:.6g} cm. Bars: 95 % interval, to the end of the range where it is open. Triangles: "
      "beyond the range.",
      study.name, aim.text(), 100.0 * study.voxel_m);
  return sheet;
}

}  // namespace mapscore::eval
