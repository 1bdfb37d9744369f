// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#pragma once

#include "eval/report/summary.hpp"
#include "eval/report/tables/table.hpp"
#include "eval/statistics/paired.hpp"

#include <optional>
#include <string>
#include <vector>

namespace mapscore::eval {

/// What two methods of a study are compared by.
struct ComparisonQuestion {
  std::string a, b;                        ///< methods
  std::string group{kPooled};              ///< one of StudySummary::groups()
  std::vector<std::string> metrics{"f1"};  ///< figures of metrics_of_group, f1_best, threshold_best
  bool any_recording = false;              ///< results before and after may be of two recordings
};

/// One figure at one cell of the grid, seed by seed.
struct ComparisonRow {
  std::string method;  ///< empty where two methods are compared
  Cell cell;
  std::string metric;
  PairedComparison paired;
  std::optional<double> p_holm;  ///< adjusted for all rows
};

/// Rows by cell, then metric. Throws Error, listing what there is, for an unknown method, group or
/// metric; and when a metric is given twice, or a method is compared with itself.
[[nodiscard]] std::vector<ComparisonRow> compare_methods(const StudySummary& summary,
                                                         const ComparisonQuestion& question);

/// The same methods before and after a change, in two results on one recording with one seed: rows
/// by method, cell, metric, of what both have; difference: after - before. Of the question, group
/// and metrics are asked. Throws Error as above, and where recordings (unless `any_recording`) or
/// seeds differ, or several builds made a result.
[[nodiscard]] std::vector<ComparisonRow> compare_results(const StudySummary& before,
                                                         const StudySummary& after,
                                                         const ComparisonQuestion& question);

/// The same as a table: both means, the difference a - b, its interval (or range), p, p (Holm) and
/// pairs. The caption ends, for each metric, with the row that differs most in a sentence that can
/// be quoted. Errors as above.
[[nodiscard]] Table comparison_table(const StudySummary& summary,
                                     const ComparisonQuestion& question,
                                     Reader reader = Reader::terminal);
/// The rows of compare_results; the caption tells which settings differ, too,
/// and the recordings.
[[nodiscard]] Table before_after_table(const StudySummary& before, const StudySummary& after,
                                       const ComparisonQuestion& question,
                                       Reader reader = Reader::terminal);

}  // namespace mapscore::eval
