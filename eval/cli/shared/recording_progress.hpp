// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#pragma once

#include "eval/cli/shared/progress.hpp"
#include "eval/render/study_recording.hpp"

#include <optional>

namespace mapscore::eval {

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
