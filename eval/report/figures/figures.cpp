// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#include "eval/report/figures/figures.hpp"

#include "core/whole_file.hpp"
#include "eval/report/figures/curves.hpp"
#include "eval/report/figures/scatter.hpp"
#include "eval/report/table_formats.hpp"

namespace mapscore::eval {
namespace {

namespace fs = std::filesystem;

/// Of the pooled classes, with the same title above a panel and left of a row.
CurveScore pooled_score(const std::string& metric, const std::string& title) {
  return {std::string(kPooled), metric, title, title};
}

}  // namespace

FigureSheet accuracy_figure(const StudySummary& summary, const StudyLayout& layout) {
  std::vector<CurveScore> scores{pooled_score("precision", "precision"),
                                 pooled_score("recall", "recall"), pooled_score("f1", "F1")};
  if (summary.has_metric("f_2cm")) {
    if (layout.columns().size() == 1) {
      scores.push_back(pooled_score("precision_2cm", "precision within 2 cm"));
      scores.push_back(pooled_score("recall_2cm", "recall within 2 cm"));
    }
    scores.push_back(pooled_score("f_2cm", "F within 2 cm"));
  }
  return curve_figure(summary, layout, "accuracy", scores, "score",
                      study_caption(summary) + spread_caption(summary.study) +
                          " Counts pooled over classes and seeds. " + kCeilingsCaption);
}

std::vector<fs::path> draw_figures(const StudySummary& summary, const fs::path& folder,
                                   const FigureStyle& style) {
  if (points_of(summary.study.sampling) > 0) return draw(scatter_figure(summary, style), folder);
  const StudyLayout layout(summary, style);
  std::vector<FigureSheet> sheets{accuracy_figure(summary, layout), causes_figure(summary, layout)};
  if (auto heat_map = heat_map_figure(summary, layout)) sheets.push_back(std::move(*heat_map));
  if (auto by_class = class_bars_figure(summary, style)) sheets.push_back(std::move(*by_class));
  if (auto by_class = class_figure(summary, layout)) sheets.push_back(std::move(*by_class));
  sheets.push_back(precision_recall_figure(summary, layout));
  sheets.push_back(reliability_figure(summary, layout));
  if (auto pixels = pixel_reliability_figure(summary, layout)) sheets.push_back(std::move(*pixels));
  std::vector<fs::path> pictures;
  for (const FigureSheet& sheet : sheets)
    for (fs::path& file : draw(sheet, folder)) pictures.push_back(std::move(file));
  return pictures;
}

fs::path write_table(const StudySummary& summary, const fs::path& folder) {
  make_folder(folder);
  const fs::path file = folder / "table.txt";
  write_whole_file(file, to_text(score_table(summary, std::string(kPooled))) + '\n' +
                             to_text(score_table(summary, std::string(kMacro))));
  return file;
}

}  // namespace mapscore::eval
