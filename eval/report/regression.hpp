// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#pragma once

#include "eval/report/baseline.hpp"
#include "eval/statistics/intervals.hpp"

#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace mapscore::eval {

/// How much a figure may get worse, absolutely: the value for its class and metric, else its class,
/// else its metric, else for all.
struct Tolerances {
  double all = 0.002;
  std::map<std::pair<std::string, std::string>, double> special;  ///< by class, metric; "" any

  [[nodiscard]] double of(const std::string& group, const std::string& metric) const;
};

/// `VALUE`, `METRIC=VALUE`, `CLASS/METRIC=VALUE` or `CLASS/=VALUE`, in their order; the last slash
/// and the last equals sign divide, so that a class may hold both. Throws Error naming `--allow`.
[[nodiscard]] Tolerances parse_tolerances(const std::vector<std::string>& texts);

enum class Standing {
  worse,       ///< by more than is allowed
  missing,     ///< the results lack it, or it is undefined there: as bad as worse
  better,      ///< by more than is allowed
  held,        ///< neither
  not_judged,  ///< other seeds than the baseline's, and too few to tell chance, or undefined in
               ///< some of the baseline's and now in all
};
[[nodiscard]] const char* name_of(Standing verdict);

/// One figure of a line and group before and after.
struct JudgedFigure {
  Role role = Role::trial;
  std::string method;
  Cell cell;
  std::string group, metric;
  std::optional<double> before, after;  ///< of counts pooled over the seeds that both have
  SeedSummary difference;               ///< after - before, seed by seed
  double allowed = 0.0;
  Standing verdict = Standing::held;
  std::vector<std::pair<std::string, std::int64_t>> grown;  ///< causes of errors, most first

  /// after - before, turned so that more is better.
  [[nodiscard]] std::optional<double> gain() const;
};

/// Whether more of a metric is better; less is of distances, Brier scores and calibration errors.
[[nodiscard]] bool higher_is_better(std::string_view metric);

/// The trial of the first seed that lost most, by what its frames give by themselves.
struct FrameTrace {
  std::string method;
  Cell cell;
  std::string group;
  std::vector<FrameLoss> losses;  ///< most first
};

struct Judgement {
  bool same_recording = true, same_seeds = true;
  int seeds = 0;                         ///< that both have
  int seeds_before = 0;                  ///< that the baseline has
  std::size_t trials = 0, changed = 0;   ///< ceilings too; by their counts, seed by seed
  std::vector<JudgedFigure> figures;     ///< worst first
  std::optional<FrameTrace> trace = {};  ///< not by judge(), which has no recording

  [[nodiscard]] std::size_t count(Standing verdict) const;
  /// Whether a figure got worse or is missing.
  [[nodiscard]] bool fell() const { return count(Standing::worse) + count(Standing::missing) > 0; }
  /// Whether any figure of the baseline was told better, worse or neither.
  [[nodiscard]] bool compared() const;
  /// The figure of a trial that lost most; nullptr where none got worse.
  [[nodiscard]] const JudgedFigure* worst() const;
};

/// Judges the figures `metrics` (of those, that `before` has) of every line and group of `before`.
/// On the same seeds a figure is worse when the pooled one is by more than is allowed: nothing but
/// code differs. On any seeds it is when the paired difference is significantly beyond what is
/// allowed: at least kSeedsForInterval pairs, their 95 % interval wholly beyond, and one-sided
/// Student p, by Holm for all figures, below 0.05. Throws Error where settings, detected classes or
/// scoring versions differ, and where recordings do unless `any_recording`.
[[nodiscard]] Judgement judge(const Baseline& before, const Baseline& after,
                              const std::vector<std::string>& metrics, const Tolerances& allowed,
                              bool any_recording = false);

}  // namespace mapscore::eval
