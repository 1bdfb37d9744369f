// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#include "eval/report/failed_tasks.hpp"

namespace mapscore::eval {

std::vector<FailedTask> failed_tasks(const ResultStore& store, const TaskList& tasks) {
  const auto failures = store.failures();
  if (failures.empty()) return {};
  const auto held = store.keys();
  std::vector<FailedTask> failed;
  for (std::size_t n = 0; n < tasks.size(); ++n) {
    const std::string key = tasks.key(n);
    if (const auto failure = failures.find(key); failure != failures.end() && !held.contains(key))
      failed.push_back({n, failure->second});
  }
  return failed;
}

}  // namespace mapscore::eval
