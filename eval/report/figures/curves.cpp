// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#include "eval/report/figures/curves.hpp"

#include "eval/report/figures/tics.hpp"
#include "eval/report/lattice_check.hpp"
#include "files/text.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <set>
#include <utility>

namespace mapscore::eval {
namespace {

constexpr double kXPadding = 0.05;
/// Width over a name that the curves share; names are 1 apart.
constexpr double kNamePlace = 0.7;
constexpr const char* kLatticeStyle = "lw 1.2 dt (6,4) lc rgb '#000000'";

/// 1, 2 or 5 times a power of ten that makes at most five steps of the range.
double tic_step(double range) {
  if (!(range > 0.0)) return 1.0;
  const double decade = std::pow(10.0, std::floor(std::log10(range / 5.0)));
  for (const double step : {1.0, 2.0, 5.0})
    if (range <= 5.0 * step * decade * (1.0 + 1e-9)) return step * decade;
  return 10.0 * decade;
}

std::string source_of(const Study& study) {
  if (study.scene) return std::filesystem::path(*study.scene).filename().string();
  return study.recording ? std::filesystem::path(*study.recording).filename().string() : study.name;
}

/// The elements of `plot` that show one curve in one panel.
struct CurveMarks {
  std::string registration, lattice, spread, line;
};

CurveMarks as_line(const Curve& curve, const std::string& of) {
  const std::string ink = fmt::format("lc rgb '{}'", curve.colour);
  return {fmt::format("{} using 1:5 with lines lw 1.2 dt (1,3) {} notitle", of, ink),
          fmt::format("{} using 1:6 with lines {} notitle", of, kLatticeStyle),
          fmt::format("{} using 1:2:3:4 with yerrorbars pt 1 ps 0 lw 0.8 {} notitle", of, ink),
          fmt::format("{} using 1:2 with linespoints pt {} ps 0.9 lw 1.4 dt {} {} notitle", of,
                      curve.point, curve.dash, ink)};
}

/// The spread as vectors: gnuplot cuts a hole in the bar for the point of yerrorbars.
CurveMarks as_bars(const Curve& curve, const std::string& of) {
  const std::string ink = fmt::format("lc rgb '{}'", curve.colour);
  return {fmt::format("{} using 1:5 with points pt 1 ps 2 lw 1.5 {} notitle", of, ink),
          fmt::format("{} using 1:6 with points pt 2 ps 2 {} notitle", of, kLatticeStyle),
          of + " using 1:3:(0):($4-$3) with vectors heads size screen 0.004,90 lw 0.8 lc rgb "
               "'#222222' notitle",
          fmt::format("{} using 1:2:(0.7) with boxes {} fs solid 0.75 noborder notitle", of, ink)};
}

/// Over a name, the curve's point beside those of the others and under its own ceiling.
CurveMarks as_points(const Curve& curve, const std::string& of, double offset, double place) {
  const std::string ink = fmt::format("lc rgb '{}'", curve.colour);
  return {fmt::format("{} using ($1{:+.4f}):5:({:.4f}):(0) with vectors nohead lw 1.4 dt (1,2) {} "
                      "notitle",
                      of, offset - 0.5 * place, place, ink),
          fmt::format("{} using ($1-{}):6:({}):(0) with vectors nohead {} notitle", of,
                      0.5 * kNamePlace, kNamePlace, kLatticeStyle),
          fmt::format("{} using ($1{:+.4f}):2:3:4 with yerrorbars pt 1 ps 0 lw 0.8 {} notitle", of,
                      offset, ink),
          fmt::format("{} using ($1{:+.4f}):2 with points pt {} ps 0.9 {} notitle", of, offset,
                      curve.point, ink)};
}

/// `set` lines of an axis of numbers.
std::vector<std::string> number_settings(const FigureAxis& x) {
  const auto [low, high] = std::minmax_element(x.at.begin(), x.at.end());
  const double padding = *high > *low ? kXPadding * (*high - *low) : 0.5;
  return {fmt::format("set xrange [{:.9g}:{:.9g}]", *low - padding, *high + padding),
          fmt::format("set xtics {:.9g}", tic_step(*high - *low))};
}

/// Said where the ruler itself does not fit; nothing elsewhere.
std::string lattice_caption(const StudySummary& summary) {
  LatticeCheck check(summary.table);
  for (const ResultLine& line : summary.lattice_ceilings)
    for (const TrialResult& result : line.results) check.add(result.counts);
  const std::string note = check.note();
  return note.empty() ? "" : " Note: " + note + '.';
}

/// Which methods leave points of curves out, since their maps hold no voxel of a detected class.
std::string empty_maps_caption(const StudySummary& summary) {
  std::string text;
  for (const MethodSettings& method : summary.study.methods) {
    std::size_t points = 0, empty = 0;
    for (const ResultLine& line : summary.trials) {
      if (line.method != method.name) continue;
      ++points;
      empty += pool_detected(line.pooled, summary.table).predicted == 0 ? 1 : 0;
    }
    if (empty > 0)
      text += fmt::format(" {} maps nothing{}.", method.name,
                          empty == points ? "" : fmt::format(" at {} of {} points", empty, points));
  }
  return text;
}

}  // namespace

std::string figure_number(const std::optional<double>& value) {
  return value ? fmt::format("{:.9g}", *value) : "-";
}

std::string study_caption(const StudySummary& summary) {
  const Study& study = summary.study;
  std::string detected;
  for (const SemanticClass& c : summary.table.classes)
    if (c.detect) detected += (detected.empty() ? "" : ", ") + c.name;
  return fmt::format("{}: {}; voxels of {:.6g} cm; detected: {}; each {} scored; {} seed{}.{}{}",
                     study.name, source_of(study), 100.0 * study.voxel_m, detected,
                     study.score.unit == ScoreUnit::map ? "fused map" : "frame", study.seeds,
                     study.seeds == 1 ? "" : "s", empty_maps_caption(summary),
                     lattice_caption(summary));
}

std::string spread_caption(const Study& study, const char* marks) {
  if (study.seeds < 2) return "";
  return study.seeds < kSeedsForInterval
             ? fmt::format(" {}: range of the {} seeds.", marks, study.seeds)
             : fmt::format(" {}: 95 % interval of the mean of {} seeds.", marks, study.seeds);
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
  panel.settings = x_settings();

  std::set<std::string> drawn_ceilings;
  std::vector<std::string> ceilings, spreads, lines;
  const std::size_t curves = layout_.curves().size();
  const double place = kNamePlace / static_cast<double>(curves);
  for (std::size_t c = 0; c < curves; ++c) {
    const Curve& curve = layout_.curves()[c];
    const std::string of = fmt::format("data index {}", blocks_);
    const Block block = add_block(shown, curve);
    const double offset = (static_cast<double>(c) + 0.5) * place - 0.5 * kNamePlace;
    const CurveMarks marks = layout_.bars()    ? as_bars(curve, of)
                             : layout_.named() ? as_points(curve, of, offset, place)
                                               : as_line(curve, of);
    if (layout_.named() || drawn_ceilings.insert("registration" + block.ceiling[0]).second)
      ceilings.push_back(marks.registration);
    if (drawn_ceilings.insert("lattice" + block.ceiling[1]).second)
      ceilings.push_back(marks.lattice);
    if (summary_.study.seeds > 1) spreads.push_back(marks.spread);
    lines.push_back(marks.line);
  }
  auto& order = panel.elements;
  if (layout_.bars()) order = std::exchange(lines, {});
  for (const auto* part : {&ceilings, &spreads, &lines})
    order.insert(order.end(), part->begin(), part->end());
  sheet_.panels.push_back(std::move(panel));
}

std::vector<std::string> CurveFigure::x_settings() {
  const FigureAxis& x = layout_.x();
  if (x.numeric) return number_settings(x);
  const double padding = layout_.bars() ? 0.7 : 0.5;
  const double places = x.at.back() - x.at.front() + 2.0 * padding;
  const NameTics tics = name_tics(x.values, sheet_.panel_width_in / places);
  sheet_.x_tics_in = std::max(sheet_.x_tics_in, tics.height_in);
  return {fmt::format("set xrange [{}:{}]", x.at.front() - padding, x.at.back() + padding),
          tics.setting};
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
    return figure_number(value);
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
      legend.push_back(fmt::format("NaN with {} pt {} ps 0.9 lw 1.4 dt {} lc rgb '{}' title {}",
                                   layout_.named() ? "points" : "linespoints", curve.point,
                                   layout_.named() ? 1 : curve.dash, curve.colour,
                                   gnuplot_quoted(curve.name)));
  legend.push_back(
      layout_.bars()
          ? fmt::format("NaN with points pt 2 ps 2 {} title 'lattice ceiling'", kLatticeStyle)
          : fmt::format("NaN with lines {} title 'lattice ceiling'", kLatticeStyle));
  legend.push_back(
      fmt::format("NaN with {} lc rgb '#666666' title 'registration ceiling'",
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
