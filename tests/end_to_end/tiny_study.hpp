// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#pragma once

#include "tests/end_to_end/program.hpp"
#include "tests/support/tiny_recording.hpp"

#include <gtest/gtest.h>

#include <filesystem>
#include <string>

namespace mapscore::testing {

/// A folder with the tiny recording, `tiny`, and a study that replays it, `study.yaml`.
class TinyStudy : public ::testing::Test {
 protected:
  TinyStudy() {
    write_tiny_recording(folder() / "tiny");
    write_text(study(), kText);
  }

  static constexpr const char* kText =
      "recording: tiny\n"
      "methods:\n"
      "  direct: {segmentation: {direct: {}}}\n"
      "  erosion: {segmentation: {erosion: {radius_px: 2}}}\n"
      "sweep:\n"
      "  faults.misregistration.magnitude_m: [0, 0.03]\n"
      "seeds: 2\n";

  [[nodiscard]] const std::filesystem::path& folder() const { return temporary_.path(); }
  [[nodiscard]] std::string path(const std::string& name) const { return folder() / name; }
  [[nodiscard]] std::string study() const { return path("study.yaml"); }
  [[nodiscard]] std::string results() const { return path("results"); }

  /// Replaces the first `from` in a file by `to`; the test fails when there is none.
  void replace(const std::string& file, const std::string& from, const std::string& to) const {
    std::string text = bytes_of(folder() / file);
    const std::size_t at = text.find(from);
    ASSERT_NE(at, std::string::npos) << from;
    write_text(folder() / file, text.replace(at, from.size(), to));
  }

 private:
  TemporaryFolder temporary_;
};

}  // namespace mapscore::testing
