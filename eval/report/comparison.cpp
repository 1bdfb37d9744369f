// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#include "eval/report/comparison.hpp"

#include "core/error.hpp"
#include "eval/report/comparable.hpp"
#include "files/suggestion.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <functional>
#include <map>

namespace mapscore::eval {
namespace {

void require(const char* what, const std::string& name, const std::vector<std::string>& known) {
  require_one_of(known, name, fmt::format("compare: no {} '{}' in this study", what, name));
}

void check_methods(const StudySummary& summary, const ComparisonQuestion& question) {
  for (const std::string& method : {question.a, question.b})
    require("method", method, method_names(summary.study));
  if (question.a == question.b)
    throw Error(fmt::format("compare: '{}' with itself; give two of: {}", question.a,
                            fmt::join(method_names(summary.study), ", ")));
}

void check_figures(const StudySummary& summary, const ComparisonQuestion& question) {
  require("group", question.group, summary.groups());
  if (question.metrics.empty()) throw Error("compare: no metric; f1 is one");
  for (const std::string& metric : question.metrics) {
    check_metric(summary, question.group, metric);
    if (std::ranges::count(question.metrics, metric) > 1)
      throw Error(fmt::format("compare: metric '{}' is given twice; once is enough", metric));
  }
}

/// Refuses results whose draws of a seed are not the same.
void check_paired(const StudySummary& before, const StudySummary& after, bool any_recording) {
  check_one_build(before, "compare: results before");
  check_one_build(after, "compare: results after");
  if (before.recording_hash != after.recording_hash && !any_recording)
    throw Error(
        fmt::format("compare: recording {} -> {}; sweep both on one recording (--set "
                    "recording=FOLDER), or give --any_recording where both show the same",
                    before.recording_hash.substr(0, 8), after.recording_hash.substr(0, 8)));
  if (before.study.seed != after.study.seed)
    throw Error(fmt::format("compare: seed {} -> {}, so no draws pair; sweep both with one seed",
                            before.study.seed, after.study.seed));
}

/// The trials of a method at a cell; none where all of them failed.
const ResultLine* line_of(const StudySummary& summary, const Cell& cell,
                          const std::string& method) {
  const auto line = std::ranges::find_if(summary.trials, [&](const ResultLine& of) {
    return of.cell.index == cell.index && of.method == method;
  });
  return line == summary.trials.end() ? nullptr : &*line;
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
PairedComparison compare_lines(const ResultLine& a, const ClassTable& table_a, const ResultLine& b,
                               const ClassTable& table_b, const std::string& group,
                               const std::string& metric) {
  std::map<int, std::pair<std::optional<double>, std::optional<double>>> by_seed;
  const Estimate of_a = estimate(a, table_a, group, metric);
  const Estimate of_b = estimate(b, table_b, group, metric);
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

/// Adjusts the p values for all rows.
void adjust(std::vector<ComparisonRow>& rows) {
  std::vector<std::optional<double>> p;
  for (const ComparisonRow& row : rows) p.push_back(row.paired.p);
  p = holm_adjusted(p);
  for (std::size_t n = 0; n < rows.size(); ++n) rows[n].p_holm = p[n];
}

}  // namespace

std::vector<ComparisonRow> compare_methods(const StudySummary& summary,
                                           const ComparisonQuestion& question) {
  check_methods(summary, question);
  check_figures(summary, question);
  const ClassTable& table = summary.table;
  std::vector<ComparisonRow> rows;
  for (const Cell& cell : cells(summary.study)) {
    const ResultLine* const a = line_of(summary, cell, question.a);
    const ResultLine* const b = line_of(summary, cell, question.b);
    for (const std::string& metric : question.metrics)
      rows.push_back({"",
                      cell,
                      metric,
                      a && b ? compare_lines(*a, table, *b, table, question.group, metric)
                             : PairedComparison{},
                      {}});
  }
  adjust(rows);
  return rows;
}

std::vector<ComparisonRow> compare_results(const StudySummary& before, const StudySummary& after,
                                           const ComparisonQuestion& question) {
  for (const StudySummary* summary : {&before, &after}) check_figures(*summary, question);
  check_paired(before, after, question.any_recording);
  std::vector<ComparisonRow> rows;
  for (const ResultLine& a : after.trials) {
    const auto b = std::ranges::find_if(before.trials, [&](const ResultLine& line) {
      return line.method == a.method && line.cell.doses == a.cell.doses;
    });
    if (b == before.trials.end()) continue;
    for (const std::string& metric : question.metrics)
      rows.push_back({a.method,
                      a.cell,
                      metric,
                      compare_lines(a, after.table, *b, before.table, question.group, metric),
                      {}});
  }
  if (rows.empty()) throw Error("compare: the results have no method at the same doses in common");
  std::ranges::stable_sort(rows, {}, [&](const ComparisonRow& row) {
    return std::ranges::find(after.trials, row.method, &ResultLine::method) - after.trials.begin();
  });
  adjust(rows);
  return rows;
}

}  // namespace mapscore::eval
