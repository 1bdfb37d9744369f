// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#pragma once

#include "eval/results/store.hpp"
#include "eval/results/task_list.hpp"

#include <cstddef>
#include <string>
#include <vector>

namespace mapscore::eval {

/// A task that failed and is not there.
struct FailedTask {
  std::size_t task = 0;  ///< position in the list
  std::string reason;
};

/// What a store says failed of these tasks and does not hold, in their order; of commands and of
/// methods of ours.
[[nodiscard]] std::vector<FailedTask> failed_tasks(const ResultStore& store, const TaskList& tasks);

}  // namespace mapscore::eval
