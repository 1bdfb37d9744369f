// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#include "eval/report/figures/accuracy.hpp"

#include "eval/report/figures/curves.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <string>
#include <utility>
#include <vector>

namespace mapscore::eval {
namespace {

constexpr std::size_t kClassesShown = 12;
constexpr std::size_t kClassColumns = 3;

struct Shown {
  std::string metric, title;
};

const std::vector<Shown> kVoxelScores{
    {"precision", "precision"}, {"recall", "recall"}, {"f1", "F1"}};
const std::vector<Shown> kDistanceScores{{"precision_2cm", "precision within 2 cm"},
                                         {"recall_2cm", "recall within 2 cm"},
                                         {"f_2cm", "F within 2 cm"}};

bool has_metric(const StudySummary& summary, const std::string& name) {
  if (summary.trials.empty()) return false;
  const auto metrics = metrics_of_group(summary.trials.front().pooled, summary.table, kPooled);
  return std::any_of(metrics.begin(), metrics.end(),
                     [&](const Metric& metric) { return metric.name == name; });
}

std::string accuracy_caption(const StudySummary& summary) {
  return study_caption(summary) + spread_caption(summary.study) +
         " Counts pooled over classes and seeds. " + kCeilingsCaption;
}

/// One swept axis: a column a score.
void add_scores_by_column(const std::vector<Shown>& scores, bool last_row, CurveFigure& figure) {
  for (const Shown& score : scores)
    figure.add({std::string(kPooled), score.metric, 0, score.title,
                &score == &scores.front() ? "score" : "", last_row, &score == &scores.front()});
}

/// Two and more: a row a score, a column a value of the second axis.
void add_scores_by_row(const std::vector<Shown>& scores, const StudyLayout& layout,
                       CurveFigure& figure) {
  for (const Shown& score : scores)
    for (std::size_t c = 0; c < layout.columns().size(); ++c)
      figure.add({std::string(kPooled), score.metric, c,
                  &score == &scores.front() ? layout.columns()[c] : "", c == 0 ? score.title : "",
                  &score == &scores.back(), c == 0});
}

void add_classes_wrapped(const std::vector<const SemanticClass*>& classes, CurveFigure& figure) {
  for (std::size_t i = 0; i < classes.size(); ++i) {
    const bool first = i % kClassColumns == 0;
    figure.add({classes[i]->name, "f1", 0, classes[i]->name, first ? "F1" : "",
                i + kClassColumns >= classes.size(), first});
  }
}

void add_classes_by_row(const std::vector<const SemanticClass*>& classes, const StudyLayout& layout,
                        CurveFigure& figure) {
  for (const SemanticClass* c : classes)
    for (std::size_t column = 0; column < layout.columns().size(); ++column)
      figure.add({c->name, "f1", column, c == classes.front() ? layout.columns()[column] : "",
                  column == 0 ? "F1, " + c->name : "", c == classes.back(), column == 0});
}

}  // namespace

std::vector<const SemanticClass*> classes_shown(const StudySummary& summary) {
  std::vector<std::pair<std::int64_t, const SemanticClass*>> seen;
  for (const SemanticClass& c : summary.table.classes) {
    const std::int64_t visible =
        summary.trials.empty() ? 0 : summary.trials.front().pooled.at(c.id).visible;
    if (c.detect && visible > 0) seen.emplace_back(visible, &c);
  }
  std::stable_sort(seen.begin(), seen.end(),
                   [](const auto& a, const auto& b) { return a.first > b.first; });
  seen.resize(std::min(seen.size(), kClassesShown));
  std::vector<const SemanticClass*> shown;
  for (const auto& [visible, c] : seen) shown.push_back(c);
  std::sort(shown.begin(), shown.end(),
            [](const SemanticClass* a, const SemanticClass* b) { return a->id < b->id; });
  return shown;
}

std::string cut_caption(const StudySummary& summary, std::size_t shown) {
  const std::size_t detected = summary.groups().size() - 2;
  return shown < detected
             ? fmt::format(" {} of {} detected classes, those with most visible voxels.", shown,
                           detected)
             : "";
}

FigureSheet accuracy_figure(const StudySummary& summary, const StudyLayout& layout) {
  const bool distances = has_metric(summary, "f_2cm");
  const std::string name = layout.figure_name("accuracy");
  if (layout.columns().size() == 1) {
    CurveFigure figure(summary, layout, name, static_cast<int>(kVoxelScores.size()));
    add_scores_by_column(kVoxelScores, !distances, figure);
    if (distances) add_scores_by_column(kDistanceScores, true, figure);
    return figure.finish(accuracy_caption(summary));
  }
  std::vector<Shown> scores = kVoxelScores;
  if (distances) scores.push_back(kDistanceScores.back());
  CurveFigure figure(summary, layout, name, static_cast<int>(layout.columns().size()));
  add_scores_by_row(scores, layout, figure);
  return figure.finish(accuracy_caption(summary));
}

std::optional<FigureSheet> class_figure(const StudySummary& summary, const StudyLayout& layout) {
  const std::vector<const SemanticClass*> classes = classes_shown(summary);
  if (classes.size() < 2 || layout.named()) return std::nullopt;
  const bool wrap = layout.columns().size() == 1;
  CurveFigure figure(
      summary, layout, layout.figure_name("by_class"),
      static_cast<int>(wrap ? std::min(kClassColumns, classes.size()) : layout.columns().size()));
  if (wrap)
    add_classes_wrapped(classes, figure);
  else
    add_classes_by_row(classes, layout, figure);
  return figure.finish(study_caption(summary) + spread_caption(summary.study) +
                       " F1 at tolerance 0, counts pooled over seeds." +
                       cut_caption(summary, classes.size()) + ' ' + kCeilingsCaption);
}

}  // namespace mapscore::eval
