// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#include "eval/report/trial_list.hpp"

#include <vector>

namespace mapscore::eval {

void visit_tasks(const Plan& plan, const std::function<bool(const ListedTask&)>& visit) {
  std::vector<bool> visited(plan.tasks.size(), false), is_trial(plan.tasks.size(), false);
  for (const PlannedTrial trial : plan.trials) is_trial[trial.task] = true;
  for (const PlannedTrial trial : plan.trials) {
    for (const auto& [task, role] :
         {std::pair(trial.task, Role::trial),
          std::pair(trial.registration_ceiling, Role::registration_ceiling),
          std::pair(trial.lattice_ceiling, Role::lattice_ceiling)}) {
      if (visited[task] || (role != Role::trial && is_trial[task])) continue;
      visited[task] = true;
      if (!visit({task, role, trial.spec})) return;
    }
  }
}

}  // namespace mapscore::eval
