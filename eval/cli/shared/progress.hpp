// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#pragma once

#include <chrono>
#include <cstdint>
#include <mutex>
#include <string>

namespace mapscore::eval {

/// Progress with time left, on standard error: a line that renews itself on a terminal, otherwise a
/// line every ten seconds. Members may be called from several threads.
class Progress {
 public:
  /// `what` and `unit` as in "sweep 120/5400 frames". Silent when `quiet`.
  Progress(std::string what, std::string unit, bool quiet);
  ~Progress();
  Progress(const Progress&) = delete;
  Progress& operator=(const Progress&) = delete;

  void show(std::int64_t done, std::int64_t total);

 private:
  using Clock = std::chrono::steady_clock;

  [[nodiscard]] std::string line(std::int64_t done, std::int64_t total, double seconds) const;

  std::string what_, unit_;
  bool quiet_, terminal_;
  std::mutex mutex_;
  Clock::time_point started_ = Clock::now();
  Clock::time_point shown_{};
  bool open_line_ = false;
};

}  // namespace mapscore::eval
