// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#pragma once

#include "eval/results/sweep_status.hpp"
#include "files/folder_lock.hpp"

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <mutex>
#include <optional>

namespace mapscore::eval {

/// Keeps status.json of a results folder up to date while a sweep runs, about once a second.
/// Members may be called from several threads. They throw Error when the file cannot be written.
class LiveStatus {
 public:
  /// `first`: study, shard, jobs, missing. Takes over the rate that was measured before.
  LiveStatus(SweepStatus first, std::filesystem::path results, int frames);

  void progress(std::int64_t done, std::int64_t total);
  void ended(std::size_t computed, std::size_t failed);
  /// The last word: finished or stopped.
  void end(const char* state);

 private:
  using Clock = std::chrono::steady_clock;

  void write();

  std::mutex mutex_;
  SweepStatus status_;
  std::filesystem::path results_;
  int frames_;
  Clock::time_point started_ = Clock::now(), written_ = started_;
};

/// Keeps other sweeps out of a results folder, so that none binds it to another study while this
/// one runs. Waits for one that is there, and says so unless `quiet`; `verb`: who waits.
void enter_results(const char* verb, const std::filesystem::path& results, bool quiet,
                   std::optional<FolderLock>& lock);

}  // namespace mapscore::eval
