// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#pragma once

#include "eval/results/input_files.hpp"
#include "eval/results/task_list.hpp"
#include "eval/study/grid.hpp"

#include <cstddef>
#include <map>
#include <string>
#include <utility>
#include <vector>

namespace mapscore::eval {

/// Content hashes of the recordings of a study: of the only one, or of each scene by name.
class RecordingHashes {
 public:
  RecordingHashes(std::string only) : hashes_{{"", std::move(only)}} {}
  RecordingHashes(const char* only) : RecordingHashes(std::string(only)) {}
  explicit RecordingHashes(std::map<std::string, std::string> of_scenes)
      : hashes_(std::move(of_scenes)) {}

  /// Throws Error when there is none of the name; "" in a study without scenes.
  [[nodiscard]] const std::string& of(const std::string& scene) const;

 private:
  std::map<std::string, std::string> hashes_;
};

/// One trial of the sweep and its two ceilings, as positions in Plan::tasks.
struct PlannedTrial {
  TrialSpec spec;
  std::size_t task = 0;
  std::size_t registration_ceiling = 0;  ///< the same method with every fault at zero
  std::size_t lattice_ceiling = 0;  ///< true labels on the depth pixels, true pose, same fusion
};

/// Everything that a study computes; tasks that several trials share stand once. Trials are in the
/// order of the grid, tasks in the order of first use. Its memory does not grow with the seeds.
struct Plan {
  TaskList tasks;
  LazyList<PlannedTrial> trials;
  InputFiles::Hashes inputs = {};  ///< of the files that the trials read
};

/// Throws Error when the sweep names a leaf that decides what is recorded, but for scenes, or when
/// a file of `inputs` is refused.
[[nodiscard]] Plan plan_of(const Study& study, const RecordingHashes& recordings,
                           InputFiles inputs = {});

/// Whether the files that the task reads hold what they held when it was planned.
[[nodiscard]] bool is_as_planned(const Task& task);

/// The task of one trial by itself.
[[nodiscard]] Task task_of(const Study& study, const TrialSpec& spec, Labels labels,
                           const RecordingHashes& recordings);

/// Tasks of single trials.
struct TrialTasks {
  TaskList tasks;                      ///< each once, in the order of first use
  std::vector<std::size_t> positions;  ///< in `tasks`, of each trial
};

/// The tasks of these trials without their ceilings; `index` of trial and cell are not read. Throws
/// as plan_of, and as resolve.
[[nodiscard]] TrialTasks tasks_of_trials(const Study& study, const std::vector<TrialSpec>& trials,
                                         const RecordingHashes& recordings);

}  // namespace mapscore::eval
