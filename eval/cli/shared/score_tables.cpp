// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#include "eval/cli/shared/map_score.hpp"
#include "eval/report/tables/tidy_csv.hpp"
#include "eval/score/label_images.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

namespace mapscore::eval {
namespace {

/// Names of figures and the columns that show them.
using Columns = std::vector<std::pair<const char*, const char*>>;
/// Metrics of each class that is shown, then pooled and macro, by their names.
using Groups = std::vector<std::pair<std::string, std::vector<Metric>>>;

std::string number(const std::optional<double>& value) {
  return value ? fmt::format("{:.3f}", *value) : "-";
}

std::string exact(const std::optional<double>& value) {
  return value ? fmt::format("{:.9g}", *value) : "-";
}

/// Detected classes, and others that the map predicts.
std::vector<const SemanticClass*> shown_classes(const MapScore& score) {
  std::vector<const SemanticClass*> shown;
  for (const SemanticClass& c : score.table.classes)
    if (c.detect || score.counts[c.id].predicted > 0) shown.push_back(&c);
  return shown;
}

std::vector<std::string> figures(const std::string& group, const std::vector<Metric>& metrics,
                                 const Columns& columns) {
  std::vector<std::string> row{group};
  for (const auto& [name, title] : columns)
    row.push_back(number(metrics.empty() ? std::nullopt : value_of(metrics, name)));
  return row;
}

/// A scene has no samples, so nothing says how complete a map of it is: neither then is there an
/// F-score at a distance.
Groups voxel_groups(const MapScore& score) {
  Groups groups;
  for (const SemanticClass* c : shown_classes(score)) groups.push_back({c->name, {}});
  groups.push_back({std::string(kPooled), {}});
  groups.push_back({std::string(kMacro), {}});
  for (auto& [group, metrics] : groups) {
    metrics = tidy_metrics(score.counts, score.table, group);
    for (Metric& metric : metrics)
      if (!score.sampled && metric.name.starts_with("f_")) metric.value.reset();
    std::erase_if(metrics, [](const Metric& metric) { return metric.name.starts_with("box"); });
  }
  return groups;
}

Groups instance_groups(const MapScore& score) {
  Groups groups;
  for (const SemanticClass& c : score.table.classes)
    if (c.detect) groups.emplace_back(c.name, score.instances[c.id].metrics());
  groups.emplace_back(kPooled, pool_detected_instances(score.instances, score.table).metrics());
  groups.emplace_back(kMacro, macro_instance_metrics(score.instances, score.table));
  return groups;
}

Table table_of(std::vector<std::string> caption, const Groups& groups, const Columns& columns) {
  Table table{std::move(caption), {"class"}, {}};
  for (const auto& [name, title] : columns) table.columns.emplace_back(title);
  for (const auto& [group, metrics] : groups)
    table.rows.push_back(figures(group, metrics, columns));
  return table;
}

void append_counts(const ClassCounts& c, std::vector<std::string>& row) {
  for (const std::int64_t count :
       {c.predicted, c.true_predicted, c.false_near, c.false_leak, c.false_floating, c.visible,
        c.found, c.missed_mislabelled, c.missed_unlabelled, c.missed_unmapped})
    row.push_back(std::to_string(count));
}

std::vector<std::string> answers_of(const ClassTable& table, std::size_t columns) {
  std::vector<std::string> answers;
  for (const SemanticClass& c : table.classes) answers.push_back(c.name);
  for (const char* further : {"unlabelled", "unmapped"})
    if (answers.size() < columns) answers.emplace_back(further);
  return answers;
}

/// Rows and columns that hold nothing are left out.
Table confusion_table(const ConfusionMatrix& matrix, const ClassTable& table, const char* caption) {
  const std::vector<std::string> answers = answers_of(table, matrix.columns());
  Table cells{{caption}, {"what is there"}, {}};
  for (std::size_t column = 0; column < matrix.columns(); ++column)
    if (matrix.column_sum(column) > 0) cells.columns.push_back(answers[column]);
  for (std::size_t row = 0; row < matrix.class_count(); ++row) {
    if (matrix.row_sum(row) == 0) continue;
    std::vector<std::string> line{table.classes[row].name};
    for (std::size_t column = 0; column < matrix.columns(); ++column)
      if (matrix.column_sum(column) > 0) line.push_back(std::to_string(matrix.at(row, column)));
    cells.rows.push_back(std::move(line));
  }
  return cells;
}

Table probabilities_table(const MapScore& score, const Groups& groups) {
  Table table = table_of({"probabilities, over all thresholds",
                          "the best threshold is chosen on this very map, so F1 there flatters"},
                         groups, {{"ap", "AP"}, {"brier", "Brier"}, {"ece", "ECE"}});
  table.columns.insert(table.columns.end(), {"best threshold", "F1 there"});
  for (std::vector<std::string>& row : table.rows) {
    ClassCurve curve = pool_detected(score.counts, score.table).curve;
    for (const SemanticClass& c : score.table.classes)
      if (c.name == row.front()) curve = score.counts[c.id].curve;
    const auto best = best_f1_threshold(curve);
    row.push_back(number(best));
    row.push_back(number(best ? point_at(curve, best).f1 : std::nullopt));
  }
  std::fill_n(table.rows.back().rbegin(), 2, "-");  // macro has no curve
  return table;
}

Table occupancy_table(const OccupancyCounts& counts) {
  Table table{{"free, occupied, unknown: voxels in view of some frame, by what the map says"},
              {"truly", "occupied", "free", "not in the map"},
              {}};
  for (const auto& [name, row] :
       {std::pair{"occupied", counts.occupied}, std::pair{"free", counts.free}})
    table.rows.push_back({name, std::to_string(row.occupied), std::to_string(row.free),
                          std::to_string(row.unmapped)});
  for (const Metric& metric : occupancy_metrics(counts))
    table.caption.push_back(metric.name + " " + number(metric.value));
  return table;
}

void add_tidy(Table& table, const std::string& group, const std::vector<Metric>& metrics) {
  for (const Metric& metric : metrics)
    table.rows.push_back({group, metric.name, exact(metric.value)});
}

void add_tidy(Table& table, const ConfusionMatrix& matrix, const ClassTable& classes) {
  const std::vector<std::string> answers = answers_of(classes, matrix.columns());
  for (std::size_t row = 0; row < matrix.class_count(); ++row)
    for (std::size_t column = 0; column < matrix.columns(); ++column)
      if (matrix.at(row, column) > 0)
        table.rows.push_back({classes.classes[row].name, "taken_for:" + answers[column],
                              std::to_string(matrix.at(row, column))});
}

}  // namespace

Table class_table(const MapScore& score) {
  Table table = table_of({}, voxel_groups(score),
                         {{"precision", "precision"},
                          {"recall", "recall"},
                          {"f1", "F1"},
                          {"iou", "IoU"},
                          {"f1_t1", "F1 tol. 1"},
                          {"f_2cm", "F at 2 cm"},
                          {"ap", "AP"}});
  table.columns.insert(table.columns.end(),
                       {"predicted", "true", "near", "leak", "floating", "visible", "found",
                        "mislabelled", "unlabelled", "unmapped"});
  const std::vector<const SemanticClass*> shown = shown_classes(score);
  for (std::size_t n = 0; n < shown.size(); ++n)
    append_counts(score.counts[shown[n]->id], table.rows[n]);
  append_counts(pool_detected(score.counts, score.table), table.rows[shown.size()]);
  table.rows.back().resize(table.columns.size());  // macro has no counts
  return table;
}

std::vector<Table> detail_tables(const MapScore& score) {
  const Groups groups = voxel_groups(score);
  std::vector<Table> tables{
      table_of({"distances: F-score at 1 to 10 cm; accuracy and completeness in metres"}, groups,
               {{"f_1cm", "F at 1 cm"},
                {"f_2cm", "2 cm"},
                {"f_5cm", "5 cm"},
                {"f_10cm", "10 cm"},
                {"accuracy_mean_m", "accuracy"},
                {"accuracy_p95_m", "95 %"},
                {"completeness_mean_m", "completeness"},
                {"completeness_p95_m", "95 % "}}),
      probabilities_table(score, groups)};
  if (!score.instances.empty())
    tables.push_back(table_of({"instances: PQ of pairs with IoU above 0.5; AP by least IoU"},
                              instance_groups(score),
                              {{"pq", "PQ"},
                               {"sq", "SQ"},
                               {"rq", "RQ"},
                               {"ap_25", "AP 25"},
                               {"ap_50", "AP 50"},
                               {"ap_75", "AP 75"},
                               {"ap_mean", "AP 50-95"}}));
  tables.push_back(confusion_table(
      score.confusion, score.table,
      "confusion of voxels: visible ones by what is predicted there; background: predicted where "
      "nothing visible is"));
  if (score.occupancy) tables.push_back(occupancy_table(*score.occupancy));
  return tables;
}

Table tidy_table(const MapScore& score) {
  Table table{{}, {"class", "metric", "value"}, {}};
  for (const auto& [group, metrics] : voxel_groups(score)) add_tidy(table, group, metrics);
  if (!score.instances.empty())
    for (const auto& [group, metrics] : instance_groups(score)) add_tidy(table, group, metrics);
  if (score.occupancy) add_tidy(table, "all", occupancy_metrics(*score.occupancy));
  add_tidy(table, score.confusion, score.table);
  return table;
}

Table tables_beside(const std::vector<std::string>& names, const std::vector<Table>& tables) {
  Table all{{}, tables.front().columns, {}, 2};
  all.columns.insert(all.columns.begin() + 1, "map");
  std::vector<std::string> groups;
  for (const Table& table : tables) {
    for (const std::string& line : table.caption)
      if (std::ranges::find(all.caption, line) == all.caption.end()) all.caption.push_back(line);
    for (const auto& row : table.rows)
      if (std::ranges::find(groups, row.front()) == groups.end()) groups.push_back(row.front());
  }
  for (const std::string& group : groups)
    for (std::size_t n = 0; n < tables.size(); ++n)
      for (std::vector<std::string> row : tables[n].rows) {
        if (row.front() != group) continue;
        row.insert(row.begin() + 1, names[n]);
        all.rows.push_back(std::move(row));
      }
  return all;
}

std::vector<Table> label_tables(const LabelComparison& score, const ClassTable& table) {
  const ConfusionMatrix& matrix = score.pixels;
  Table by_class;
  for (const Metric& metric : label_metrics(score))
    by_class.caption.push_back(metric.name + " " + number(metric.value));
  by_class.columns = {"class", "accuracy", "IoU", "boundary F", "pixels", "labelled"};
  for (const SemanticClass& c : table.classes) {
    if (matrix.row_sum(c.id) == 0 && matrix.column_sum(c.id) == 0) continue;
    by_class.rows.push_back(figures(c.name, label_class_metrics(score, c.id),
                                    {{"accuracy", ""}, {"iou", ""}, {"boundary_f", ""}}));
    by_class.rows.back().push_back(std::to_string(matrix.row_sum(c.id)));
    by_class.rows.back().push_back(std::to_string(matrix.column_sum(c.id)));
  }
  return {by_class, confusion_table(matrix, table, "confusion of pixels")};
}

Table tidy_label_table(const LabelComparison& score, const ClassTable& table) {
  Table tidy{{}, {"class", "metric", "value"}, {}};
  add_tidy(tidy, "all", label_metrics(score));
  for (const SemanticClass& c : table.classes)
    add_tidy(tidy, c.name, label_class_metrics(score, c.id));
  add_tidy(tidy, score.pixels, table);
  return tidy;
}

}  // namespace mapscore::eval
