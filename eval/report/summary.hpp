// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#pragma once

#include "core/classes.hpp"
#include "eval/report/line_digest.hpp"
#include "eval/results/plan.hpp"
#include "eval/results/store.hpp"
#include "eval/score/metrics.hpp"
#include "eval/statistics/intervals.hpp"
#include "eval/study/grid.hpp"
#include "eval/study/study.hpp"

#include <array>
#include <cstddef>
#include <filesystem>
#include <functional>
#include <memory>
#include <optional>
#include <set>
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

/// All seeds of one method at one cell of the grid, or of its ceiling. The results of one that is
/// read from a store stay there (see `loaded`), since those of a large study fill the memory.
struct ResultLine {
  Role role = Role::trial;
  std::string method;
  Cell cell;
  std::vector<int> seeds;                         ///< indices, in the order of `results`
  std::vector<TrialResult> results;               ///< one a seed
  Counts pooled;                                  ///< counts summed over the seeds
  std::shared_ptr<const LineDigest> digest = {};  ///< of a line from a store
  /// Of such a line: reads the result of the n-th seed.
  std::function<TrialResult(std::size_t)> in_store = {};
};

/// The line with its results and pooled counts. Throws Error when they cannot be read.
[[nodiscard]] ResultLine loaded(const ResultLine& line);

/// Plain counts and curve of the detected classes together, over all seeds of a line.
[[nodiscard]] ClassCounts pooled_counts(const ResultLine& line, const ClassTable& table);

/// A figure of a line: formed from the pooled counts, and its spread over the seeds.
struct Estimate {
  std::optional<double> pooled;
  SeedSummary over_seeds;
  std::vector<std::optional<double>> by_seed = {};  ///< in the order of the line's seeds
};

/// The spread of a metric over the seeds: sizes of errors are at least 0, all others from 0 to 1.
[[nodiscard]] SeedSummary spread_of(std::string_view metric,
                                    const std::vector<std::optional<double>>& by_seed);

/// The results of one study in the order of its grid, complete unless `interim` says otherwise.
/// Immutable.
struct StudySummary {
  Study study;
  ClassTable table;
  std::string recording_hash;
  std::set<std::string> builds;  ///< that made the results; an empty one did not tell
  std::vector<ResultLine> trials;
  /// Ceilings of `trials[i]`; lines that agree for several trials are repeated.
  std::vector<ResultLine> registration_ceilings, lattice_ceilings;
  /// Of a sweep that lacks trials: how much is there, for captions, and `study.seeds` is what the
  /// fullest line has; empty for a complete one.
  std::string interim = {};
  bool is_finished = true;  ///< all that is not there are commands that failed

  /// "pooled", "macro", then the detected classes.
  [[nodiscard]] std::vector<std::string> groups() const;
  /// Whether the pooled counts of its trials have this metric.
  [[nodiscard]] bool has_metric(std::string_view metric) const;
  /// The note of a LatticeCheck of all lattice ceilings.
  [[nodiscard]] std::string lattice_note() const;
};

/// Names of the detected classes, in the table's order.
[[nodiscard]] std::vector<std::string> detected_names(const ClassTable& table);

/// Their titles (class_title).
[[nodiscard]] std::vector<std::string> detected_titles(const Study& study, const ClassTable& table);

/// What a summary is to hold.
struct SummaryOptions {
  std::vector<std::string> groups = {};  ///< that figures are formed of at once; none: all
  /// Take an unfinished sweep: of each line the seeds that are there with both ceilings; lines
  /// without any are left out.
  bool interim = false;
  /// Take a sweep that lacks nothing but trials whose command failed, in the same way.
  bool failed_commands = false;
  bool pool_scenes = false;  ///< and the lines of all scenes together (pooled_scenes.hpp)
};

/// Opens the store of a study (`results` is the folder or its results.sqlite) and forms the figures
/// of all its trials, line by line. Throws Error when there is none, or when trials are missing
/// (says how many, and the command that goes on).
[[nodiscard]] StudySummary summarise_store(const std::filesystem::path& results,
                                           const SummaryOptions& options = {});

/// Counts of one group of groups() that is not macro. Throws Error when there is no such class.
[[nodiscard]] ClassCounts counts_of_group(const Counts& counts, const ClassTable& table,
                                          std::string_view group);

/// Metrics of a line's counts for one group of groups(). Throws Error as above.
[[nodiscard]] std::vector<Metric> metrics_of_group(const Counts& counts, const ClassTable& table,
                                                   std::string_view group);

/// The same of a line's pooled counts.
[[nodiscard]] std::vector<Metric> pooled_metrics(const ResultLine& line, const ClassTable& table,
                                                 std::string_view group);

/// Of a metric of metrics_of_group, or kBestF1 or kBestThreshold. Throws Error when there is no
/// such metric.
[[nodiscard]] Estimate estimate(const ResultLine& line, const ClassTable& table,
                                std::string_view group, const std::string& metric);

}  // namespace mapscore::eval
