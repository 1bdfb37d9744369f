// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#include "eval/cli/shared/progress.hpp"

#include "eval/render/replay_check.hpp"
#include "eval/results/input_files.hpp"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <cstdio>
#include <iostream>
#include <utility>

namespace mapscore::eval {

std::string duration_text(double seconds) {
  constexpr double kMost = 1e12;
  const auto whole = static_cast<std::int64_t>(std::clamp(seconds, 0.0, kMost) + 0.5);
  const std::int64_t minutes = whole / 60;
  if (minutes < 60) return fmt::format("{}:{:02}", minutes, whole % 60);
  return fmt::format("{}:{:02}:{:02}", minutes / 60, minutes % 60, whole % 60);
}

Progress::Progress(std::string what, std::string unit, bool quiet)
    : what_(std::move(what)),
      unit_(std::move(unit)),
      quiet_(quiet),
      terminal_(isatty(STDERR_FILENO) != 0) {}

Progress::~Progress() {
  if (open_line_) std::fputs("\n", stderr);
}

void Progress::show(std::int64_t done, std::int64_t total, const std::string& note) {
  if (quiet_) return;
  const std::scoped_lock lock(mutex_);
  const Clock::time_point now = Clock::now();
  const auto pause = terminal_ ? std::chrono::milliseconds(200) : std::chrono::seconds(10);
  if (done < total && now - (terminal_ ? shown_ : std::max(shown_, started_)) < pause) return;
  shown_ = now;
  std::string text = line(done, total, std::chrono::duration<double>(now - started_).count());
  if (!note.empty()) text += "; " + note;
  // Not through std::cerr, whose guard would show the codes that renew the line.
  std::fputs((terminal_ ? '\r' + text + "\x1b[K" : text + '\n').c_str(), stderr);
  open_line_ = terminal_;
}

std::string Progress::line(std::int64_t done, std::int64_t total, double seconds) const {
  std::string text = fmt::format("{} {}/{} {}", what_, done, total, unit_);
  if (seconds > 0.0) text += fmt::format(", {:.0f}/s", static_cast<double>(done) / seconds);
  if (done == total) return text + fmt::format(", {:.1f} s", seconds);
  if (done == 0) return text;
  const double left = seconds * static_cast<double>(total - done) / static_cast<double>(done);
  return text + fmt::format(", {} left", duration_text(left));
}

StoppedRecording::StoppedRecording(int by, const std::string& work, const std::string& thing)
    : std::runtime_error(fmt::format(
          "stopped while {}; no trial is lost, the same command makes {} anew and goes on", work,
          thing)),
      signal(by) {}

Recording shown_recording(const char* verb, const Study& study,
                          const std::filesystem::path& results, int jobs, bool quiet) {
  ShownRecording display(quiet);
  Recording recording = recording_of(study, results, jobs, display.progress());
  for (const std::string& note :
       {note_on_baked(recording.info()), note_on_scene(study, recording.info()),
        note_on_labels(study, recording)})
    if (!note.empty()) std::cerr << verb << ": " << note << '\n';
  return recording;
}

}  // namespace mapscore::eval
