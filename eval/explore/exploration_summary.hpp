// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#pragma once

#include "eval/explore/exploration_study.hpp"
#include "eval/statistics/intervals.hpp"

#include <cstddef>
#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace mapscore::eval {

/// Share of the visible surface whose metres are scored.
inline constexpr double kCoveredShare = 0.9;

/// The scores of one exploration (docs/exploration.md, "Scores").
struct ExplorationScores {
  std::optional<double> metres, seconds;  ///< to kCoveredShare; none where it was not reached
  double metres_at_most = 0.0;            ///< the same, or the budget where it was not reached
  double area_metres = 0.0, area_seconds = 0.0;              ///< mean coverage up to the budgets
  double coverage = 0.0, coverage_detected = 0.0, f1 = 0.0;  ///< at the end
};

[[nodiscard]] ExplorationScores scores_of(const ExplorationCurve& curve, double budget_m,
                                          double budget_s);

/// The explorations of a study that differ in the seed alone.
struct ExplorationGroup {
  std::vector<std::pair<std::string, std::string>> doses;  ///< scene among them
  std::string method;
  std::vector<const FinishedExploration*> runs;  ///< by seed
  std::vector<ExplorationScores> scores;         ///< likewise
  std::map<std::string, int> ends;               ///< how many ended for which reason
  int reached = 0;                               ///< of kCoveredShare
  std::size_t bump_contacts = 0;
  SeedSummary metres_at_most, area_metres, area_seconds, coverage, f1, driven_m, views;
};

/// In the order of the study; `finished` must outlive them.
[[nodiscard]] std::vector<ExplorationGroup> groups_of(
    const std::vector<FinishedExploration>& finished);

/// Tidy CSV, a row for each scored point: columns name, each dose, method, seed, stamp_s, ...
[[nodiscard]] std::string exploration_csv(const std::vector<FinishedExploration>& finished);

/// CSV, a row for each exploration: its scores, its end and its totals.
[[nodiscard]] std::string runs_csv(const std::vector<FinishedExploration>& finished);

}  // namespace mapscore::eval
