// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#pragma once

#include "eval/results/store.hpp"
#include "eval/study/study.hpp"

#include <cstddef>
#include <cstdint>
#include <memory>
#include <set>
#include <string>
#include <vector>

namespace mapscore::eval {

/// Which labels a task maps.
enum class Labels {
  detected,  ///< label images of the colour camera, registered: what a method sees
  truth      ///< instance ids of the depth camera's own pixels: the lattice ceiling
};

/// One map to make and score. Same key, same result.
struct Task {
  std::string key;          ///< content hash of `description`
  std::string description;  ///< YAML of everything that determines the result
  Study config;             ///< resolved: one method, no sweep
  int seed_index = 0;
  Labels labels = Labels::detected;
  std::string recording_hash = {};
};

/// The seed of everything that one repetition draws; shared by all methods and doses.
[[nodiscard]] std::uint64_t trial_seed(const Task& task);

/// What the tasks of one configuration have in common; they differ in the seed alone.
struct SeedlessTask {
  Study config;
  Labels labels = Labels::detected;
  std::string before_seed, after_seed;  ///< the description, without the index of the seed
  std::string recording_hash = {};

  [[nodiscard]] std::string description(int seed_index) const;
  [[nodiscard]] std::string key(int seed_index) const;
  [[nodiscard]] Task task(int seed_index) const;
};

/// The tasks of a plan, in the order of first use. It holds each configuration once; a task or its
/// key is made each time it is asked for. Copies share what they hold.
class TaskList {
 public:
  /// One of the `count` configurations from `first` on that are first used at the same cell. Their
  /// tasks take turns: all with the first seed, all with the second. Seeds are counted from
  /// `first_seed` on.
  struct Configuration {
    SeedlessTask shared;
    std::size_t first = 0, count = 0;
    int first_seed = 0;
  };

  TaskList() = default;
  TaskList(std::vector<Configuration> configurations, int seeds);

  [[nodiscard]] std::size_t size() const;
  [[nodiscard]] Task operator[](std::size_t position) const;
  [[nodiscard]] std::string key(std::size_t position) const;
  [[nodiscard]] const Study& config(std::size_t position) const {
    return member_at(position).shared.config;
  }
  [[nodiscard]] int seed_index(std::size_t position) const {
    return member_at(position).seed_index;
  }
  [[nodiscard]] Labels labels(std::size_t position) const {
    return member_at(position).shared.labels;
  }
  /// Content hash of the recording that the task maps.
  [[nodiscard]] const std::string& recording_hash(std::size_t position) const {
    return member_at(position).shared.recording_hash;
  }
  /// Where the task of a configuration and its n-th seed stands.
  [[nodiscard]] std::size_t position_of(std::size_t configuration, int seed_index) const;

 private:
  struct Member {
    const SeedlessTask& shared;
    int seed_index;
  };
  [[nodiscard]] Member member_at(std::size_t position) const;

  std::shared_ptr<const std::vector<Configuration>> configurations_;
  std::size_t seeds_ = 0;
};

/// Which tasks of a plan a store holds.
struct HeldTasks {
  std::size_t all = 0;
  std::size_t of_other_builds = 0;  ///< than the running program
  std::set<std::string> builds;     ///< that made them; an empty one did not tell
};
[[nodiscard]] HeldTasks held_tasks(const ResultStore& store, const TaskList& tasks);

}  // namespace mapscore::eval
