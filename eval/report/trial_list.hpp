// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#pragma once

#include "eval/report/summary.hpp"
#include "eval/results/plan.hpp"

#include <functional>
#include <string>

namespace mapscore::eval {

/// One task of a plan, as the first trial that needs it has it.
struct ListedTask {
  std::size_t task = 0;  ///< position in Plan::tasks
  Role role = Role::trial;
  TrialSpec spec;
};

/// Calls visit(task) for each task of a plan once: the trials in the order of the grid, each
/// followed by those of its ceilings that are no trial and were not visited yet. Ends early when
/// visit gives false.
void visit_tasks(const Plan& plan, const std::function<bool(const ListedTask&)>& visit);

}  // namespace mapscore::eval
