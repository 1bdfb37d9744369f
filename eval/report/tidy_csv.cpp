// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#include "eval/report/tidy_csv.hpp"

#include "eval/experiment/result_fields.hpp"
#include "eval/report/csv.hpp"

#include <fmt/format.h>

#include <ostream>

namespace mapscore::eval {
namespace {

std::vector<Metric> counts_as_metrics(const ClassCounts& c) {
  std::vector<Metric> metrics;
  const auto add = [&](const std::string& name, std::int64_t value) {
    metrics.push_back({name, static_cast<double>(value)});
  };
  for (const auto& [name, member] : kClassCountFields) add(name, c.*member);
  for (const ToleranceCounts& at : c.at_tolerance) {
    add(fmt::format("true_predicted_t{}", at.voxels), at.true_predicted);
    add(fmt::format("found_t{}", at.voxels), at.found);
  }
  return metrics;
}

std::vector<Metric> all_metrics(const Counts& counts, const ClassTable& table,
                                const std::string& group) {
  std::vector<Metric> metrics;
  if (group == kPooled) metrics = counts_as_metrics(pool_detected(counts, table));
  for (const SemanticClass& c : table.classes)
    if (c.name == group) metrics = counts_as_metrics(counts.at(c.id));
  for (Metric& metric : metrics_of_group(counts, table, group))
    metrics.push_back(std::move(metric));
  return metrics;
}

std::string text_of(const std::optional<double>& value) {
  return value ? fmt::format("{:.9g}", *value) : "-";
}

void write_result(const ResultLine& line, std::size_t seed, const StudySummary& summary,
                  std::ostream& out) {
  std::vector<std::string> head{name_of(line.role), line.method, std::to_string(line.seeds[seed])};
  for (const auto& [path, value] : line.cell.doses) head.push_back(value);
  const auto write = [&](const std::string& group, const std::string& metric,
                         const std::string& value) {
    std::vector<std::string> cells = head;
    cells.insert(cells.end(), {group, metric, value});
    out << csv_line(cells);
  };
  const TrialResult& result = line.results[seed];
  for (const std::string& group : summary.groups())
    for (const Metric& metric : all_metrics(result.counts, summary.table, group))
      write(group, metric.name, text_of(metric.value));
  for (const auto& [name, member] : kAccountingFields)
    write("all", name, std::to_string(result.accounting.*member));
}

}  // namespace

void write_tidy_csv(const StudySummary& summary, std::ostream& out) {
  std::vector<std::string> columns{"role", "method", "seed"};
  for (const SweepAxis& axis : summary.study.sweep) columns.push_back(axis.path);
  columns.insert(columns.end(), {"class", "metric", "value"});
  out << csv_line(columns);
  for (const auto* lines :
       {&summary.trials, &summary.registration_ceilings, &summary.lattice_ceilings})
    for (const ResultLine& line : *lines)
      for (std::size_t seed = 0; seed < line.results.size(); ++seed)
        write_result(line, seed, summary, out);
}

}  // namespace mapscore::eval
