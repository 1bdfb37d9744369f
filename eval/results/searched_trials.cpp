// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#include "eval/results/searched_trials.hpp"

#include "core/error.hpp"

#include <nlohmann/json.hpp>

#include <unordered_set>

namespace mapscore::eval {
namespace {

constexpr const char* kText = "searched";

}  // namespace

std::vector<SearchedTrial> with_keys(const std::vector<TrialSpec>& trials,
                                     const TrialTasks& tasks) {
  std::vector<SearchedTrial> keyed;
  for (std::size_t n = 0; n < trials.size(); ++n)
    keyed.push_back({tasks.tasks.key(tasks.positions[n]), trials[n]});
  return keyed;
}

void note_searched(ResultStore& store, const std::vector<SearchedTrial>& trials) {
  std::vector<SearchedTrial> all = searched_trials(store);
  const std::size_t before = all.size();
  std::unordered_set<std::string> keys;
  for (const SearchedTrial& trial : all) keys.insert(trial.key);
  for (const SearchedTrial& trial : trials)
    if (keys.insert(trial.key).second) all.push_back(trial);
  if (all.size() == before) return;
  nlohmann::json list = nlohmann::json::array();
  for (const auto& [key, spec] : all)
    list.push_back({key, spec.method, spec.seed_index, spec.cell.doses});
  store.set_text(kText, list.dump());
}

std::vector<SearchedTrial> searched_trials(const ResultStore& store) try {
  std::vector<SearchedTrial> trials;
  const std::string text = store.text(kText);
  if (text.empty()) return trials;
  for (const nlohmann::json& one : nlohmann::json::parse(text)) {
    TrialSpec spec{0, one.at(1), {}, one.at(2)};
    one.at(3).get_to(spec.cell.doses);
    trials.push_back({one.at(0), std::move(spec)});
  }
  return trials;
} catch (const nlohmann::json::exception& error) {
  throw Error(std::string("result store: its list of searched trials is not readable (") +
              error.what() + "); search again into another folder");
}

}  // namespace mapscore::eval
