// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#include "eval/report/figures/curves.hpp"

#include "eval/report/tables/table.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <set>
#include <utility>

namespace mapscore::eval {
namespace {

constexpr std::size_t kScoresARow = 3;
constexpr double kXPadding = 0.05;
constexpr double kLeastOwnAxis_in = 1.0;  ///< two have room in a column, with their numbers
/// Width over a name that the curves share; names are 1 apart.
constexpr double kNamePlace = 0.7;
constexpr const char* kLatticeStyle = "lw 1.2 dt (6,4) lc rgb '#000000'";

std::string source_of(const Study& study) {
  std::vector<std::string> scenes;
  for (const SceneSettings& scene : study.scenes) scenes.push_back(scene.name);
  if (!scenes.empty()) return fmt::format("{}", fmt::join(scenes, ", "));
  const auto& source = study.recording ? study.recording : study.scene;
  return source ? std::filesystem::path(*source).filename().string() : study.name;
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
          curve.marked_line(of + " using 1:2", 1.2)};
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
  return {
      fmt::format("{} using ($1{:+.4f}):5:({:.4f}):(0) with vectors nohead lw 1.4 dt (1,2) {} "
                  "notitle",
                  of, offset - 0.5 * place, place, ink),
      fmt::format("{} using ($1-{}):6:({}):(0) with vectors nohead {} notitle", of,
                  0.5 * kNamePlace, kNamePlace, kLatticeStyle),
      fmt::format("{} using ($1{:+.4f}):2:3:4 with yerrorbars pt 1 ps 0 lw 0.8 {} notitle", of,
                  offset, ink),
      fmt::format("{} using ($1{:+.4f}):2 with points {} notitle", of, offset, curve.mark(1.2))};
}

/// Which methods leave points of curves out, since their maps hold no voxel of a detected class
/// though some are visible.
std::string empty_maps_caption(const StudySummary& summary) {
  std::string text;
  for (const MethodSettings& method : summary.study.methods) {
    std::size_t points = 0, empty = 0;
    for (const ResultLine& line : summary.trials) {
      if (line.method != method.name) continue;
      const ClassCounts counts = pooled_counts(line, summary.table);
      ++points;
      empty += counts.predicted == 0 && counts.visible > 0 ? 1 : 0;
    }
    if (empty > 0)
      text += fmt::format(" {} maps nothing{}.", method_title(summary.study, method.name),
                          empty == points ? "" : fmt::format(" at {} of {} points", empty, points));
  }
  return text;
}

/// Panels of curves, one after the other.
class CurveFigure {
 public:
  CurveFigure(const StudySummary& summary, const StudyLayout& layout, const std::string& stem,
              std::size_t columns)
      : summary_(summary), layout_(layout) {
    sheet_.name = layout.figure_name(stem);
    sheet_.columns = static_cast<int>(columns);
    sheet_.style = layout.style();
    if (layout.columns().size() > 1) sheet_.least_panel_in = kLeastInRow_in;
    sheet_.panel_width_in = sheet_.style.panel_width_in(sheet_.columns, sheet_.least_panel_in);
  }

