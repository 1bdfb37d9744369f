// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#include "eval/report/table.hpp"

#include "eval/report/lattice_check.hpp"
#include "files/csv.hpp"
#include "files/text.hpp"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstdint>

namespace mapscore::eval {
namespace {

std::string number(const std::optional<double>& value) {
  return value ? fmt::format("{:.3f}", *value) : "-";
}

std::string spread(const SeedSummary& seeds) {
  return seeds.low && seeds.high ? fmt::format("{:.3f}..{:.3f}", *seeds.low, *seeds.high) : "-";
}

bool has_metric(const ResultLine& line, const StudySummary& summary, const std::string& name) {
  const auto metrics = metrics_of_group(line.pooled, summary.table, kPooled);
  return std::any_of(metrics.begin(), metrics.end(),
                     [&](const Metric& metric) { return metric.name == name; });
}

std::vector<std::string> caption_of(const StudySummary& summary, const std::string& group) {
  const Study& study = summary.study;
  std::string detected;
  for (const SemanticClass& c : summary.table.classes)
    if (c.detect) detected += (detected.empty() ? "" : ", ") + c.name;
  std::vector<std::string> caption{
      fmt::format("{}: {} classes; detected: {}", study.name, group, detected),
      fmt::format("voxels of {} m; {} seed{}; each {} scored; figures of counts pooled over seeds",
                  study.voxel_m, study.seeds, study.seeds == 1 ? "" : "s",
                  study.score.unit == ScoreUnit::map ? "map" : "frame"),
      study.seeds < kSeedsForInterval
          ? fmt::format("F1 spread: least and greatest of the seeds (fewer than {})",
                        kSeedsForInterval)
          : fmt::format("F1 spread: 95 % interval of the mean over seeds ({})", kIntervalMethod),
      "AP: over all thresholds; F1 best: each seed at the threshold that is best on the others; "
      "threshold: best on all seeds",
      "ceilings: lattice = true labels on the depth pixels, true pose; registration = the method "
      "at dose "
      "zero"};
  LatticeCheck check(summary.table);
  for (const ResultLine& line : summary.lattice_ceilings)
    for (const TrialResult& result : line.results) check.add(result.counts);
  if (const std::string note = check.note(); !note.empty()) caption.push_back("note: " + note);
  if (study.score.asked.instances)
    caption.emplace_back("PQ: of instances; a predicted one is a connected piece of one class");
  return caption;
}

std::string padded(const std::string& text, std::size_t width) {
  return text + std::string(width - std::min(width, text.size()), ' ');
}

}  // namespace

std::string column_of(const SweepAxis& axis, const std::vector<SweepAxis>& sweep) {
  const auto last_part = [](const SweepAxis& of) { return of.path.substr(of.path.rfind('.') + 1); };
  const auto alike = std::count_if(sweep.begin(), sweep.end(), [&](const SweepAxis& other) {
    return last_part(other) == last_part(axis);
  });
  return alike == 1 ? last_part(axis) : axis.path;
}

Table score_table(const StudySummary& summary, const std::string& group) {
  Table table;
  table.caption = caption_of(summary, group);
  std::vector<std::pair<std::string, std::string>> metrics{
      {"precision", "precision"}, {"recall", "recall"}, {"F1", "f1"}, {"IoU", "iou"}};
  for (const auto& [title, name] : std::vector<std::pair<std::string, std::string>>{
           {"F1 tol. 1", "f1_t1"}, {"F at 2 cm", "f_2cm"}, {"PQ", "pq"}})
    if (!summary.trials.empty() && has_metric(summary.trials.front(), summary, name))
      metrics.emplace_back(title, name);
  for (const auto& [title, name] : std::vector<std::pair<std::string, std::string>>{
           {"AP", "ap"}, {"F1 best", kBestF1}, {"threshold", kBestThreshold}})
    metrics.emplace_back(title, name);

  for (const SweepAxis& axis : summary.study.sweep)
    table.columns.push_back(column_of(axis, summary.study.sweep));
  table.columns.push_back("method");
  for (const auto& [title, name] : metrics) table.columns.push_back(title);
  for (const char* title : {"F1 spread", "registration F1", "lattice precision", "lattice recall"})
    table.columns.emplace_back(title);

  for (std::size_t i = 0; i < summary.trials.size(); ++i) {
    const ResultLine& line = summary.trials[i];
    const auto pooled = [&](const ResultLine& of, const std::string& metric) {
      return number(estimate(of, summary.table, group, metric).pooled);
    };
    std::vector<std::string> row;
    for (const auto& [path, value] : line.cell.doses) row.push_back(value);
    row.push_back(line.method);
    for (const auto& [title, name] : metrics) row.push_back(pooled(line, name));
    row.push_back(spread(estimate(line, summary.table, group, "f1").over_seeds));
    row.push_back(pooled(summary.registration_ceilings[i], "f1"));
    row.push_back(pooled(summary.lattice_ceilings[i], "precision"));
    row.push_back(pooled(summary.lattice_ceilings[i], "recall"));
    table.rows.push_back(std::move(row));
  }
  return table;
}

std::string to_text(const Table& table) {
  std::vector<std::size_t> widths;
  for (const std::string& column : table.columns) widths.push_back(shown(column).size());
  for (const auto& row : table.rows)
    for (std::size_t i = 0; i < row.size(); ++i)
      widths[i] = std::max(widths[i], shown(row[i]).size());
  const auto line = [&](const std::vector<std::string>& cells) {
    std::string text;
    for (std::size_t i = 0; i < cells.size(); ++i)
      text += (i ? "  " : "") + padded(shown(cells[i]), widths[i]);
    return text.substr(0, text.find_last_not_of(' ') + 1) + '\n';
  };
  std::string text;
  for (const std::string& caption : table.caption) text += "# " + shown(caption) + '\n';
  text += line(table.columns);
  for (const auto& row : table.rows) text += line(row);
  return text;
}

std::string to_csv(const Table& table) {
  std::string text = csv_line(table.columns);
  for (const auto& row : table.rows) text += csv_line(row);
  return text;
}

namespace {

/// Numbers as numbers, `-` and nothing as null, anything else as text.
nlohmann::ordered_json json_of(const std::string& cell) {
  if (cell == "-" || cell.empty()) return nullptr;
  const char *begin = cell.data() + (cell.starts_with('+') ? 1 : 0),
             *end = cell.data() + cell.size();
  std::int64_t whole = 0;
  if (const auto read = std::from_chars(begin, end, whole);
      read.ec == std::errc() && read.ptr == end)
    return whole;
  double number = 0.0;
  if (const auto read = std::from_chars(begin, end, number);
      read.ec == std::errc() && read.ptr == end && std::isfinite(number))
    return number;
  return shown(cell);
}

nlohmann::ordered_json json_of(const Table& table) {
  nlohmann::ordered_json object{{"caption", nlohmann::ordered_json::array()},
                                {"rows", nlohmann::ordered_json::array()}};
  for (const std::string& line : table.caption) object["caption"].push_back(shown(line));
  for (const auto& row : table.rows) {
    nlohmann::ordered_json entry;
    for (std::size_t i = 0; i < row.size(); ++i) entry[shown(table.columns[i])] = json_of(row[i]);
    object["rows"].push_back(std::move(entry));
  }
  return object;
}

}  // namespace

std::string to_json(const Table& table) {
  return json_of(table).dump(2) + '\n';
}

std::string to_json(const std::vector<Table>& tables) {
  nlohmann::ordered_json list = nlohmann::ordered_json::array();
  for (const Table& table : tables) list.push_back(json_of(table));
  return list.dump(2) + '\n';
}

}  // namespace mapscore::eval
