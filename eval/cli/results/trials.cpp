// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#include "eval/cli/shared/options.hpp"
#include "eval/cli/verbs.hpp"
#include "eval/report/trial_list.hpp"
#include "eval/results/searched_trials.hpp"
#include "eval/results/study_store.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <iostream>
#include <map>
#include <string>
#include <unordered_set>
#include <utility>
#include <vector>

namespace mapscore::eval {
namespace {

constexpr std::array kStates{"done", "failed", "missing"};

struct TrialsFlags {
  std::string results, state, format = "text";
};

/// A trial and how it stands.
struct TrialRow {
  std::string key, role;
  TrialSpec spec;
};

/// Those of the study that was swept last, if any was, then those of tolerance searches alone.
std::vector<TrialRow> rows_of(const ResultStore& store, const std::filesystem::path& folder) {
  std::vector<TrialRow> rows;
  std::unordered_set<std::string> listed;
  const auto add = [&](TrialRow row) {
    if (listed.insert(row.key).second) rows.push_back(std::move(row));
  };
  const std::vector<SearchedTrial> searched = searched_trials(store);
  if (searched.empty() || !store.text("study").empty()) {
    const StudyRecord record = read_study(store, folder);
    const Plan plan = plan_of(record);
    visit_tasks(plan, [&](const ListedTask& task) {
      add({plan.tasks.key(task.task), name_of(task.role), task.spec});
      return true;
    });
  }
  for (const auto& [key, spec] : searched) add({key, "tolerance", spec});
  return rows;
}

/// Swept and searched paths, in the order of their first use.
std::vector<std::string> paths_of(const std::vector<TrialRow>& rows) {
  std::vector<std::string> paths;
  for (const TrialRow& row : rows)
    for (const auto& [path, value] : row.spec.cell.doses)
      if (std::ranges::find(paths, path) == paths.end()) paths.push_back(path);
  return paths;
}

/// What the trial's command took; of a method of ours `-`.
void add_cost(const std::map<std::string, TrialCost>& costs, const std::string& key,
              std::vector<std::string>& row) {
  const auto found = costs.find(key);
  if (found == costs.end()) return void(row.insert(row.end(), 4, "-"));
  const TrialCost& cost = found->second;
  row.insert(row.end(), {std::to_string(cost.exit_code), fmt::format("{:.3f}", cost.wall_s),
                         fmt::format("{:.3f}", cost.processor_s),
                         fmt::format("{:.1f}", 1e-6 * static_cast<double>(cost.peak_bytes))});
}

void print_trials(const TrialsFlags& flags) {
  const std::filesystem::path file = store_file(flags.results);
  const ResultStore store = ResultStore::open_existing(file);
  const std::vector<TrialRow> rows = rows_of(store, file.parent_path());
  const std::vector<std::string> paths = paths_of(rows);
  const auto held = store.keys();
  const auto failures = store.failures();
  const auto costs = store.costs();
  Table table;
  table.columns = {"key", "role", "method", "seed", "state"};
  table.columns.insert(table.columns.end(), paths.begin(), paths.end());
  if (!costs.empty())
    table.columns.insert(table.columns.end(), {"exit_code", "wall_s", "processor_s", "peak_MB"});
  table.columns.emplace_back("reason");
  for (const auto& [key, role, spec] : rows) {
    const auto failure = failures.find(key);
    const char* state = held.contains(key)          ? kStates[0]
                        : failure != failures.end() ? kStates[1]
                                                    : kStates[2];
    if (!flags.state.empty() && flags.state != state) continue;
    std::vector<std::string> row{key, role, spec.method, std::to_string(spec.seed_index), state};
    for (const std::string& path : paths) {
      const auto dose =
          std::ranges::find(spec.cell.doses, path, [](const auto& of) { return of.first; });
      row.push_back(dose == spec.cell.doses.end() ? "-" : dose->second);
    }
    if (!costs.empty()) add_cost(costs, key, row);
    row.push_back(state == kStates[1] ? failure->second : "-");
    table.rows.push_back(std::move(row));
  }
  std::cout << formatted(table, flags.format);
}

}  // namespace

void add_trials(CLI::App& program) {
  const auto [verb, flags] = add_verb<TrialsFlags>(
      program, "trials", "List the trials of a study: key, method, seed, state, cell",
      print_trials);
  verb->add_option("RESULTS", flags->results, "Results folder, or its results.sqlite")->required();
  verb->add_option("--state", flags->state, "done, failed or missing ones alone [all]")
      ->check(CLI::IsMember(kStates));
  add_format_flag(*verb, flags->format);
  verb->footer(
      "A ceiling that several cells share stands at the first of them; behind them stand the "
      "trials\n"
      "of tolerance searches that are of no sweep. A failed trial says why.\n"
      "Examples:\n"
      "  mapscore trials results/demo\n"
      "  mapscore trials results/demo --state failed\n"
      "  mapscore run results/demo --trial KEY      repeats one exactly");
}

}  // namespace mapscore::eval
