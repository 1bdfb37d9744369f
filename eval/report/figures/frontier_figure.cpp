// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#include "eval/report/figures/frontier_figure.hpp"

#include "eval/report/figures/curves.hpp"
#include "eval/report/figures/tolerance_figure.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <string>
#include <utility>

namespace mapscore::eval {
namespace {

constexpr double kSideMargin = 0.05;       ///< beside the doses, in parts of their range
constexpr double kBeside_in = 1.0 / 25.4;  ///< of paper, for methods side by side at one dose

using Rows = std::vector<const ToleranceRow*>;

/// What a row covers along y: its bar, or its triangle.
std::optional<std::pair<double, double>> covered(const ToleranceRow& row) {
  const double unit = row.axis.at.front();
  if (row.tolerance.verdict == ToleranceVerdict::above)
    return std::pair(row.search.high * unit, row.search.high * unit);
  if (row.tolerance.verdict == ToleranceVerdict::below)
    return std::pair(row.search.low * unit, row.search.low * unit);
  return interval_shown(row);
}

/// Where the methods stand beside one dose, in parts of `kBeside_in`: -0.5 to 0.5 for those that
/// would cover each other, 0 for the others.
std::vector<double> places_beside(const Rows& at_dose) {
  std::vector<std::size_t> covering;
  for (std::size_t n = 0; n < at_dose.size(); ++n) {
    const auto own = covered(*at_dose[n]);
    const bool covers = std::ranges::any_of(at_dose, [&](const ToleranceRow* other) {
      const auto its = covered(*other);
      return other != at_dose[n] && own && its && own->first <= its->second &&
             its->first <= own->second;
    });
    if (covers) covering.push_back(n);
  }
  std::vector<double> places(at_dose.size(), 0.0);
  for (std::size_t k = 0; k < covering.size(); ++k)
    places[covering[k]] = static_cast<double>(k) / static_cast<double>(covering.size() - 1) - 0.5;
  return places;
}

/// One method's line in one panel, each row beside its dose by its `aside` on the x axis.
void add_line(FigureSheet& sheet, Panel& panel, const Rows& rows, const Curve& curve,
              const std::vector<double>& aside) {
  const ToleranceRow& any = *rows.front();
  const double unit = any.axis.at.front();
  const auto start = [&](const char* what, const char* columns) {
    return sheet.start_block(
        fmt::format("{}; {}; {}; {}", any.axis.title(), any.group, any.method, what), columns);
  };
  const auto in_unit = [unit](const std::optional<double>& dose) {
    return figure_number(dose ? std::optional(*dose * unit) : std::nullopt);
  };
  const std::string line = start("tolerances", "second tolerance low high aside");
  for (std::size_t n = 0; n < rows.size(); ++n) {
    const auto bar = interval_shown(*rows[n]);
    sheet.data +=
        fmt::format("{:.9g} {} {} {} {:.9g}\n", rows[n]->second->axis.at.front(),
                    in_unit(rows[n]->tolerance.dose),
                    figure_number(bar ? std::optional(bar->first) : std::nullopt),
                    figure_number(bar ? std::optional(bar->second) : std::nullopt), aside[n]);
  }
  const std::string beyond = start("beyond the range", "second above below aside");
  for (std::size_t n = 0; n < rows.size(); ++n) {
    const auto end = [&](ToleranceVerdict verdict, double dose) {
      return in_unit(rows[n]->tolerance.verdict == verdict ? std::optional(dose) : std::nullopt);
    };
    sheet.data += fmt::format("{:.9g} {} {} {:.9g}\n", rows[n]->second->axis.at.front(),
                              end(ToleranceVerdict::above, rows[n]->search.high),
                              end(ToleranceVerdict::below, rows[n]->search.low), aside[n]);
  }
  const std::string ink = fmt::format(" lc rgb '{}'", curve.colour);
  const auto plot = [&](const std::string& of, const char* columns, const std::string& with) {
    panel.elements.push_back(fmt::format("{} using {} with {} notitle", of, columns, with));
  };
  plot(line, "($1+$5):3:(0):($4-$3)", "vectors nohead lw 1" + ink);
  plot(line, "($1+$5):2", "lines " + curve.line());
  plot(line, "($1+$5):2", "points " + curve.mark(1.0));
  plot(beyond, "($1+$4):2", "points pt 8 ps 1.2 lw 0.5" + ink);
  plot(beyond, "($1+$4):3", "points pt 10 ps 1.2 lw 0.5" + ink);
}

std::string frontier_caption(const Study& study, const ToleranceAim& aim,
                             const std::vector<ToleranceRow>& rows, bool any_aside) {
  using enum ToleranceVerdict;
  const auto any = [&](ToleranceVerdict one, ToleranceVerdict other) {
    return std::ranges::any_of(rows, [&](const ToleranceRow& row) {
      return row.tolerance.verdict == one || row.tolerance.verdict == other;
    });
  };
  std::string text = fmt::format(
      "{}: under each dose of the fault along x, the largest of the one along y at which {}; "
      "voxels of {:.6g} cm. Bars: 95 % interval, to the end of the range where it is open.",
      study.name, aim.text(), 100.0 * study.voxel_m);
  if (any(open, open)) text += " Bar without a mark: the trials do not tell where in it.";
  if (any(above, below)) text += " Open triangles at an end of y: beyond the range.";
  if (any(not_monotone, undefined))
    text += " Neither bar nor mark: crosses more than once, too few scores, or none to lose.";
  if (any_aside) text += " Methods that would cover each other stand side by side, within 1 mm.";
  return text;
}

}  // namespace

FigureSheet frontier_figure(const Study& study, const ToleranceAim& aim,
                            const std::vector<ToleranceRow>& rows, const FigureStyle& style) {
  const ToleranceLayout layout(study, rows, style);
  const std::vector<Curve>& curves = layout.curves;
  FigureSheet sheet = layout.sheet("frontier", style, kLeastPanel_in, kGapWithNumbers_in);
  bool any_aside = false;
  for (const TolerancePanel& shown : layout.panels) {
    std::map<std::string, Rows> lines;
    for (const ToleranceRow* row : shown.rows) lines[row->method].push_back(row);
    const ToleranceRow& first = *lines.begin()->second.front();
    const double unit = first.axis.at.front();
    Panel& panel = sheet.panels.emplace_back(
        Panel{shown.title, first.second->axis.title(), first.axis.title()});
    const double left = first.second->axis.at.front();
    const double right = lines.begin()->second.back()->second->axis.at.front();
    panel.settings = {style.width_mm ? "" : "set ylabel offset 0,0",
                      "set xtics autofreq; set ytics autofreq",
                      fmt::format("set xrange [{:.9g}:{:.9g}]", left - kSideMargin * (right - left),
                                  right + kSideMargin * (right - left)),
                      fmt::format("set yrange [{:.9g}:{:.9g}]", first.search.low * unit,
                                  first.search.high * unit)};
    const double beside =
        kBeside_in / sheet.panel_width_in * (1.0 + 2.0 * kSideMargin) * (right - left);
    std::vector<std::vector<double>> asides(curves.size());
    for (std::size_t dose = 0; dose < lines.begin()->second.size(); ++dose) {
      Rows at_dose;
      for (const Curve& curve : curves) at_dose.push_back(lines.at(curve.method)[dose]);
      const std::vector<double> places = places_beside(at_dose);
      for (std::size_t n = 0; n < places.size(); ++n) asides[n].push_back(places[n] * beside);
      any_aside = any_aside || std::ranges::any_of(places, [](double at) { return at != 0.0; });
    }
    for (std::size_t n = 0; n < curves.size(); ++n)
      add_line(sheet, panel, lines.at(curves[n].method), curves[n], asides[n]);
  }
  sheet.caption = frontier_caption(study, aim, rows, any_aside);
  return sheet;
}

}  // namespace mapscore::eval
