// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#pragma once

#include "eval/recording/recording.hpp"
#include "eval/results/plan.hpp"
#include "eval/study/study.hpp"
#include "tests/support/tiny_recording.hpp"

#include <gtest/gtest.h>

#include <filesystem>
#include <string>
#include <vector>

namespace mapscore::eval::testing {

/// A study with the method direct, and what else is said.
inline Study study_of(const std::string& lines, const std::vector<std::string>& overrides = {}) {
  return parse_study("recording: tiny\nmethods:\n  direct: {segmentation: {direct: {}}}\n" + lines,
                     "study.yaml", overrides);
}

/// The tiny recording, opened, in a folder of its own.
class TinyExperiment : public ::testing::Test {
 protected:
  [[nodiscard]] const std::filesystem::path& folder() const { return temporary_.path(); }
  [[nodiscard]] const Recording& recording() const { return recording_; }
  [[nodiscard]] const ClassTable& table() const { return recording_.info().table; }
  [[nodiscard]] Plan plan(const Study& study) const {
    return plan_of(study, recording_.content_hash());
  }

 private:
  [[nodiscard]] std::filesystem::path written() const {
    mapscore::testing::write_tiny_recording(temporary_.path() / "tiny");
    return temporary_.path() / "tiny";
  }

  mapscore::testing::TemporaryFolder temporary_;
  Recording recording_ = Recording::open(written());
};

}  // namespace mapscore::eval::testing
