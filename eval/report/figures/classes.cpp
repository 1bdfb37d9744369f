// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#include "eval/report/figures/curves.hpp"
#include "eval/report/figures/figures.hpp"
#include "files/text.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <functional>
#include <utility>

namespace mapscore::eval {
namespace {

constexpr std::size_t kClassesShown = 12;
constexpr double kGroup = 0.8;      ///< width of a group of bars; groups are 1 apart
constexpr double kBarShare = 0.92;  ///< of a bar's place in its group
constexpr double kClassHeight_in = 1.45, kLeastBar_in = 0.05;

struct Score {
  const char *metric, *title;
};
constexpr std::array<Score, 3> kScores{Score{"precision", "precision"}, Score{"recall", "recall"},
                                       Score{"f1", "F1"}};

/// Detected classes with something to see, in the table's order; of more than twelve those with
/// most visible voxels.
std::vector<const SemanticClass*> classes_shown(const StudySummary& summary) {
  const auto visible = [&](const SemanticClass* c) {
    return summary.trials.empty() ? 0 : summary.trials.front().pooled.at(c->id).visible;
  };
  std::vector<const SemanticClass*> shown;
  for (const SemanticClass& c : summary.table.classes)
    if (c.detect && visible(&c) > 0) shown.push_back(&c);
  std::ranges::stable_sort(shown, std::greater<>(), visible);
  shown.resize(std::min(shown.size(), kClassesShown));
  std::ranges::sort(shown, {}, &SemanticClass::id);
  return shown;
}

/// Says that classes are left out, where some are.
std::string cut_caption(const StudySummary& summary, std::size_t shown) {
  const std::size_t detected = detected_names(summary.table).size();
  return shown < detected
             ? fmt::format(" {} of {} detected classes, those with most visible voxels.", shown,
                           detected)
             : "";
}

/// Position in the sweep of the first axis with names.
std::optional<std::size_t> named_axis(const Study& study) {
  for (std::size_t axis = 0; axis < study.sweep.size(); ++axis)
    if (!figure_axis(study, study.sweep[axis]).numeric) return axis;
  return std::nullopt;
}

/// Grouped bars, filled panel by panel.
class ClassBars {
 public:
  ClassBars(const StudySummary& summary, std::size_t axis, const FigureStyle& style)
      : summary_(summary),
        axis_(axis),
        named_(figure_axis(summary.study, summary.study.sweep[axis])),
        classes_(classes_shown(summary)),
        place_(kGroup / static_cast<double>(named_.values.size())) {
    sheet_.name = "by_class_by_" + named_.key;
    sheet_.columns = static_cast<int>(kScores.size());
    sheet_.style = style;
    sheet_.least_panel_in = std::max(
        kLeastPanel_in, kLeastBar_in * static_cast<double>(classes_.size() * named_.values.size()));
    sheet_.panel_width_in = style.panel_width_in(sheet_.columns, sheet_.least_panel_in);
    sheet_.panel_height_in = kClassHeight_in;
  }

  void add_row(const std::string& method, bool first_row) {
    for (const Score& score : kScores) {
      const bool first = &score == &kScores.front();
      const std::string row_title =
          summary_.study.methods.size() > 1 ? method_title(summary_.study, method) : "score";
      Panel panel{first_row ? score.title : "", "", first ? row_title : "", first, settings()};
      add_bars(method, score, panel.elements);
      sheet_.panels.push_back(std::move(panel));
    }
  }

  [[nodiscard]] FigureSheet finish() {
    for (std::size_t value = 0; value < named_.values.size(); ++value)
      sheet_.add_legend("boxes " + fill(value), named_.values[value]);
    sheet_.add_legend("lines lw 1.2 lc rgb '#000000'", "lattice ceiling");
    sheet_.add_legend("lines lw 1.2 dt (1,2) lc rgb '#444444'", "registration ceiling");
    const Study& study = summary_.study;
    sheet_.caption =
        study_caption(summary_) + " Bars by " + named_.name + other_doses() +
        (study.methods.size() > 1 ? "" : "; " + method_title(study, study.methods.front().name)) +
        ". Tolerance 0, counts pooled over seeds; no bar: undefined." +
        spread_caption(study, "Whiskers") + cut_caption(summary_, classes_.size()) + ' ' +
        kCeilingsCaption;
    return std::move(sheet_);
  }

 private:
  [[nodiscard]] std::string fill(std::size_t value) const {
    const bool grey = sheet_.style.grey;
    return fmt::format("{} lc rgb '{}'", bar_fill(value, sheet_.style),
                       grey ? grey_tone(value) : palette_colour(value));
  }

  /// The middle value of every axis but the named one.
  [[nodiscard]] const std::string& dose(std::size_t axis, std::size_t value) const {
    const std::vector<std::string>& values = summary_.study.sweep[axis].values;
    return axis == axis_ ? values.at(value) : values[values.size() / 2];
  }

