// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#pragma once

#include "eval/render/study_recording.hpp"

#include <chrono>
#include <cstdint>
#include <mutex>
#include <optional>
#include <string>

namespace mapscore::eval {

/// m:ss, or h:mm:ss from an hour on.
[[nodiscard]] std::string duration_text(double seconds);

/// Progress with time left, on standard error: a line that renews itself on a terminal, otherwise a
/// line every ten seconds. Members may be called from several threads.
class Progress {
 public:
  /// `what` and `unit` as in "sweep 120/5400 frames". Silent when `quiet`.
  Progress(std::string what, std::string unit, bool quiet);
  ~Progress();

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

/// Shows how a recording is made: the drive, then its images.
class ShownRecording {
 public:
  explicit ShownRecording(bool quiet) : quiet_(quiet) {}

  /// Valid as long as this is.
  [[nodiscard]] RecordingProgress progress() {
    return {[this](int done, int total) { show(images_, "record", "images", done, total); },
            [this](int done, int total) { show(drive_, "drive", "waypoints", done, total); }};
  }

 private:
  /// A line's clock starts with it.
  void show(std::optional<Progress>& line, const char* what, const char* unit, int done,
            int total) {
    if (!line) line.emplace(what, unit, quiet_);
    line->show(done, total);
  }

  bool quiet_;
  std::optional<Progress> drive_, images_;
};

}  // namespace mapscore::eval