  /// `column`: of StudyLayout::columns().
  void add(const CurveScore& score, std::size_t column, Panel panel) {
    panel.settings = x_settings(sheet_, layout_.x(), layout_.bars() ? 0.7 : 0.5);
    const bool common = !score.own_axis;
    most_ = 0.0;
    has_ceilings_ = has_ceilings_ && common;
    if (!common) sheet_.least_panel_in = std::min(sheet_.least_panel_in, kLeastOwnAxis_in);
    std::set<std::string> drawn_ceilings;
    std::vector<std::string> ceilings, spreads, lines;
    const std::string& head = layout_.columns()[column];
    const std::size_t curves = layout_.curves().size();
    const double place = kNamePlace / static_cast<double>(curves);
    for (std::size_t c = 0; c < curves; ++c) {
      const Curve& curve = layout_.curves()[c];
      const std::string of =
          sheet_.start_block(fmt::format("{}; {} {}{}", curve.name, score.group, score.metric,
                                         head.empty() ? "" : "; " + head),
                             "x value low high registration_ceiling lattice_ceiling");
      const auto [registration, lattice] = add_points(score, column, curve);
      const double offset = (static_cast<double>(c) + 0.5) * place - 0.5 * kNamePlace;
      const CurveMarks marks = layout_.bars()    ? as_bars(curve, of)
                               : layout_.named() ? as_points(curve, of, offset, place)
                                                 : as_line(curve, of);
      if (common &&
          (layout_.named() || drawn_ceilings.insert("registration" + registration).second))
        ceilings.push_back(marks.registration);
      if (common && drawn_ceilings.insert("lattice" + lattice).second)
        ceilings.push_back(marks.lattice);
      if (summary_.study.seeds > 1) spreads.push_back(marks.spread);
      lines.push_back(marks.line);
    }
    if (!common) panel.settings.push_back(own_settings(*score.own_axis));
    if (!common && !sheet_.style.width_mm) panel.settings.emplace_back("set ylabel offset 0,0");
    auto& order = panel.elements;
    if (layout_.bars()) order = std::exchange(lines, {});
    for (const auto* part : {&ceilings, &spreads, &lines})
      order.insert(order.end(), part->begin(), part->end());
    sheet_.panels.push_back(std::move(panel));
  }

  [[nodiscard]] FigureSheet finish(const std::string& caption) {
    const std::string settings = score_settings(layout_.bars() ? 0.0 : least_);
    if (has_ceilings_)
      for (Panel& panel : sheet_.panels) panel.settings.push_back(settings);
    add_legend();
    sheet_.caption = caption + layout_.columns_caption();
    return std::move(sheet_);
  }

 private:
  [[nodiscard]] std::string own_settings(const OwnAxis& axis) const {
    constexpr double kAbove = 1.05, kTopOfNothing = 1.0;
    double top = std::max(axis.least_top, kAbove * most_);
    if (top == 0.0) top = kTopOfNothing;
    std::string settings =
        fmt::format("unset arrow; set format y '%4g'; set yrange [0:{:.6g}]; set ytics {:.6g}", top,
                    tic_step(top, kNarrow_in));
    if (axis.dashed_at)
      settings += fmt::format(
          "; set arrow from graph 0, first {0:.9g} to graph 1, first {0:.9g} nohead back lw 1 dt "
          "(6,4) lc rgb '#000000'",
          *axis.dashed_at);
    return settings;
  }

  /// Texts of both columns of ceilings, registration first, to draw equal ones once.
  std::pair<std::string, std::string> add_points(const CurveScore& score, std::size_t column,
                                                 const Curve& curve) {
    std::pair<std::string, std::string> ceilings;
    const auto note = [&](const std::optional<double>& value) {
      if (value) least_ = std::min(least_, *value);
      return figure_number(value);
    };
    const auto at = [&](const ResultLine& line) {
      return estimate(line, summary_.table, score.group, score.metric);
    };
    for (std::size_t x = 0; x < layout_.x().at.size(); ++x) {
      const auto trial = layout_.trial(curve, column, x);
      if (!trial) continue;
      const Estimate value = at(summary_.trials[*trial]);
      for (const auto& figure : {value.pooled, value.over_seeds.high})
        most_ = std::max(most_, figure.value_or(0.0));
      const std::string registration = note(at(summary_.registration_ceilings[*trial]).pooled);
      const std::string lattice = note(at(summary_.lattice_ceilings[*trial]).pooled);
      const std::string place = fmt::format("{:.9g} ", layout_.x().at[x]);
      sheet_.data +=
          fmt::format("{}{} {} {} {} {}\n", place, note(value.pooled), note(value.over_seeds.low),
                      note(value.over_seeds.high), registration, lattice);
      ceilings.first += place + registration + ' ';
      ceilings.second += place + lattice + ' ';
    }
    return ceilings;
  }

