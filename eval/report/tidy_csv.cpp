// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#include "eval/report/tidy_csv.hpp"

#include <ostream>

#include <fmt/format.h>

namespace mapscore::eval {
namespace {

std::vector<Metric> counts_as_metrics(const ClassCounts& c) {
  const auto count = [](const char* name, std::int64_t value) {
    return Metric{name, static_cast<double>(value)};
  };
  std::vector<Metric> metrics{count("predicted", c.predicted),
                              count("true_predicted", c.true_predicted),
                              count("visible", c.visible),
                              count("found", c.found),
                              count("false_near", c.false_near),
                              count("false_leak", c.false_leak),
                              count("false_floating", c.false_floating),
                              count("missed_mislabelled", c.missed_mislabelled),
                              count("missed_unlabelled", c.missed_unlabelled),
                              count("missed_unmapped", c.missed_unmapped)};
  for (const ToleranceCounts& at : c.at_tolerance) {
    metrics.push_back(count(fmt::format("true_predicted_t{}", at.voxels).c_str(), at.true_predicted));
    metrics.push_back(count(fmt::format("found_t{}", at.voxels).c_str(), at.found));
  }
  return metrics;
}

std::vector<Metric> all_metrics(const Counts& counts, const ClassTable& table,
                                const std::string& group) {
  std::vector<Metric> metrics;
  if (group == kPooled) metrics = counts_as_metrics(pool_detected(counts, table));
  for (const SemanticClass& c : table.classes)
    if (c.name == group) metrics = counts_as_metrics(counts.at(c.id));
  for (Metric& metric : metrics_of_group(counts, table, group)) metrics.push_back(std::move(metric));
  return metrics;
}

std::string text_of(const std::optional<double>& value) {
  return value ? fmt::format("{:.9g}", *value) : "-";
}

void write_line(const ResultLine& line, const StudySummary& summary, std::ostream& out) {
  std::string doses;
  for (const auto& [path, value] : line.cell.doses) doses += value + ",";
  for (std::size_t i = 0; i < line.results.size(); ++i) {
    const std::string head =
        fmt::format("{},{},{},{}", name_of(line.role), line.method, line.seeds[i], doses);
    for (const std::string& group : summary.groups())
      for (const Metric& metric : all_metrics(line.results[i].counts, summary.table, group))
        out << fmt::format("{}{},{},{}\n", head, group, metric.name, text_of(metric.value));
    const Accounting& a = line.results[i].accounting;
    for (const auto& [name, value] : std::initializer_list<std::pair<const char*, std::int64_t>>{
             {"frames", a.frames},
             {"detections", a.detections},
             {"skipped_no_points", a.skipped_no_points},
             {"skipped_no_seed_point", a.skipped_no_seed_point},
             {"skipped_seed_off_object", a.skipped_seed_off_object},
             {"skipped_eroded_away", a.skipped_eroded_away},
             {"points", a.points},
             {"map_voxels", a.map_voxels}})
      out << fmt::format("{}{},{},{}\n", head, "all", name, value);
  }
}

}  // namespace

void write_tidy_csv(const StudySummary& summary, std::ostream& out) {
  out << "role,method,seed,";
  for (const SweepAxis& axis : summary.study.sweep) out << axis.path << ',';
  out << "class,metric,value\n";
  for (const auto* lines :
       {&summary.trials, &summary.registration_ceilings, &summary.lattice_ceilings})
    for (const ResultLine& line : *lines) write_line(line, summary, out);
}

}  // namespace mapscore::eval
