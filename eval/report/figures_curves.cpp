// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#include "eval/report/figures_curves.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <set>
#include <utility>

namespace mapscore::eval {
namespace {

constexpr double kXPadding = 0.05;
constexpr const char* kLatticeStyle = "lw 1.2 dt (6,4) lc rgb '#000000'";

/// 1, 2 or 5 times a power of ten that makes at most five steps of the range.
double tic_step(double range) {
  if (!(range > 0.0)) return 1.0;
  const double decade = std::pow(10.0, std::floor(std::log10(range / 5.0)));
  for (const double step : {1.0, 2.0, 5.0})
    if (range <= 5.0 * step * decade * (1.0 + 1e-9)) return step * decade;
  return 10.0 * decade;
}

std::string number(const std::optional<double>& value) {
  return value ? fmt::format("{:.9g}", *value) : "-";
}

std::string source_of(const Study& study) {
  if (study.scene) return std::filesystem::path(*study.scene).filename().string();
  return study.recording ? std::filesystem::path(*study.recording).filename().string() : study.name;
}

/// From low to high. Over bars drawn as vectors: gnuplot cuts a hole in the bar for the point of
/// yerrorbars.
std::string spread_of(const std::string& data, bool over_bars, const std::string& ink) {
  return over_bars
             ? data +
                   " using 1:3:(0):($4-$3) with vectors heads size screen 0.004,90 lw 0.8 lc rgb "
                   "'#222222' notitle"
             : data + " using 1:2:3:4 with yerrorbars pt 1 ps 0 lw 0.8 " + ink + " notitle";
}

}  // namespace

std::vector<std::string> x_settings(const FigureAxis& x, bool bars) {
  std::vector<std::string> settings;
  if (x.numeric) {
    const auto [low, high] = std::minmax_element(x.at.begin(), x.at.end());
    const double padding = *high > *low ? kXPadding * (*high - *low) : 0.5;
    settings.push_back(fmt::format("set xrange [{:.9g}:{:.9g}]", *low - padding, *high + padding));
    settings.push_back(fmt::format("set xtics {:.9g}", tic_step(*high - *low)));
    return settings;
  }
  std::string tics;
  for (std::size_t i = 0; i < x.at.size(); ++i)
    tics += fmt::format("{}{} {}", i > 0 ? ", " : "", quoted(x.values[i]), x.at[i]);
  const double padding = bars ? 0.7 : 0.4;
  settings.push_back(
      fmt::format("set xrange [{}:{}]", x.at.front() - padding, x.at.back() + padding));
  settings.push_back(fmt::format("set xtics ({}) font ',6.5'", tics));
  return settings;
}

std::string study_caption(const StudySummary& summary) {
  const Study& study = summary.study;
  std::string detected;
  for (const SemanticClass& c : summary.table.classes)
    if (c.detect) detected += (detected.empty() ? "" : ", ") + c.name;
  return fmt::format("{}: {}; voxels of {:.6g} cm; detected: {}; each {} scored; {} seed{}.",
                     study.name, source_of(study), 100.0 * study.voxel_m, detected,
                     study.score.unit == ScoreUnit::map ? "fused map" : "frame", study.seeds,
                     study.seeds == 1 ? "" : "s");
}

std::string spread_caption(const Study& study) {
  if (study.seeds < 2) return "";
  return study.seeds < kSeedsForInterval
             ? fmt::format(" Bars: range of the {} seeds.", study.seeds)
             : fmt::format(" Bars: 95 % interval of the mean of {} seeds.", study.seeds);
}

CurveFigure::CurveFigure(const StudySummary& summary, const StudyLayout& layout, std::string name,
                         int columns)
    : summary_(summary), layout_(layout) {
  sheet_.name = std::move(name);
  sheet_.columns = columns;
  sheet_.panel_width_in = panel_width_in(columns);
}

void CurveFigure::add(const CurvePanel& shown) {
  Panel panel;
  panel.title = shown.title;
  panel.x_label = shown.x_title && !layout_.bars() ? layout_.x().title() : "";
  panel.y_label = shown.y_label;
  panel.y_tic_labels = shown.y_tic_labels;
  panel.settings = x_settings(layout_.x(), layout_.bars());

  std::set<std::string> drawn_ceilings;
  std::vector<std::string> ceilings, spreads, lines;
  for (const Curve& curve : layout_.curves()) {
    const int index = blocks_;
    const Block block = add_block(shown, curve);
    const std::string of = fmt::format("data index {}", index);
    const std::string ink = fmt::format("lc rgb '{}'", curve.colour);
    const std::string mark = layout_.bars() ? "points pt 1 ps 2" : "lines";
    if (drawn_ceilings.insert("registration" + block.ceiling[0]).second)
      ceilings.push_back(fmt::format("{} using 1:5 with {} {} {} notitle", of, mark,
                                     layout_.bars() ? "lw 1.5" : "lw 1.2 dt (1,3)", ink));
    if (drawn_ceilings.insert("lattice" + block.ceiling[1]).second)
      ceilings.push_back(fmt::format("{} using 1:6 with {} {} notitle", of,
                                     layout_.bars() ? "points pt 2 ps 2" : "lines", kLatticeStyle));
    if (summary_.study.seeds > 1) spreads.push_back(spread_of(of, layout_.bars(), ink));
    lines.push_back(
        layout_.bars()
            ? fmt::format("{} using 1:2:(0.7) with boxes {} fs solid 0.75 noborder notitle", of,
                          ink)
            : fmt::format("{} using 1:2 with linespoints pt {} ps 0.9 lw 1.4 dt {} {} notitle", of,
                          curve.point, curve.dash, ink));
  }
  auto& order = panel.elements;
  if (layout_.bars()) order = std::exchange(lines, {});
  for (const auto* part : {&ceilings, &spreads, &lines})
    order.insert(order.end(), part->begin(), part->end());
  sheet_.panels.push_back(std::move(panel));
}

CurveFigure::Block CurveFigure::add_block(const CurvePanel& panel, const Curve& curve) {
  const std::string& column = layout_.columns()[panel.column];
  std::string& data = sheet_.data;
  data += fmt::format("{}# {}; {} {}{}\n# x value low high registration_ceiling lattice_ceiling\n",
                      blocks_++ > 0 ? "\n\n" : "", curve.name, panel.group, panel.metric,
                      column.empty() ? "" : "; " + column);
  Block block;
  const auto note = [&](const std::optional<double>& value) {
    if (value) least_ = std::min(least_, *value);
    return number(value);
  };
  for (std::size_t x = 0; x < layout_.x().at.size(); ++x) {
    const auto trial = layout_.trial(curve, panel.column, x);
    if (!trial) continue;
    const auto at = [&](const ResultLine& line) {
      return estimate(line, summary_.table, panel.group, panel.metric);
    };
    const Estimate value = at(summary_.trials[*trial]);
    const std::string registration = note(at(summary_.registration_ceilings[*trial]).pooled);
    const std::string lattice = note(at(summary_.lattice_ceilings[*trial]).pooled);
    data +=
        fmt::format("{:.9g} {} {} {} {} {}\n", layout_.x().at[x], note(value.pooled),
                    note(value.over_seeds.low), note(value.over_seeds.high), registration, lattice);
    const std::string place = fmt::format("{:.9g} ", layout_.x().at[x]);
    block.ceiling[0] += place + registration + ' ';
    block.ceiling[1] += place + lattice + ' ';
  }
  return block;
}

std::vector<std::string> CurveFigure::legend() const {
  std::vector<std::string> legend;
  if (!layout_.bars())
    for (const Curve& curve : layout_.curves())
      legend.push_back(
          fmt::format("NaN with linespoints pt {} ps 0.9 lw 1.4 dt {} lc rgb '{}' title {}",
                      curve.point, curve.dash, curve.colour, quoted(curve.name)));
  legend.push_back(
      layout_.bars()
          ? fmt::format("NaN with points pt 2 ps 2 {} title \"lattice ceiling\"", kLatticeStyle)
          : fmt::format("NaN with lines {} title \"lattice ceiling\"", kLatticeStyle));
  legend.push_back(
      fmt::format("NaN with {} lc rgb '#666666' title \"registration ceiling\"",
                  layout_.bars() ? "points pt 1 ps 2 lw 1.5" : "lines lw 1.2 dt (1,3)"));
  return legend;
}

FigureSheet CurveFigure::finish(std::string caption) {
  const double low =
      layout_.bars() ? 0.0 : std::max(0.0, std::floor(10.0 * (least_ - 0.01)) / 10.0);
  for (Panel& panel : sheet_.panels)
    panel.settings.push_back(fmt::format("set yrange [{:.2f}:{:.3f}]; set ytics {}", low,
                                         1.0 + 0.03 * (1.0 - low), low < 0.45 ? 0.2 : 0.1));
  sheet_.legend = legend();
  sheet_.caption = std::move(caption);
  return std::move(sheet_);
}

}  // namespace mapscore::eval
