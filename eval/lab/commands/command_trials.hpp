// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#pragma once

#include "eval/lab/bench.hpp"
#include "eval/lab/commands/image_copy.hpp"
#include "eval/results/task_list.hpp"
#include "files/folder_lock.hpp"
#include "files/supervisor.hpp"

#include <filesystem>
#include <functional>
#include <memory>
#include <mutex>
#include <optional>
#include <vector>

namespace mapscore::eval {

/// Runs trials whose method is a command (docs/external_methods.md) in a scratch folder below the
/// system's temporary one, which goes when this goes, or when a later one finds it left behind.
/// Safe to use from several threads.
class CommandTrials {
 public:
  /// `bench` and what `stop` reads must outlive it. Throws Error when there can be no such folder.
  CommandTrials(Bench& bench, std::function<bool()> stop);
  ~CommandTrials();
  CommandTrials(const CommandTrials&) = delete;
  CommandTrials& operator=(const CommandTrials&) = delete;

  /// Writes the trial, runs its command, reads its map and scores it. `cost` is set as soon as the
  /// command has ended, whatever came of it. Nothing when stop() ended it. Throws Error that says
  /// why the trial failed, with the end of what the command printed.
  [[nodiscard]] std::optional<TrialResult> run(const Task& task, std::optional<TrialCost>& cost);

 private:
  /// Where one command works at a time, with images of its own, so that one that damages its input
  /// damages no other's.
  struct Workplace {
    std::filesystem::path folder;
    std::optional<ImageCopy> images = {};
  };
  [[nodiscard]] std::unique_ptr<Workplace> take_workplace();
  void give_back(std::unique_ptr<Workplace> workplace);
  /// What the detections say in their images, which no command changes.
  void count_labels(TrialRun& trial);
  [[nodiscard]] std::optional<TrialResult> run_in(Workplace& workplace, const Task& task,
                                                  std::optional<TrialCost>& cost);

  SupervisorServer server_;  ///< made first, while little memory is taken
  Bench& bench_;
  std::function<bool()> stop_;
  std::filesystem::path scratch_;
  std::optional<FolderLock> hold_;  ///< on `scratch_`
  std::mutex mutex_;                // guards the two below
  std::vector<std::unique_ptr<Workplace>> free_;
  int workplaces_ = 0;
};

}  // namespace mapscore::eval
