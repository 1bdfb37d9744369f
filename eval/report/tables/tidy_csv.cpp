// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#include "eval/report/tables/tidy_csv.hpp"

#include "eval/report/best_threshold.hpp"
#include "eval/report/tables/table.hpp"
#include "files/csv.hpp"

#include <fmt/format.h>

#include <ostream>

namespace mapscore::eval {
namespace {

template <class Owner>
void append_counts(const Owner& owner, std::vector<Metric>& metrics) {
  for (const CountField<Owner>& field : Owner::counts())
    if (field.in_tables)
      metrics.push_back({std::string(field.name), static_cast<double>(owner.*field.member)});
}

std::vector<Metric> counts_as_metrics(const ClassCounts& counts) {
  std::vector<Metric> metrics;
  append_counts(counts, metrics);
  for (const ToleranceCounts& at : counts.at_tolerance) {
    metrics.push_back({fmt::format("true_predicted_t{}", at.voxels), double(at.true_predicted)});
    metrics.push_back({fmt::format("found_t{}", at.voxels), double(at.found)});
  }
  for_each_part(counts, [&](const char*, const auto& part) { append_counts(part, metrics); });
  return metrics;
}

/// The bins of a reliability curve that hold any: how many, the share that was right, and the mean
/// confidence.
void append_bins(const Reliability& reliability, const std::string& name,
                 std::vector<Metric>& metrics) {
  for (std::size_t n = 0; n < reliability.bins.size(); ++n) {
    const ConfidenceBin& bin = reliability.bins[n];
    if (bin.count == 0) continue;
    const std::string of_bin = fmt::format("{}_bin{}", name, n + 1);
    metrics.push_back({of_bin, static_cast<double>(bin.count)});
    metrics.push_back({of_bin + "_right", ratio(bin.right, bin.count)});
    metrics.push_back(
        {of_bin + "_confidence", ratio(bin.confidence_sum_nano, bin.count * kBillion)});
  }
}

/// What is counted of a class's detections beside plain counts, where there is any: how sure they
/// were, and, of one class, what its pixels were taken for.
void append_label_details(const LabelCounts& labels, const ClassTable& table, bool of_class,
                          std::vector<Metric>& metrics) {
  for (std::size_t c = 0; of_class && c < labels.named_as.size(); ++c)
    if (labels.named_as[c] > 0)
      metrics.push_back(
          {"label_taken_for:" + table.classes.at(c).name, static_cast<double>(labels.named_as[c])});
  append_bins(labels.scores, "label_score", metrics);
  append_bins(labels.pixels, "label_pixel", metrics);
}

/// `best`: of each of the summary's groups.
void write_result(const ResultLine& line, std::size_t seed, const StudySummary& summary,
                  const std::vector<BestThreshold>& best, std::ostream& out) {
  std::vector<std::string> head{name_of(line.role), line.method, std::to_string(line.seeds[seed])};
  for (const auto& [path, value] : line.cell.doses) head.push_back(value);
  std::string first_cells = csv_line(head);
  first_cells.back() = ',';
  const auto write = [&](const std::string& group, const std::string& metric,
                         const std::string& value) {
    out << first_cells << csv_line({group, metric, value});
  };
  const TrialResult& result = line.results[seed];
  const std::vector<std::string> groups = summary.groups();
  for (std::size_t g = 0; g < groups.size(); ++g) {
    for (const Metric& metric : tidy_metrics(result.counts, summary.table, groups[g]))
      write(groups[g], metric.name, nine_digits(metric.value));
    write(groups[g], kBestF1, nine_digits(best[g].by_seed[seed].f1));
    write(groups[g], kBestThreshold, nine_digits(best[g].by_seed[seed].threshold));
  }
  const auto write_counts = [&]<class Owner>(const Owner& owner) {
    for (const CountField<Owner>& field : Owner::counts())
      write("all", std::string(field.name), std::to_string(owner.*field.member));
  };
  write_counts(result.accounting);
  if (const auto& tracking = result.accounting.tracking) write_counts(*tracking);
  if (const auto& calibration = result.accounting.calibration) write_counts(*calibration);
}

void write_line(const ResultLine& line, const StudySummary& summary, std::ostream& out) {
  std::vector<BestThreshold> best;
  for (const std::string& group : summary.groups())
    best.push_back(best_threshold(line, summary.table, group));
  for (std::size_t seed = 0; seed < line.results.size(); ++seed)
    write_result(line, seed, summary, best, out);
}

}  // namespace

std::vector<Metric> tidy_metrics(const Counts& counts, const ClassTable& table,
                                 std::string_view group) {
  std::vector<Metric> metrics;
  if (group != kMacro) {
    const ClassCounts of_group = counts_of_group(counts, table, group);
    metrics = counts_as_metrics(of_group);
    if (of_group.labels) append_label_details(*of_group.labels, table, group != kPooled, metrics);
  }
  for (Metric& metric : metrics_of_group(counts, table, group))
    metrics.push_back(std::move(metric));
  return metrics;
}

void write_tidy_csv(const StudySummary& summary, std::ostream& out) {
  std::vector<std::string> columns{"role", "method", "seed"};
  for (const SweepAxis& axis : summary.study.sweep) columns.push_back(axis.path);
  columns.insert(columns.end(), {"class", "metric", "value"});
  out << csv_line(columns);
  for (const auto* lines :
       {&summary.trials, &summary.registration_ceilings, &summary.lattice_ceilings})
    for (const ResultLine& line : *lines) write_line(loaded(line), summary, out);
}

void write_frames_csv(std::span<const FrameResult> frames, const ClassTable& table,
                      std::ostream& out) {
  std::vector<std::string> groups = detected_names(table);
  groups.emplace_back(kPooled);
  out << csv_line({"frame", "stamp_s", "class", "metric", "value"});
  for (const FrameResult& frame : frames) {
    const std::string index = std::to_string(frame.frame), stamp = fmt::format("{}", frame.stamp_s);
    for (const std::string& group : groups)
      for (const Metric& metric : tidy_metrics(frame.counts, table, group))
        out << csv_line({index, stamp, group, metric.name, nine_digits(metric.value)});
  }
}

}  // namespace mapscore::eval
