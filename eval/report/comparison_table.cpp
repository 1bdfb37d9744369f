// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#include "eval/report/comparable.hpp"
#include "eval/report/comparison.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>

namespace mapscore::eval {
namespace {

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
  std::vector<std::string> caption{
      fmt::format("{}: {} - {}, {} classes; detected: {}", study.name, question.a, question.b,
                  question.group, fmt::join(detected_names(summary.table), ", ")),
      scoring_text(study) +
          "; paired seed by seed; figures: means of one value a seed (`mapscore table` pools "
          "counts)",
      spread_note(study.seeds)};
  if (!summary.interim.empty()) caption.insert(caption.begin(), summary.interim);
  if (rows == 0) {
    caption.emplace_back("p: none; no row has seeds that differ");
    return caption;
  }
  caption.insert(
      caption.end(),
      {fmt::format(
           "p: two-sided sign-flip permutation of the mean difference, {}; not corrected for "
           "{} row{}; p (Holm): corrected",
           study.seeds <= kExactSignFlips
               ? "exact"
               : fmt::format(
                     "exact up to {} differences other than 0, else by random sign patterns",
                     kExactSignFlips),
           rows, rows == 1 ? "" : "s") +
           "; - where all seeds have the same values, drawn from nothing",
       fmt::format("least p possible with {} pair{}: {}; p (Holm): {}", study.seeds,
                   study.seeds == 1 ? "" : "s", probability(least),
                   probability(std::min(1.0, least * static_cast<double>(rows))))});
  return caption;
}

Table table_of_rows(const std::vector<ComparisonRow>& rows, const StudySummary& summary,
                    const ComparisonQuestion& question, Reader reader) {
  Table table;
  const auto with_p = std::ranges::count_if(
      rows, [](const ComparisonRow& row) { return row.paired.p.has_value(); });
  table.caption = caption_of(summary, question, static_cast<std::size_t>(with_p));
  const bool by_method = !rows.empty() && !rows.front().method.empty();
  if (by_method) table.columns.emplace_back("method");
  for (std::string& column : dose_columns(summary.study, reader))
    table.columns.push_back(std::move(column));
  const auto mean_of = [&](const std::string& method) {
    return "mean " + method_text(summary.study, method, reader);
  };
  table.columns.insert(table.columns.end(),
                       {"metric", mean_of(question.a), mean_of(question.b), "difference", "low",
                        "high", "spread", "p", "p (Holm)", "pairs"});
  table.keys = table.columns.size() - 9;  // up to the metric
  const auto text = [&](std::string (*rounded)(const std::optional<double>&)) {
    return reader == Reader::program ? nine_digits : rounded;
  };
  const auto mean = text(figure), difference = text(signed_figure), p = text(probability);
  for (const ComparisonRow& row : rows) {
    const PairedComparison& paired = row.paired;
    std::vector<std::string> cells;
    if (by_method) cells.push_back(method_text(summary.study, row.method, reader));
    for (std::string& dose : dose_texts(summary.study, row.cell, reader))
      cells.push_back(std::move(dose));
    cells.insert(cells.end(),
                 {metric_text(row.metric, reader), mean(paired.mean_a), mean(paired.mean_b),
                  difference(paired.difference.mean), difference(paired.difference.low),
                  difference(paired.difference.high), name_of(paired.difference.kind), p(paired.p),
                  p(row.p_holm), std::to_string(paired.difference.seeds)});
    table.rows.push_back(std::move(cells));
  }
  return table;
}

/// What can be quoted of a row.
std::string sentence_of(const ComparisonRow& row, const ComparisonQuestion& question) {
  const bool of_methods = row.method.empty();
  const std::string a = of_methods ? "by " + question.a : question.a;
  const std::string b = of_methods ? "by " + question.b : question.b;
  const SeedSummary& difference = row.paired.difference;
  const std::string of =
      fmt::format("{}{}, {}{}{}", row.metric, of_methods ? "" : " of " + row.method, question.group,
                  row.cell.doses.empty() ? "" : " at ", text_of(row.cell));
  if (!difference.mean) return of + ": undefined";
  if (row.paired.mean_a == row.paired.mean_b && difference.low == difference.high)
    return fmt::format("{}: {} {} and {}, over {} seeds", of, figure(row.paired.mean_a), b, a,
                       difference.seeds);
  const std::string spread = fmt::format(
      "{} {} to {}", difference.kind == SpreadKind::interval ? "95 % interval" : "seeds from",
      signed_figure(difference.low), signed_figure(difference.high));
  const std::string p = row.paired.p
                            ? fmt::format(", p = {}, {} by Holm over all rows",
                                          probability(row.paired.p), probability(row.p_holm))
                            : std::string();
  return fmt::format("{}: {} {}, {} {}, a difference of {} ({}; {} paired seeds{})", of,
                     figure(row.paired.mean_b), b, figure(row.paired.mean_a), a,
                     signed_figure(difference.mean), spread, difference.seeds, p);
}

/// Of each metric the row that differs most.
void add_sentences(const std::vector<ComparisonRow>& rows, const ComparisonQuestion& question,
                   Table& table) {
  for (const std::string& metric : question.metrics) {
    const auto most = std::ranges::max_element(rows, {}, [&](const ComparisonRow& row) {
      return row.metric == metric ? std::abs(row.paired.difference.mean.value_or(0.0)) : -1.0;
    });
    table.caption.push_back(sentence_of(*most, question));
  }
}

}  // namespace

Table comparison_table(const StudySummary& summary, const ComparisonQuestion& question,
                       Reader reader) {
  const std::vector<ComparisonRow> rows = compare_methods(summary, question);
  Table table = table_of_rows(rows, summary, question, reader);
  add_sentences(rows, question, table);
  return table;
}

Table before_after_table(const StudySummary& before, const StudySummary& after,
                         const ComparisonQuestion& question, Reader reader) {
  ComparisonQuestion asked = question;
  asked.a = "after";
  asked.b = "before";
  const std::vector<ComparisonRow> rows = compare_results(before, after, asked);
  Table table = table_of_rows(rows, after, asked, reader);
  if (!before.interim.empty()) table.caption.push_back("before: " + before.interim);
  table.caption.push_back(
      fmt::format("build {} -> {}", *before.builds.begin(), *after.builds.begin()));
  const bool same_recording = before.recording_hash == after.recording_hash;
  if (!same_recording)
    table.caption.push_back(fmt::format("recording {} -> {}", before.recording_hash.substr(0, 8),
                                        after.recording_hash.substr(0, 8)));
  if (const auto differing = differing_settings(before.study, after.study, same_recording);
      !differing.empty())
    table.caption.push_back(fmt::format("settings: {}", fmt::join(differing, ", ")));
  add_sentences(rows, asked, table);
  return table;
}

}  // namespace mapscore::eval