  /// "; misregistration = 10 mm" for each axis but the named one.
  [[nodiscard]] std::string other_doses() const {
    std::string text;
    for (std::size_t axis = 0; axis < summary_.study.sweep.size(); ++axis)
      if (axis != axis_)
        text +=
            "; " +
            figure_axis(summary_.study, {summary_.study.sweep[axis].path, {dose(axis, 0)}}).text(0);
    return text;
  }

  [[nodiscard]] std::vector<std::string> settings() {
    std::vector<std::string> names;
    for (const SemanticClass* c : classes_) names.push_back(class_title(summary_.study, c->name));
    std::vector<std::string> settings = x_settings(sheet_, axis_of_names("class", names), 0.55);
    settings.emplace_back("set yrange [0:1.03]; set ytics 0.2");
    return settings;
  }

  [[nodiscard]] std::optional<std::size_t> trial(const std::string& method,
                                                 std::size_t value) const {
    for (std::size_t i = 0; i < summary_.trials.size(); ++i) {
      const ResultLine& line = summary_.trials[i];
      bool fits = line.method == method;
      for (std::size_t axis = 0; axis < line.cell.doses.size(); ++axis)
        fits = fits && line.cell.doses[axis].second == dose(axis, value);
      if (fits) return i;
    }
    return std::nullopt;
  }

  void add_bars(const std::string& method, const Score& score, std::vector<std::string>& elements) {
    std::vector<std::string> ceilings, whiskers;
    for (std::size_t value = 0; value < named_.values.size(); ++value) {
      const auto line = trial(method, value);
      if (!line) continue;
      const std::string of =
          sheet_.start_block(fmt::format("{}; {}; {}", method, score.metric, named_.text(value)),
                             "place class value low high registration_ceiling lattice_ceiling");
      add_rows(score, value, *line);
      elements.push_back(fmt::format("{} using 1:3:({:.5f}) with boxes {} notitle", of,
                                     kBarShare * place_, fill(value)));
      const std::string over = fmt::format("{} using ($1-{:.5f}):", of, 0.5 * place_);
      const std::string along = fmt::format(":({:.5f}):(0) with vectors nohead lw 1.2", place_);
      ceilings.push_back(over + '6' + along + " dt (1,2) lc rgb '#444444' notitle");
      ceilings.push_back(over + '7' + along + " lc rgb '#000000' notitle");
      if (summary_.study.seeds > 1)
        whiskers.push_back(of +
                           " using 1:4:(0):($5-$4) with vectors heads size screen 0.0025,90 "
                           "lw 0.8 lc rgb '#222222' notitle");
    }
    elements.insert(elements.end(), ceilings.begin(), ceilings.end());
    elements.insert(elements.end(), whiskers.begin(), whiskers.end());
  }

  void add_rows(const Score& score, std::size_t value, std::size_t line) {
    const double offset = (static_cast<double>(value) + 0.5) * place_ - 0.5 * kGroup;
    for (std::size_t c = 0; c < classes_.size(); ++c) {
      const auto at = [&](const ResultLine& of) {
        return estimate(of, summary_.table, classes_[c]->name, score.metric);
      };
      const Estimate shown = at(summary_.trials[line]);
      sheet_.data +=
          fmt::format("{:.4f} {} {} {} {} {} {}\n", static_cast<double>(c) + offset,
                      gnuplot_column(classes_[c]->name), figure_number(shown.pooled),
                      figure_number(shown.over_seeds.low), figure_number(shown.over_seeds.high),
                      figure_number(at(summary_.registration_ceilings[line]).pooled),
                      figure_number(at(summary_.lattice_ceilings[line]).pooled));
    }
  }

  const StudySummary& summary_;
  std::size_t axis_;  ///< position in the sweep
  FigureAxis named_;
  std::vector<const SemanticClass*> classes_;
  double place_;  ///< width of a bar with its gap
  FigureSheet sheet_;
};

}  // namespace

std::optional<FigureSheet> class_bars_figure(const StudySummary& summary,
                                             const FigureStyle& style) {
  const std::optional<std::size_t> axis = named_axis(summary.study);
  if (!axis || classes_shown(summary).size() < 2) return std::nullopt;
  ClassBars figure(summary, *axis, style);
  for (const MethodSettings& method : summary.study.methods)
    figure.add_row(method.name, &method == &summary.study.methods.front());
  return figure.finish();
}

std::optional<FigureSheet> class_figure(const StudySummary& summary, const StudyLayout& layout) {
  const std::vector<const SemanticClass*> classes = classes_shown(summary);
  if (classes.size() < 2 || layout.named()) return std::nullopt;
  if (layout.style().width_mm && layout.columns().size() > 1)
    return class_figure(summary, layout.with_columns(1));
  std::vector<CurveScore> scores;
  for (const SemanticClass* c : classes) {
    const std::string title = class_title(summary.study, c->name);
    scores.push_back({c->name, "f1", title, "F1, " + title});
  }
  return curve_figure(summary, layout, "by_class", scores, "F1",
                      study_caption(summary) + spread_caption(summary.study) +
                          " F1 at tolerance 0, counts pooled over seeds." +
                          cut_caption(summary, classes.size()) + ' ' + kCeilingsCaption);
}

}  // namespace mapscore::eval
