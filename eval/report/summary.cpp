// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#include "eval/report/summary.hpp"

#include "core/error.hpp"
#include "eval/report/best_threshold.hpp"
#include "eval/results/study_store.hpp"

#include <fmt/format.h>

#include <map>
#include <utility>

namespace mapscore::eval {
namespace {

/// Adds one seed's result to the line it belongs to.
class LineCollector {
 public:
  LineCollector(Role role, std::vector<ResultLine>& lines) : role_(role), lines_(lines) {}

  void add(const TrialSpec& spec, const TrialResult& result) {
    const auto [entry, is_new] =
        positions_.try_emplace({spec.cell.index, spec.method}, lines_.size());
    if (is_new) lines_.push_back({role_, spec.method, spec.cell, {}, {}, {}});
    ResultLine& line = lines_[entry->second];
    line.seeds.push_back(spec.seed_index);
    line.results.push_back(result);
    pool_into(line.pooled, result.counts);
  }

 private:
  Role role_;
  std::vector<ResultLine>& lines_;
  std::map<std::pair<int, std::string>, std::size_t> positions_;
};

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

const char* name_of(Role role) {
  switch (role) {
    case Role::trial:
      return "trial";
    case Role::registration_ceiling:
      return "registration_ceiling";
    case Role::lattice_ceiling:
      return "lattice_ceiling";
  }
  return "?";
}

std::vector<std::string> StudySummary::groups() const {
  std::vector<std::string> groups{std::string(kPooled), std::string(kMacro)};
  for (const SemanticClass& semantic_class : table.classes)
    if (semantic_class.detect) groups.push_back(semantic_class.name);
  return groups;
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
  LineCollector trials(Role::trial, summary.trials);
  LineCollector registration(Role::registration_ceiling, summary.registration_ceilings);
  LineCollector lattice(Role::lattice_ceiling, summary.lattice_ceilings);
  for (const PlannedTrial trial : plan.trials) {
    trials.add(trial.spec, found[trial.task]);
    registration.add(trial.spec, found[trial.registration_ceiling]);
    lattice.add(trial.spec, found[trial.lattice_ceiling]);
  }
  return summary;
}

std::vector<Metric> metrics_of_group(const Counts& counts, const ClassTable& table,
                                     std::string_view group) {
  if (group == kPooled) return metrics_of(pool_detected(counts, table));
  if (group == kMacro) return macro_metrics(counts, table);
  for (const SemanticClass& semantic_class : table.classes)
    if (semantic_class.name == group) return metrics_of(counts.at(semantic_class.id));
  throw Error(fmt::format("class '{}': not in the class table", group));
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
