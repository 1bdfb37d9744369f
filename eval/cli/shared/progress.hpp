// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#pragma once

#include "eval/cli/shared/stop_signal.hpp"
#include "eval/render/study_recording.hpp"

#include <chrono>
#include <cstdint>
#include <filesystem>
#include <iostream>
#include <mutex>
#include <optional>
#include <stdexcept>
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

  /// `note`: what else there is to say of the moment.
  void show(std::int64_t done, std::int64_t total, const std::string& note = "");

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

/// A signal asked to stop while a recording was made, or a network ran over it; what() tells the
/// user how to go on.
struct StoppedRecording : std::runtime_error {
  /// `work`: what was going on, and `thing`: what is made anew, as in the text.
  StoppedRecording(int by, const std::string& work, const std::string& thing);

  int signal;
};

/// Shows how a recording is made: the drive, its images, and what networks see in them. From its
/// first step on the first Ctrl-C ends it in order, by StoppedRecording.
class ShownRecording {
 public:
  explicit ShownRecording(bool quiet) : quiet_(quiet) {}

  /// Valid as long as this is.
  [[nodiscard]] RecordingProgress progress() {
    return {[this](int done, int total) { show(images_, "record", "images", done, total); },
            [this](int done, int total) { show(drive_, "drive", "waypoints", done, total); },
            [this](int done, int total) { show(networks_, "networks", "frames", done, total); },
            [this](const std::string& text) {
              if (!quiet_) std::cerr << "record: note: " << text << '\n';
            }};
  }

 private:
  /// A line's clock starts with it.
  void show(std::optional<Progress>& line, const char* what, const char* unit, int done,
            int total) {
    if (!stop_) stop_.emplace();
    if (const int signal = stop_->taken())
      throw &line == &networks_
          ? StoppedRecording(signal, "a network ran over the images", "its labels")
          : StoppedRecording(signal, "the recording was made", "the recording");
    if (!line) line.emplace(what, unit, quiet_);
    line->show(done, total);
  }

  bool quiet_;
  std::optional<StopSignal> stop_;
  std::optional<Progress> drive_, images_, networks_;
};

/// The recording of a study, made with such a display where it is not there; says on standard error
/// what is baked into it. `verb`: who says so.
[[nodiscard]] Recording shown_recording(const char* verb, const Study& study,
                                        const std::filesystem::path& results, int jobs, bool quiet);

}  // namespace mapscore::eval
