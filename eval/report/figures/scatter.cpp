// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#include "eval/report/figures/scatter.hpp"

#include "eval/report/figures/curves.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <map>
#include <string>

namespace mapscore::eval {
namespace {

using XY = std::vector<std::pair<double, double>>;

using ShownScore = std::pair<const char*, const char*>;  ///< metric and title
constexpr std::array<ShownScore, 3> kShownScores{
    {{"precision", "precision"}, {"recall", "recall"}, {"f1", "F1"}}};
constexpr double kLeastOfThree_in = 1.7;  ///< so that a path's title stands on one line
constexpr double kShareOfMean = 0.125;    ///< of all points
constexpr std::size_t kLeastOfMean = 5;

std::size_t window_of(std::size_t points) {
  return std::max(kLeastOfMean,
                  static_cast<std::size_t>(kShareOfMean * static_cast<double>(points)));
}

/// Mean at each x, in their order.
XY means_by_x(const XY& points) {
  std::map<double, std::pair<double, std::size_t>> sums;
  for (const auto& [x, y] : points) {
    sums[x].first += y;
    ++sums[x].second;
  }
  XY means;
  for (const auto& [x, sum] : sums)
    means.emplace_back(x, sum.first / static_cast<double>(sum.second));
  return means;
}

/// Where the points of the study lie along one of its paths.
class SampledAxis {
 public:
  SampledAxis(const Study& study, std::size_t place)
      : place_(place),
        axis_(study.sweep.at(place)),
        shown_(figure_axis(study, axis_)),
        field_(field_of(study, axis_.path)) {}

  [[nodiscard]] const FigureAxis& shown() const { return shown_; }
  [[nodiscard]] double at(const Cell& cell) const {
    const std::string& value = cell.doses.at(place_).second;
    if (shown_.numeric) return figure_axis(field_, {value}).at.front();
    return static_cast<double>(std::ranges::find(axis_.values, value) - axis_.values.begin());
  }

 private:
  std::size_t place_;
  const SweepAxis& axis_;
  FigureAxis shown_;
  Field field_;
};

class ScatterFigure {
 public:
  ScatterFigure(const StudySummary& summary, const FigureStyle& style) : summary_(summary) {
    sheet_.name = "accuracy_over_ranges";
    sheet_.style = style;
    sheet_.least_panel_in = kLeastOfThree_in;
    if (style.columns(3, kLeastOfThree_in) < 3) scores_ = {kShownScores.back()};
    sheet_.columns = static_cast<int>(scores_.size());
    sheet_.panel_width_in = style.panel_width_in(sheet_.columns, sheet_.least_panel_in);
    for (const MethodSettings& method : summary.study.methods)
      curves_.push_back(curve_of(summary.study, method.name, curves_.size(), style));
  }

  void add_row(const SampledAxis& axis) {
    const std::vector<std::string> settings = x_settings(sheet_, axis.shown(), 0.5);
    for (const auto& [metric, title] : scores_) {
      const bool first = metric == scores_.front().first;
      Panel panel{title, axis.shown().title(), first ? "score" : "", first, settings};
      for (const Curve& curve : curves_)
        add_method(panel, fmt::format("{} {}; {}", title, axis.shown().key, curve.method),
                   points_of_method(axis, curve.method, metric), curve, axis.shown().numeric);
      sheet_.panels.push_back(std::move(panel));
    }
  }

  [[nodiscard]] FigureSheet finish() {
    for (Panel& panel : sheet_.panels) panel.settings.push_back(score_settings(least_));
    for (const Curve& curve : curves_) sheet_.add_legend(curve.legend(), curve.name);
    sheet_.caption =
        study_caption(summary_) +
        fmt::format(
            " Points: {} over the ranges, counts pooled over classes and seeds; the other "
            "paths vary too. Mean: of {} neighbours, or of each value that many points share.",
            points_of(summary_.study.sampling), window_of(points()));
    return std::move(sheet_);
  }

 private:
  [[nodiscard]] std::size_t points() const {
    return summary_.trials.size() / std::max<std::size_t>(1, summary_.study.methods.size());
  }

  XY points_of_method(const SampledAxis& axis, const std::string& method,
                      const std::string& metric) {
    XY points;
    for (const ResultLine& line : summary_.trials) {
      if (line.method != method) continue;
      const auto value = estimate(line, summary_.table, std::string(kPooled), metric).pooled;
      if (!value) continue;
      points.emplace_back(axis.at(line.cell), *value);
      least_ = std::min(least_, *value);
    }
    return points;
  }

  std::string block(const std::string& what, const XY& points) {
    std::string of = sheet_.start_block(what, "x value");
    for (const auto& [x, y] : points) sheet_.data += fmt::format("{:.9g} {:.9g}\n", x, y);
    return of;
  }

  void add_method(Panel& panel, const std::string& what, const XY& marks, const Curve& curve,
                  bool numeric) {
    if (marks.empty()) return;
    panel.elements.push_back(
        fmt::format("{} using 1:2 with points {} notitle", block(what, marks), curve.mark(0.8)));
    XY means = means_by_x(marks);  // names, and few whole numbers
    if (numeric && 2 * means.size() > marks.size())
      means = running_mean(marks, window_of(points()));
    if (means.empty()) return;
    panel.elements.push_back(
        fmt::format("{} using 1:2 with {} notitle", block(what + "; mean", means),
                    numeric ? "lines " + curve.line() : "points " + curve.mark(1.4)));
  }

  const StudySummary& summary_;
  std::vector<ShownScore> scores_{kShownScores.begin(), kShownScores.end()};
  std::vector<Curve> curves_;  ///< a method each
  FigureSheet sheet_;
  double least_ = 1.0;
};

}  // namespace

std::vector<std::pair<double, double>> running_mean(std::vector<std::pair<double, double>> points,
                                                    std::size_t window) {
  std::ranges::stable_sort(points, {}, &XY::value_type::first);
  XY means;
  for (std::size_t first = 0; first + window <= points.size(); ++first) {
    double x = 0.0, y = 0.0;
    for (std::size_t n = first; n < first + window; ++n) {
      x += points[n].first;
      y += points[n].second;
    }
    means.emplace_back(x / static_cast<double>(window), y / static_cast<double>(window));
  }
  return means;
}

FigureSheet scatter_figure(const StudySummary& summary, const FigureStyle& style) {
  ScatterFigure figure(summary, style);
  for (std::size_t n = 0; n < summary.study.sweep.size(); ++n)
    figure.add_row(SampledAxis(summary.study, n));
  return figure.finish();
}

}  // namespace mapscore::eval
