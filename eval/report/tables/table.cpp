// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#include "eval/report/tables/table.hpp"

#include "core/error.hpp"
#include "eval/report/axes.hpp"
#include "eval/report/best_threshold.hpp"
#include "eval/report/tables/accounting_counts.hpp"
#include "files/suggestion.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>

namespace mapscore::eval {
namespace {

std::vector<std::string> caption_of(const StudySummary& summary, const std::string& group) {
  const Study& study = summary.study;
  std::vector<std::string> caption{
      fmt::format("{}: {} classes; detected: {}", study.name, group,
                  fmt::join(detected_names(summary.table), ", ")),
      scoring_text(study) + "; figures of counts pooled over seeds",
      study.seeds < kSeedsForInterval
          ? fmt::format("F1 low, high: least and greatest of the seeds (fewer than {})",
                        kSeedsForInterval)
          : fmt::format(
                "F1 low, high: 95 % interval of the mean of the seeds' own F1, beside which the "
                "pooled one may lie ({})",
                kIntervalMethod),
      study.seeds < kSeedsForBest
          ? fmt::format("AP: over all thresholds; F1 best, threshold: need {} seeds", kSeedsForBest)
          : fmt::format("AP: over all thresholds; F1 best: each seed at the threshold that is best "
                        "on the other {}; threshold: best on all {} seeds",
                        study.seeds - 1, study.seeds),
      "ceilings: lattice = true labels on the depth pixels, true pose; registration = the method "
      "at dose zero"};
  if (!summary.interim.empty()) caption.insert(caption.begin(), summary.interim);
  if (const std::string note = summary.lattice_note(); !note.empty())
    caption.push_back("note: " + note);
  std::ranges::copy(accounting_notes(summary), std::back_inserter(caption));
  if (summary.builds.size() > 1)
    caption.push_back(fmt::format("note: trials of {} builds stand side by side; sweep again",
                                  summary.builds.size()));
  if (study.score.asked.instances)
    caption.emplace_back("PQ: of instances; a predicted one is a connected piece of one class");
  if (study.score.asked.labels)
    caption.emplace_back(
        "2D: of detections in the image; IoU, accuracy, boundary F and ECE of pixels (pooled and "
        "macro: of background too), recall and PQ of instances");
  if (study.score.asked.poses)
    caption.emplace_back(
        "ATE, RPE, NEES: of the poses that are mapped from, the same for all methods and classes; "
        "NEES share: of frames in its 95 % band");
  return caption;
}

std::optional<double> share(std::int64_t part, std::int64_t of) {
  return of ? std::optional(static_cast<double>(part) / static_cast<double>(of)) : std::nullopt;
}

std::vector<std::string> row_of(const std::string& name, const ObjectCounts& c) {
  std::vector<std::string> row{name};
  for (const std::int64_t count : {c.truth, c.found, c.missed(), c.falsely()})
    row.push_back(std::to_string(count));
  row.push_back(cell_text(share(c.found, c.objects)));
  row.push_back(cell_text(share(c.found, c.truth)));
  row.push_back(cell_text(c.mean(c.iou_sum)));
  row.push_back(cell_text(c.mean(c.centre_sum_m)));
  row.push_back(c.found ? cell_text(c.centre_max_m) : "-");
  for (const double sum : c.size_sum_m) row.push_back(cell_text(c.mean(sum)));
  for (const double sum : c.size_share_sum) row.push_back(cell_text(c.mean(100.0 * sum)));
  return row;
}

}  // namespace

std::string cell_text(const std::optional<double>& value, std::string_view format) {
  return value ? fmt::format(fmt::runtime(format), *value) : "-";
}

std::string nine_digits(const std::optional<double>& value) {
  return cell_text(value, "{:.9g}");
}

void check_metric(const StudySummary& summary, const std::string& group,
                  const std::string& metric) {
  const Counts& counts = summary.trials.front().pooled;
  std::vector<Metric> metrics = metrics_of_group(counts, summary.table, group);
  // Those of pooled are there too where no class of a macro mean is visible.
  if (metrics.empty()) metrics = metrics_of_group(counts, summary.table, kPooled);
  std::vector<std::string> names{kBestF1, kBestThreshold};
  for (const Metric& known : metrics) names.push_back(known.name);
  require_one_of(names, metric, fmt::format("no metric '{}' in this study", metric));
}

std::string scoring_text(const Study& study) {
  return fmt::format("voxels of {:.6g} cm; {} seed{}; each {} scored", 100.0 * study.voxel_m,
                     study.seeds, study.seeds == 1 ? "" : "s",
                     study.score.unit == ScoreUnit::map ? "map" : "frame");
}

std::string column_of(const SweepAxis& axis, const std::vector<SweepAxis>& sweep) {
  const auto last_part = [](const SweepAxis& of) { return of.path.substr(of.path.rfind('.') + 1); };
  const auto alike = std::count_if(sweep.begin(), sweep.end(), [&](const SweepAxis& other) {
    return last_part(other) == last_part(axis);
  });
  return alike == 1 ? last_part(axis) : axis.path;
}

std::vector<std::string> dose_columns(const Study& study, Reader reader) {
  std::vector<std::string> columns;
  for (const SweepAxis& axis : study.sweep)
    columns.push_back(reader == Reader::paper ? figure_axis(study, axis).title()
                                              : column_of(axis, study.sweep));
  return columns;
}

std::vector<std::string> dose_texts(const Study& study, const Cell& cell, Reader reader) {
  std::vector<std::string> texts;
  for (const auto& [path, value] : cell.doses)
    texts.push_back(reader == Reader::paper ? figure_axis(study, {path, {value}}).values.front()
                                            : value);
  return texts;
}

std::string method_text(const Study& study, const std::string& name, Reader reader) {
  return reader == Reader::paper ? method_title(study, name) : name;
}

std::string metric_text(const std::string& name, Reader reader) {
  if (reader != Reader::paper) return name;
  for (const auto& [metric, text] : {std::pair{"f1", "F1"},
                                     {"iou", "IoU"},
                                     {"ap", "AP"},
                                     {"pq", "PQ"},
                                     {"f1_best", "F1 best"},
                                     {"ate_m", "ATE (m)"},
                                     {"ate_aligned_m", "ATE, aligned (m)"},
                                     {"ate_deg", "ATE (deg)"},
                                     {"rpe_percent", "RPE (%)"},
                                     {"rpe_deg_per_m", "RPE (deg/m)"},
                                     {"nees_share", "NEES share"},
                                     {"nees_mean", "NEES mean"},
                                     {"nees6_share", "NEES share, 6 axes"},
                                     {"nees6_mean", "NEES mean, 6 axes"}})
    if (name == metric) return text;
  const std::size_t last = name.rfind('_');
  if (last == name.npos || !name.ends_with("cm")) return spaced(name);
  const std::string distance = name.substr(last + 1, name.size() - last - 3);
  return fmt::format("{} at {} cm", name.starts_with("f_") ? "F" : name.substr(0, last), distance);
}

Table score_table(const StudySummary& summary, const std::string& group, Reader reader) {
  const auto text = [&](const std::optional<double>& value) {
    return reader == Reader::program ? nine_digits(value) : cell_text(value);
  };
  Table table;
  table.caption = caption_of(summary, group);
  std::vector<std::pair<std::string, std::string>> metrics{
      {"precision", "precision"}, {"recall", "recall"}, {"F1", "f1"}, {"IoU", "iou"}};
  const auto has_value = [&](const std::string& metric) {
    return std::ranges::any_of(summary.trials, [&](const ResultLine& line) {
      return estimate(line, summary.table, group, metric).pooled.has_value();
    });
  };
  for (const auto& [title, name] :
       std::vector<std::pair<std::string, std::string>>{{"F1 tol. 1", "f1_t1"},
                                                        {"F at 2 cm", "f_2cm"},
                                                        {"PQ", "pq"},
                                                        {"2D IoU", "label_iou"},
                                                        {"2D accuracy", "label_accuracy"},
                                                        {"2D recall", "label_instance_recall"},
                                                        {"2D PQ", "label_pq"},
                                                        {"2D boundary F", "label_boundary_f"},
                                                        {"2D ECE", "label_pixel_ece"},
                                                        {"ATE (m)", "ate_m"},
                                                        {"RPE (%)", "rpe_percent"},
                                                        {"RPE (deg/m)", "rpe_deg_per_m"},
                                                        {"NEES share", "nees_share"}})
    if (summary.has_metric(name) && has_value(name)) metrics.emplace_back(title, name);
  metrics.insert(metrics.end(),
                 {{"AP", "ap"}, {"F1 best", kBestF1}, {"threshold", kBestThreshold}});

  table.columns = dose_columns(summary.study, reader);
  table.columns.emplace_back("method");
  table.keys = table.columns.size();
  if (!summary.interim.empty()) table.columns.push_back("seeds there");
  for (const auto& [title, name] : metrics) table.columns.push_back(title);
  table.columns.insert(table.columns.end(), {"F1 low", "F1 high", "registration F1",
                                             "lattice precision", "lattice recall"});
  if (reader == Reader::program) table.columns.emplace_back("F1 spread");

  for (std::size_t i = 0; i < summary.trials.size(); ++i) {
    const ResultLine& line = summary.trials[i];
    const auto pooled = [&](const ResultLine& of, const std::string& metric) {
      return text(estimate(of, summary.table, group, metric).pooled);
    };
    std::vector<std::string> row = dose_texts(summary.study, line.cell, reader);
    row.push_back(method_text(summary.study, line.method, reader));
    if (!summary.interim.empty()) row.push_back(std::to_string(line.seeds.size()));
    for (const auto& [title, name] : metrics) row.push_back(pooled(line, name));
    const SeedSummary spread = estimate(line, summary.table, group, "f1").over_seeds;
    row.insert(row.end(), {text(spread.low), text(spread.high)});
    row.push_back(pooled(summary.registration_ceilings[i], "f1"));
    row.push_back(pooled(summary.lattice_ceilings[i], "precision"));
    row.push_back(pooled(summary.lattice_ceilings[i], "recall"));
    if (reader == Reader::program) row.emplace_back(name_of(spread.kind));
    table.rows.push_back(std::move(row));
  }
  return table;
}

Table object_table(const std::vector<ObjectCounts>& counts, const ClassTable& table) {
  Table scores;
  scores.columns = {"class",    "truth",          "found",          "missed",
                    "false",    "precision",      "recall",         "box IoU",
                    "centre_m", "max_m",          "size_x_m",       "size_y_m",
                    "size_z_m", "size_x_percent", "size_y_percent", "size_z_percent"};
  ObjectCounts all;
  for (const SemanticClass& c : table.classes) {
    const ObjectCounts& of_class = counts.at(c.id);
    if (!c.detect || (of_class.truth == 0 && of_class.objects == 0)) continue;
    scores.rows.push_back(row_of(c.name, of_class));
    all += of_class;
  }
  scores.rows.push_back(row_of("all", all));
  return scores;
}

}  // namespace mapscore::eval
