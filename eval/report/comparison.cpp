// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#include "eval/report/comparison.hpp"

#include "core/error.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <map>

namespace mapscore::eval {
namespace {

void require(const char* what, const std::string& name, const std::vector<std::string>& known) {
  if (std::ranges::find(known, name) == known.end())
    throw Error(fmt::format("compare: no {} '{}' in this study; there are: {}", what, name,
                            fmt::join(known, ", ")));
}

std::vector<std::string> methods_of(const StudySummary& summary) {
  std::vector<std::string> names;
  for (const auto& method : summary.study.methods) names.push_back(method.name);
  return names;
}

/// Those of the group; pooled has them where no class of a macro mean is visible.
std::vector<std::string> metric_names(const StudySummary& summary, const std::string& group) {
  std::vector<std::string> names;
  if (summary.trials.empty()) return names;
  const Counts& counts = summary.trials.front().pooled;
  std::vector<Metric> metrics = metrics_of_group(counts, summary.table, group);
  if (metrics.empty()) metrics = metrics_of_group(counts, summary.table, kPooled);
  for (const Metric& metric : metrics) names.push_back(metric.name);
  names.insert(names.end(), {kBestF1, kBestThreshold});
  return names;
}

void check(const StudySummary& summary, const ComparisonQuestion& question) {
  for (const std::string& method : {question.a, question.b})
    require("method", method, methods_of(summary));
  if (question.a == question.b)
    throw Error(fmt::format("compare: '{}' with itself; give two of: {}", question.a,
                            fmt::join(methods_of(summary), ", ")));
  require("group", question.group, summary.groups());
  if (question.metrics.empty()) throw Error("compare: no metric; f1 is one");
  for (const std::string& metric : question.metrics) {
    require("metric", metric, metric_names(summary, question.group));
    if (std::ranges::count(question.metrics, metric) > 1)
      throw Error(fmt::format("compare: metric '{}' is given twice; once is enough", metric));
  }
}

const ResultLine& line_of(const StudySummary& summary, const Cell& cell,
                          const std::string& method) {
  const auto line = std::ranges::find_if(summary.trials, [&](const ResultLine& of) {
    return of.cell.index == cell.index && of.method == method;
  });
  if (line == summary.trials.end())
    throw Error(fmt::format("compare: method '{}' has no trials at cell {}; sweep the study again",
                            method, cell.index));
  return *line;
}

/// Whether all seeds, two and more, have the very same two values: nothing was drawn that this
/// figure depends on, so the seeds are one observation and tell nothing of chance.
bool is_one_value(const std::vector<std::optional<double>>& a,
                  const std::vector<std::optional<double>>& b) {
  const auto same = [](const auto& values) {
    return std::ranges::adjacent_find(values, std::not_equal_to<>()) == values.end();
  };
  return a.size() > 1 && same(a) && same(b);
}

/// Values of both lines, position by position the same seed; a seed that one lacks is undefined.
PairedComparison compare_lines(const ResultLine& a, const ResultLine& b,
                               const StudySummary& summary, const std::string& group,
                               const std::string& metric) {
  std::map<int, std::pair<std::optional<double>, std::optional<double>>> by_seed;
  const Estimate of_a = estimate(a, summary.table, group, metric);
  const Estimate of_b = estimate(b, summary.table, group, metric);
  for (std::size_t i = 0; i < a.seeds.size(); ++i) by_seed[a.seeds[i]].first = of_a.by_seed[i];
  for (std::size_t i = 0; i < b.seeds.size(); ++i) by_seed[b.seeds[i]].second = of_b.by_seed[i];
  std::vector<std::optional<double>> values_a, values_b;
  for (const auto& [seed, values] : by_seed) {
    values_a.push_back(values.first);
    values_b.push_back(values.second);
  }
  PairedComparison paired = compare_paired(values_a, values_b);
  if (is_one_value(values_a, values_b)) paired.p.reset();
  return paired;
}

std::string figure(const std::optional<double>& value) {
  return cell_text(value, "{:.4f}");
}

std::string signed_figure(const std::optional<double>& value) {
  if (value && std::abs(*value) < 0.00005) return "0.0000";
  return cell_text(value, "{:+.4f}");
}

std::string probability(const std::optional<double>& p) {
  if (p && *p < 0.001) return fmt::format("{:.1e}", *p);
  return figure(p);
}

std::string spread_note(int seeds) {
  if (seeds < kSeedsForInterval)
    return fmt::format(
        "low, high: least and greatest difference of the seeds, no interval (fewer than {} seeds)",
        kSeedsForInterval);
  return fmt::format(
      "low, high: 95 % interval of the mean difference ({}); range: fewer than {} pairs",
      kIntervalMethod, kSeedsForInterval);
}

std::vector<std::string> caption_of(const StudySummary& summary, const ComparisonQuestion& question,
                                    std::size_t rows) {
  const Study& study = summary.study;
  const double least = least_sign_flip_p(study.seeds);
  return {
      fmt::format("{}: {} - {}, {} classes; detected: {}", study.name, question.a, question.b,
                  question.group, fmt::join(detected_names(summary.table), ", ")),
      fmt::format("voxels of {} m; {} seed{}, paired seed by seed; each {} scored; figures: means "
                  "of one value a seed (`mapscore table` pools counts)",
                  study.voxel_m, study.seeds, study.seeds == 1 ? "" : "s",
                  study.score.unit == ScoreUnit::map ? "map" : "frame"),
      spread_note(study.seeds),
      fmt::format(
          "p: two-sided sign-flip permutation of the mean difference, {}; not corrected for "
          "{} row{}; p (Holm): corrected",
          study.seeds <= kExactSignFlips
              ? "exact"
              : fmt::format("exact up to {} differences other than 0, else by random sign patterns",
                            kExactSignFlips),
          rows, rows == 1 ? "" : "s") +
          "; - where all seeds have the same values, drawn from nothing",
      fmt::format("least p possible with {} pair{}: {}; p (Holm): {}", study.seeds,
                  study.seeds == 1 ? "" : "s", probability(least),
                  probability(std::min(1.0, least * static_cast<double>(rows))))};
}

}  // namespace

std::vector<ComparisonRow> compare_methods(const StudySummary& summary,
                                           const ComparisonQuestion& question) {
  check(summary, question);
  std::vector<ComparisonRow> rows;
  std::vector<std::optional<double>> p;
  for (const Cell& cell : cells(summary.study)) {
    const ResultLine& a = line_of(summary, cell, question.a);
    const ResultLine& b = line_of(summary, cell, question.b);
    for (const std::string& metric : question.metrics) {
      rows.push_back({cell, metric, compare_lines(a, b, summary, question.group, metric), {}});
      p.push_back(rows.back().paired.p);
    }
  }
  const std::vector<std::optional<double>> adjusted = holm_adjusted(p);
  for (std::size_t i = 0; i < rows.size(); ++i) rows[i].p_holm = adjusted[i];
  return rows;
}

Table comparison_table(const StudySummary& summary, const ComparisonQuestion& question,
                       Figures figures) {
  const std::vector<ComparisonRow> rows = compare_methods(summary, question);
  Table table;
  const auto with_p = std::ranges::count_if(
      rows, [](const ComparisonRow& row) { return row.paired.p.has_value(); });
  table.caption = caption_of(summary, question, static_cast<std::size_t>(with_p));
  for (const SweepAxis& axis : summary.study.sweep)
    table.columns.push_back(column_of(axis, summary.study.sweep));
  table.columns.insert(table.columns.end(),
                       {"metric", "mean " + question.a, "mean " + question.b, "difference", "low",
                        "high", "spread", "p", "p (Holm)", "pairs"});
  const auto text = [&](std::string (*rounded)(const std::optional<double>&)) {
    return figures == Figures::rounded ? rounded : nine_digits;
  };
  const auto mean = text(figure), difference = text(signed_figure), p = text(probability);
  for (const ComparisonRow& row : rows) {
    const PairedComparison& paired = row.paired;
    std::vector<std::string> cells;
    for (const auto& [path, value] : row.cell.doses) cells.push_back(value);
    cells.insert(cells.end(),
                 {row.metric, mean(paired.mean_a), mean(paired.mean_b),
                  difference(paired.difference.mean), difference(paired.difference.low),
                  difference(paired.difference.high), name_of(paired.difference.kind), p(paired.p),
                  p(row.p_holm), std::to_string(paired.difference.seeds)});
    table.rows.push_back(std::move(cells));
  }
  return table;
}

}  // namespace mapscore::eval
