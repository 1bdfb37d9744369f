// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#pragma once

#include "core/classes.hpp"
#include "eval/results/plan.hpp"
#include "eval/results/store.hpp"
#include "eval/score/metrics.hpp"
#include "eval/statistics/intervals.hpp"
#include "eval/study/grid.hpp"
#include "eval/study/study.hpp"

#include <array>
#include <cstddef>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace mapscore::eval {

/// Rows that pool all detected classes, and that average over them; class names may not be these.
inline constexpr std::string_view kPooled = "pooled";
inline constexpr std::string_view kMacro = "macro";

/// Figures that need several seeds, see best_threshold.hpp.
inline constexpr const char* kBestF1 = "f1_best";
inline constexpr const char* kBestThreshold = "threshold_best";

/// What a line of results stands for.
enum class Role { trial, registration_ceiling, lattice_ceiling };
[[nodiscard]] constexpr const char* name_of(Role role) {
  return std::array{"trial", "registration_ceiling", "lattice_ceiling"}.at(
      static_cast<std::size_t>(role));
}

/// All seeds of one method at one cell of the grid, or of its ceiling.
struct ResultLine {
  Role role = Role::trial;
  std::string method;
  Cell cell;
  std::vector<int> seeds;            ///< indices, in the order of `results`
  std::vector<TrialResult> results;  ///< one a seed
  Counts pooled;                     ///< counts summed over the seeds
};

/// A figure of a line: formed from the pooled counts, and its spread over the seeds.
struct Estimate {
  std::optional<double> pooled;
  SeedSummary over_seeds;
  std::vector<std::optional<double>> by_seed = {};  ///< in the order of the line's seeds
};

/// The results of one study, complete and in the order of its grid. Immutable.
struct StudySummary {
  Study study;
  ClassTable table;
  std::vector<ResultLine> trials;
  /// Ceilings of `trials[i]`; lines that agree for several trials are repeated.
  std::vector<ResultLine> registration_ceilings, lattice_ceilings;

  /// "pooled", "macro", then the detected classes.
  [[nodiscard]] std::vector<std::string> groups() const;
  /// Whether the pooled counts of its trials have this metric.
  [[nodiscard]] bool has_metric(std::string_view metric) const;
  /// The note of a LatticeCheck of all lattice ceilings.
  [[nodiscard]] std::string lattice_note() const;
};

/// Checks by a study's lattice ceilings that its recording and truth belong together: true labels
/// at the true pose must then give an almost perfect map (docs/ceilings.md).
class LatticeCheck {
 public:
  /// Neither precision nor recall of a sound recording is below this.
  static constexpr double kLeast = 0.98;

  /// The table is kept by reference.
  explicit LatticeCheck(const ClassTable& table) : table_(table) {}

  void add(const Counts& ceiling);
  /// What to tell the reader of the scores; empty where all is well.
  [[nodiscard]] std::string note() const;

 private:
  const ClassTable& table_;
  double least_precision_ = 1.0, least_recall_ = 1.0;
};

/// Names of the detected classes, in the table's order.
[[nodiscard]] std::vector<std::string> detected_names(const ClassTable& table);

/// How many tasks of a plan the store holds.
[[nodiscard]] std::size_t held_tasks(const ResultStore& store, const TaskList& tasks);

/// Opens the store of a study (`results` is the folder or its results.sqlite) and reads all its
/// trials. Throws Error when there is none, or when trials are missing (says how many, and the
/// command that goes on).
[[nodiscard]] StudySummary summarise_store(const std::filesystem::path& results);

/// Counts of one group of groups() that is not macro. Throws Error when there is no such class.
[[nodiscard]] ClassCounts counts_of_group(const Counts& counts, const ClassTable& table,
                                          std::string_view group);

/// Metrics of a line's counts for one group of groups(). Throws Error as above.
[[nodiscard]] std::vector<Metric> metrics_of_group(const Counts& counts, const ClassTable& table,
                                                   std::string_view group);

/// Of a metric of metrics_of_group, or kBestF1 or kBestThreshold. Throws Error when there is no
/// such metric.
[[nodiscard]] Estimate estimate(const ResultLine& line, const ClassTable& table,
                                std::string_view group, const std::string& metric);

/// results.sqlite of a results folder, or the file itself.
[[nodiscard]] std::filesystem::path store_file(const std::filesystem::path& results);

}  // namespace mapscore::eval