  void add_legend() {
    if (!layout_.bars() && (has_ceilings_ || layout_.curves().size() > 1))
      for (const Curve& curve : layout_.curves())
        sheet_.add_legend(layout_.named() ? "points " + curve.mark(1.2) : curve.legend(),
                          curve.name);
    if (!has_ceilings_) return;
    sheet_.add_legend(std::string(layout_.bars() ? "points pt 2 ps 2 " : "lines ") + kLatticeStyle,
                      "lattice ceiling");
    sheet_.add_legend(fmt::format("{} lc rgb '#666666'", layout_.bars() ? "points pt 1 ps 2 lw 1.5"
                                                                        : "lines lw 1.2 dt (1,3)"),
                      "registration ceiling");
  }

  const StudySummary& summary_;
  const StudyLayout& layout_;
  FigureSheet sheet_;
  double least_ = 1.0;
  bool has_ceilings_ = true;  ///< all scores share one axis
  double most_ = 0.0;         ///< of the panel that is added
};

}  // namespace

FigureSheet curve_figure(const StudySummary& summary, const StudyLayout& layout,
                         const std::string& stem, const std::vector<CurveScore>& scores,
                         const std::string& y_label, const std::string& caption) {
  const std::size_t heads = layout.columns().size(), panels = heads * scores.size();
  const bool rows = heads > 1;  // a row a score
  const std::size_t columns = rows ? heads : std::min(kScoresARow, panels);
  CurveFigure figure(summary, layout, stem, columns);
  for (std::size_t i = 0; i < panels; ++i) {
    const CurveScore& score = scores[i / heads];
    const bool first = i % columns == 0, last_row = i + columns >= panels;
    Panel panel;
    panel.title = !rows ? score.title : i < columns ? layout.columns()[i] : "";
    if (last_row && !layout.bars()) panel.x_label = layout.x().title();
    if (first) panel.y_label = rows ? score.row_title : y_label;
    panel.y_tic_labels = first || score.own_axis;
    figure.add(score, i % heads, std::move(panel));
  }
  return figure.finish(caption);
}

std::vector<std::string> x_settings(FigureSheet& sheet, const FigureAxis& x, double padding) {
  const auto [low, high] = std::minmax_element(x.at.begin(), x.at.end());
  const double length = *high - *low;
  if (x.numeric) padding = length > 0.0 ? kXPadding * length : 0.5;
  const std::string range =
      fmt::format("set xrange [{:.9g}:{:.9g}]", *low - padding, *high + padding);
  if (x.numeric)
    return {range, fmt::format("set xtics {:.9g}", tic_step(length, sheet.panel_width_in))};
  const NameTics tics =
      name_tics(x.values, sheet.panel_width_in / (length + 2.0 * padding), sheet.style);
  sheet.x_tics_in = std::max(sheet.x_tics_in, tics.height_in);
  return {range, tics.setting};
}

std::string score_settings(double least) {
  const double low = std::max(0.0, std::floor(10.0 * (least - 0.01)) / 10.0);
  return fmt::format("set yrange [{:.2f}:{:.3f}]; set ytics {}", low, 1.0 + 0.03 * (1.0 - low),
                     low < 0.45 ? 0.2 : 0.1);
}

std::string figure_number(const std::optional<double>& value) {
  return cell_text(value, "{:.9g}");
}

std::string study_caption(const StudySummary& summary) {
  const Study& study = summary.study;
  // Said where the ruler itself does not fit.
  const std::string note = summary.lattice_note();
  return fmt::format("{}{}: {}; {}; detected: {}.{}{}",
                     summary.interim.empty() ? "" : summary.interim + ". ", study.name,
                     source_of(study), scoring_text(study),
                     fmt::join(detected_titles(study, summary.table), ", "),
                     empty_maps_caption(summary), note.empty() ? "" : " Note: " + note + '.');
}

std::string spread_caption(const Study& study, const char* marks) {
  if (study.seeds < 2) return "";
  return study.seeds < kSeedsForInterval
             ? fmt::format(" {}: range of the {} seeds.", marks, study.seeds)
             : fmt::format(" {}: 95 % interval of the mean of {} seeds.", marks, study.seeds);
}

}  // namespace mapscore::eval
