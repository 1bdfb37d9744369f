// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#include "eval/report/figures/figures.hpp"

#include "core/whole_file.hpp"
#include "eval/report/figures/curves.hpp"
#include "eval/report/figures/scatter.hpp"
#include "eval/report/tables/table_formats.hpp"

#include <fmt/format.h>

#include <utility>

namespace mapscore::eval {
namespace {

namespace fs = std::filesystem;

/// Of the pooled classes, with the same title above a panel and left of a row.
CurveScore pooled_score(const std::string& metric, const std::string& title) {
  return {std::string(kPooled), metric, title, title};
}

/// The lines of the first method: all map from the same poses.
StudySummary of_first_method(const StudySummary& summary) {
  StudySummary first = summary;
  first.study.methods.erase(first.study.methods.begin() + 1, first.study.methods.end());
  first.study.methods.front().title = "poses";
  const auto is_other = [&](const ResultLine& line) {
    return line.method != first.study.methods.front().name;
  };
  for (auto* lines : {&first.trials, &first.registration_ceilings, &first.lattice_ceilings})
    std::erase_if(*lines, is_other);
  return first;
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

std::optional<FigureSheet> pose_figure(const StudySummary& summary, const FigureStyle& style) {
  if (!summary.has_metric("ate_m")) return std::nullopt;
  const StudySummary poses = of_first_method(summary);
  std::vector<CurveScore> scores;
  const auto add = [&](const std::string& metric, const std::string& title, OwnAxis axis = {}) {
    scores.push_back(pooled_score(metric, title));
    scores.back().own_axis = axis;
  };
  add("ate_m", "ATE (m)");
  add("ate_aligned_m", "ATE, aligned (m)");
  add("rpe_percent", "RPE (% of the way)");
  add("rpe_deg_per_m", "RPE (deg/m)");
  add("nees_share", "NEES x y yaw: share in band", {1.03, 0.95});
  add("nees_mean", "NEES x y yaw: mean", {4.0, 3.0});
  return curve_figure(poses, StudyLayout(poses, style), "poses", scores, "",
                      fmt::format("{}: errors of the poses that are mapped from, all frames.{} "
                                  "Dashed: an honest covariance.",
                                  summary.study.name, spread_caption(summary.study)));
}

std::vector<fs::path> draw_figures(const StudySummary& summary, const fs::path& folder,
                                   const FigureStyle& style) {
  if (points_of(summary.study.sampling) > 0) return draw(scatter_figure(summary, style), folder);
  const StudyLayout layout(summary, style);
  std::vector<FigureSheet> sheets{accuracy_figure(summary, layout), causes_figure(summary, layout)};
  if (auto poses = pose_figure(summary, style)) sheets.push_back(std::move(*poses));
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
