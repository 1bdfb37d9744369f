// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#include "eval/cli/shared/options.hpp"
#include "eval/cli/verbs.hpp"
#include "eval/report/trial_list.hpp"
#include "eval/results/study_store.hpp"

#include <array>
#include <iostream>

namespace mapscore::eval {
namespace {

constexpr std::array kStates{"done", "failed", "missing"};

struct TrialsFlags {
  std::string results, state, format = "text";
};

void print_trials(const TrialsFlags& flags) {
  const std::filesystem::path file = store_file(flags.results);
  const ResultStore store = ResultStore::open_existing(file);
  const StudyRecord record = read_study(store, file.parent_path());
  const Plan plan = plan_of(record.study, record.recording_hash);
  const auto held = store.keys();
  const auto failures = store.failures();
  Table table;
  table.columns = {"key", "role", "method", "seed", "state"};
  for (const SweepAxis& axis : record.study.sweep) table.columns.push_back(axis.path);
  table.columns.emplace_back("reason");
  visit_tasks(plan, [&](const ListedTask& listed) {
    const std::string key = plan.tasks.key(listed.task);
    const auto failure = failures.find(key);
    const char* state = held.contains(key)          ? kStates[0]
                        : failure != failures.end() ? kStates[1]
                                                    : kStates[2];
    if (!flags.state.empty() && flags.state != state) return true;
    std::vector<std::string> row{key, name_of(listed.role), listed.spec.method,
                                 std::to_string(listed.spec.seed_index), state};
    for (const auto& [path, value] : listed.spec.cell.doses) row.push_back(value);
    row.push_back(state == kStates[1] ? failure->second : "-");
    table.rows.push_back(std::move(row));
    return true;
  });
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
      "A ceiling that several cells share stands at the first of them. A failed trial says why.\n"
      "Examples:\n"
      "  mapscore trials results/demo\n"
      "  mapscore trials results/demo --state failed\n"
      "  mapscore run results/demo --trial KEY      repeats one exactly");
}

}  // namespace mapscore::eval
