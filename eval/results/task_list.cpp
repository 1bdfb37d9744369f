// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#include "eval/results/task_list.hpp"

#include "eval/results/build_identity.hpp"
#include "eval/study/grid.hpp"
#include "files/file_bytes.hpp"

#include <fmt/format.h>

#include <utility>

namespace mapscore::eval {

std::uint64_t trial_seed(const Task& task) {
  return trial_seed(task.config.seed, task.seed_index);
}

std::string SeedlessTask::description(int seed_index) const {
  return fmt::format("{}{}{}", before_seed, seed_index, after_seed);
}

std::string SeedlessTask::key(int seed_index) const {
  return hash_of(description(seed_index));
}

Task SeedlessTask::task(int seed_index) const {
  std::string text = description(seed_index);
  std::string key = hash_of(text);
  return {std::move(key), std::move(text), config, seed_index, labels, recording_hash};
}

TaskList::TaskList(std::vector<Configuration> configurations, int seeds)
    : configurations_(
          std::make_shared<const std::vector<Configuration>>(std::move(configurations))),
      seeds_(static_cast<std::size_t>(seeds)) {}

std::size_t TaskList::size() const {
  return configurations_ ? configurations_->size() * seeds_ : 0;
}

TaskList::Member TaskList::member_at(std::size_t position) const {
  const auto& [of_cell, first, count, first_seed] = (*configurations_)[position / seeds_];
  const std::size_t turn = position - first * seeds_;
  return {(*configurations_)[first + turn % count].shared,
          first_seed + static_cast<int>(turn / count)};
}

std::size_t TaskList::position_of(std::size_t configuration, int seed_index) const {
  const auto& [shared, first, count, first_seed] = (*configurations_)[configuration];
  return first * seeds_ + static_cast<std::size_t>(seed_index) * count + configuration - first;
}

Task TaskList::operator[](std::size_t position) const {
  const auto [shared, seed_index] = member_at(position);
  return shared.task(seed_index);
}

std::string TaskList::key(std::size_t position) const {
  const auto [shared, seed_index] = member_at(position);
  return shared.key(seed_index);
}

HeldTasks held_tasks(const ResultStore& store, const TaskList& tasks) {
  const auto builds = store.builds();
  HeldTasks held;
  for (std::size_t n = 0; n < tasks.size(); ++n) {
    const auto trial = builds.find(tasks.key(n));
    if (trial == builds.end()) continue;
    ++held.all;
    if (trial->second != build_identity()) ++held.of_other_builds;
    held.builds.insert(trial->second);
  }
  return held;
}

}  // namespace mapscore::eval
