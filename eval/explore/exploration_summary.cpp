// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#include "eval/explore/exploration_summary.hpp"

#include "files/csv.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace mapscore::eval {
namespace {

SeedSummary summary_of(const ExplorationGroup& group, const auto& value,
                       const ValueLimits& limits = {}) {
  std::vector<std::optional<double>> values;
  for (std::size_t n = 0; n < group.runs.size(); ++n)
    values.push_back(value(group.scores[n], group.runs[n]->kept));
  return summarise(values, limits);
}

void summarise_group(ExplorationGroup& group) {
  constexpr ValueLimits kShare{0.0, 1.0}, kPositive{.low = 0.0};
  using Scores = ExplorationScores;
  using Kept = KeptExploration;
  group.metres_at_most = summary_of(
      group, [](const Scores& s, const Kept&) { return s.metres_at_most; }, kPositive);
  group.area_metres = summary_of(
      group, [](const Scores& s, const Kept&) { return s.area_metres; }, kShare);
  group.area_seconds = summary_of(
      group, [](const Scores& s, const Kept&) { return s.area_seconds; }, kShare);
  group.coverage = summary_of(
      group, [](const Scores& s, const Kept&) { return s.coverage; }, kShare);
  group.f1 = summary_of(
      group, [](const Scores& s, const Kept&) { return s.f1; }, kShare);
  group.driven_m = summary_of(
      group, [](const Scores&, const Kept& k) { return k.driven_m; }, kPositive);
  group.views = summary_of(
      group, [](const Scores&, const Kept& k) { return static_cast<double>(k.views); }, kPositive);
  for (std::size_t n = 0; n < group.runs.size(); ++n) {
    ++group.ends[group.runs[n]->kept.end];
    group.reached += group.scores[n].metres ? 1 : 0;
    group.bump_contacts += group.runs[n]->kept.bump_contacts;
  }
}

std::string number(const std::optional<double>& value) {
  return value ? fmt::format("{}", *value) : "-";
}

/// Columns that say which exploration a row is of.
std::vector<std::string> key_columns(const std::vector<FinishedExploration>& finished) {
  std::vector<std::string> columns{"name"};
  if (!finished.empty())
    for (const auto& [path, value] : finished.front().planned.spec.cell.doses)
      columns.push_back(path);
  columns.insert(columns.end(), {"method", "seed"});
  return columns;
}

std::vector<std::string> key_cells(const PlannedExploration& planned) {
  std::vector<std::string> cells{planned.name};
  for (const auto& [path, value] : planned.spec.cell.doses) cells.push_back(value);
  cells.insert(cells.end(), {planned.spec.method, fmt::format("{}", planned.spec.seed_index)});
  return cells;
}

std::string line_of(std::vector<std::string> keys, const std::vector<std::string>& values) {
  keys.insert(keys.end(), values.begin(), values.end());
  return csv_line(keys);
}

}  // namespace

ExplorationScores scores_of(const ExplorationCurve& curve, double budget_m, double budget_s) {
  ExplorationScores scores;
  scores.metres = reaches(curve, kCoveredShare, CurveAxis::metres);
  scores.seconds = reaches(curve, kCoveredShare, CurveAxis::seconds);
  scores.metres_at_most = std::min(scores.metres.value_or(budget_m), budget_m);
  scores.area_metres = area_under(curve, budget_m, CurveAxis::metres);
  scores.area_seconds = area_under(curve, budget_s, CurveAxis::seconds);
  if (curve.empty()) return scores;
  scores.coverage = curve.back().coverage;
  scores.coverage_detected = curve.back().coverage_detected;
  if (curve.back().map) scores.f1 = curve.back().map->f1;
  return scores;
}

std::vector<ExplorationGroup> groups_of(const std::vector<FinishedExploration>& finished) {
  std::vector<ExplorationGroup> groups;
  for (const FinishedExploration& run : finished) {
    const TrialSpec& spec = run.planned.spec;
    auto group = std::ranges::find_if(groups, [&](const ExplorationGroup& other) {
      return other.doses == spec.cell.doses && other.method == spec.method;
    });
    if (group == groups.end()) {
      groups.push_back(
          {spec.cell.doses, spec.method, {}, {}, {}, 0, 0, {}, {}, {}, {}, {}, {}, {}});
      group = std::prev(groups.end());
    }
    const ExplorationSettings& settings = run.planned.config.exploration;
    group->runs.push_back(&run);
    group->scores.push_back(scores_of(run.kept.curve, settings.budget_m, settings.budget_s));
  }
  for (ExplorationGroup& group : groups) summarise_group(group);
  return groups;
}

std::string exploration_csv(const std::vector<FinishedExploration>& finished) {
  std::string text = line_of(key_columns(finished),
                             {"stamp_s", "driven_m", "views", "coverage", "coverage_detected",
                              "precision", "recall", "f1", "known_m3"});
  for (const FinishedExploration& run : finished) {
    const std::vector<std::string> keys = key_cells(run.planned);
    for (const CoveragePoint& point : run.kept.curve) {
      if (!point.map) continue;
      text += line_of(
          keys,
          {number(point.stamp_s), number(point.driven_m), fmt::format("{}", point.views),
           number(point.coverage), number(point.coverage_detected), number(point.map->precision),
           number(point.map->recall), number(point.map->f1), number(point.map->known_m3)});
    }
  }
  return text;
}

std::string runs_csv(const std::vector<FinishedExploration>& finished) {
  std::string text = line_of(
      key_columns(finished),
      {"end", "metres_to_90", "seconds_to_90", "area_metres", "area_seconds", "coverage",
       "coverage_detected", "f1", "driven_m", "duration_s", "views", "frames", "bump_contacts"});
  for (const FinishedExploration& run : finished) {
    const ExplorationSettings& settings = run.planned.config.exploration;
    const KeptExploration& kept = run.kept;
    const ExplorationScores s = scores_of(kept.curve, settings.budget_m, settings.budget_s);
    text += line_of(
        key_cells(run.planned),
        {kept.end, number(s.metres), number(s.seconds), number(s.area_metres),
         number(s.area_seconds), number(s.coverage), number(s.coverage_detected), number(s.f1),
         number(kept.driven_m), number(kept.duration_s), fmt::format("{}", kept.views),
         fmt::format("{}", kept.frames), fmt::format("{}", kept.bump_contacts)});
  }
  return text;
}

}  // namespace mapscore::eval
