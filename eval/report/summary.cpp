// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#include "eval/report/summary.hpp"

#include "core/error.hpp"
#include "eval/report/best_threshold.hpp"
#include "eval/results/study_store.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <utility>

namespace mapscore::eval {
namespace {

/// Adds one seed's result to the line at `place`, which may be the first behind the last.
void add(Role role, const TrialSpec& spec, const TrialResult& result, std::size_t place,
         std::vector<ResultLine>& lines) {
  if (place == lines.size()) lines.push_back({role, spec.method, spec.cell, {}, {}, {}});
  ResultLine& line = lines[place];
  line.seeds.push_back(spec.seed_index);
  line.results.push_back(result);
  pool_into(line.pooled, result.counts);
}

/// Throws Error when the store lacks trials of the plan.
void check_all_there(const ResultStore& store, const TaskList& tasks,
                     const std::filesystem::path& results) {
  const std::size_t missing = tasks.size() - held_tasks(store, tasks);
  if (missing > 0)
    throw Error(fmt::format(
        "{}: {} of {} trials are not there yet; run `mapscore sweep STUDY -o {}` again, "
        "it goes on where it stopped",
        results.string(), missing, tasks.size(), results.string()));
}

std::vector<TrialResult> read_results(const ResultStore& store, const TaskList& tasks) {
  std::vector<TrialResult> found;
  for (std::size_t n = 0; n < tasks.size(); ++n) found.push_back(store.find(tasks.key(n)).value());
  return found;
}

Estimate estimate(const BestThreshold& best, std::optional<double> ChosenScore::*figure) {
  std::vector<std::optional<double>> values;
  for (const ChosenScore& score : best.by_seed) values.push_back(score.*figure);
  return {best.pooled.*figure, summarise(values), values};
}

}  // namespace

std::vector<std::string> StudySummary::groups() const {
  std::vector<std::string> groups = detected_names(table);
  groups.insert(groups.begin(), {std::string(kPooled), std::string(kMacro)});
  return groups;
}

bool StudySummary::has_metric(std::string_view metric) const {
  return !trials.empty() &&
         std::ranges::count(metrics_of_group(trials.front().pooled, table, kPooled), metric,
                            &Metric::name) > 0;
}

std::string StudySummary::lattice_note() const {
  LatticeCheck check(table);
  for (const ResultLine& line : lattice_ceilings)
    for (const TrialResult& result : line.results) check.add(result.counts);
  return check.note();
}

void LatticeCheck::add(const Counts& ceiling) {
  const ClassCounts pooled = pool_detected(ceiling, table_);
  least_precision_ = std::min(least_precision_, precision(pooled).value_or(1.0));
  least_recall_ = std::min(least_recall_, recall(pooled).value_or(1.0));
}

std::string LatticeCheck::note() const {
  if (std::min(least_precision_, least_recall_) >= kLeast) return "";
  return fmt::format(
      "the lattice ceiling falls to a precision of {:.3f} and a recall of {:.3f}, so images, poses "
      "and truth of the recording do not fit each other, or the voxels are too fine for its depth; "
      "no score means much before that is mended (docs/ceilings.md)",
      least_precision_, least_recall_);
}

std::vector<std::string> detected_names(const ClassTable& table) {
  std::vector<std::string> names;
  for (const SemanticClass& c : table.classes)
    if (c.detect) names.push_back(c.name);
  return names;
}

std::filesystem::path store_file(const std::filesystem::path& results) {
  return std::filesystem::is_directory(results) ? results / "results.sqlite" : results;
}

std::size_t held_tasks(const ResultStore& store, const TaskList& tasks) {
  const auto keys = store.keys();
  std::size_t held = 0;
  for (std::size_t n = 0; n < tasks.size(); ++n) held += keys.contains(tasks.key(n)) ? 1 : 0;
  return held;
}

StudySummary summarise_store(const std::filesystem::path& results) {
  const std::filesystem::path file = store_file(results);
  const ResultStore store = ResultStore::open_existing(file);
  const StudyRecord record = read_study(store, file.parent_path());
  const Plan plan = plan_of(record.study, record.recording_hash);
  check_all_there(store, plan.tasks, results);
  const std::vector<TrialResult> found = read_results(store, plan.tasks);

  StudySummary summary{record.study, record.table, {}, {}, {}};
  std::map<std::pair<int, std::string>, std::size_t> places;  // by cell and method
  for (const PlannedTrial trial : plan.trials) {
    const TrialSpec& spec = trial.spec;
    const std::size_t place =
        places.try_emplace({spec.cell.index, spec.method}, places.size()).first->second;
    add(Role::trial, spec, found[trial.task], place, summary.trials);
    add(Role::registration_ceiling, spec, found[trial.registration_ceiling], place,
        summary.registration_ceilings);
    add(Role::lattice_ceiling, spec, found[trial.lattice_ceiling], place, summary.lattice_ceilings);
  }
  return summary;
}

ClassCounts counts_of_group(const Counts& counts, const ClassTable& table, std::string_view group) {
  if (group == kPooled) return pool_detected(counts, table);
  const auto named = std::ranges::find(table.classes, group, &SemanticClass::name);
  if (named == table.classes.end())
    throw Error(fmt::format("class '{}': not in the class table", group));
  return counts.at(named->id);
}

std::vector<Metric> metrics_of_group(const Counts& counts, const ClassTable& table,
                                     std::string_view group) {
  return group == kMacro ? macro_metrics(counts, table)
                         : metrics_of(counts_of_group(counts, table, group));
}

Estimate estimate(const ResultLine& line, const ClassTable& table, std::string_view group,
                  const std::string& metric) {
  if (metric == kBestF1) return estimate(best_threshold(line, table, group), &ChosenScore::f1);
  if (metric == kBestThreshold)
    return estimate(best_threshold(line, table, group), &ChosenScore::threshold);
  const auto value = [&](const Counts& counts) -> std::optional<double> {
    const std::vector<Metric> metrics = metrics_of_group(counts, table, group);
    return metrics.empty() ? std::nullopt : value_of(metrics, metric);
  };
  std::vector<std::optional<double>> values;
  for (const TrialResult& result : line.results) values.push_back(value(result.counts));
  return {value(line.pooled), summarise(values), values};
}

}  // namespace mapscore::eval
