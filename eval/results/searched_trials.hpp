// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#pragma once

#include "eval/results/plan.hpp"
#include "eval/results/store.hpp"
#include "eval/study/grid.hpp"

#include <string>
#include <vector>

namespace mapscore::eval {

/// A trial that a tolerance search asked for; it belongs to no sweep.
struct SearchedTrial {
  std::string key;
  TrialSpec spec;  ///< method, doses and seed index

  bool operator==(const SearchedTrial&) const = default;
};

/// Trials with the keys of their tasks, as tasks_of_trials gives them.
[[nodiscard]] std::vector<SearchedTrial> with_keys(const std::vector<TrialSpec>& trials,
                                                   const TrialTasks& tasks);

/// Notes in a store what searches asked for, each trial once, behind those noted before.
void note_searched(ResultStore& store, const std::vector<SearchedTrial>& trials);

/// What is noted, in the order of asking. Throws Error when the note is not readable.
[[nodiscard]] std::vector<SearchedTrial> searched_trials(const ResultStore& store);

}  // namespace mapscore::eval
