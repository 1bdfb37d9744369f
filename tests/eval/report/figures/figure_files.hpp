// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#pragma once

#include "tests/eval/report/synthetic_summary.hpp"

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <iterator>
#include <sstream>
#include <string>
#include <vector>

namespace mapscore::eval::testing {

inline const SweepAxis kShift{"faults.misregistration.magnitude_m", {"0", "0.02"}};
inline const SweepAxis kTurn{"faults.misregistration.angle_deg", {"0", "0.5", "2"}};
inline const SweepAxis kCamera{"faults.depth.preset", {"ideal", "astra", "kinect_v1"}};
inline const SweepAxis kDraws{"fusion.blend.N", {"1", "10"}};

class FiguresTest : public ::testing::Test {
 protected:
  FiguresTest()
      : folder_(std::filesystem::temp_directory_path() /
                std::filesystem::path("mapscore_figures_" + name())) {
    std::filesystem::remove_all(folder_);
  }
  ~FiguresTest() override { std::filesystem::remove_all(folder_); }

  static std::string name() {
    return ::testing::UnitTest::GetInstance()->current_test_info()->name();
  }
  std::filesystem::path folder_;
};

inline std::string text_of(const std::filesystem::path& file) {
  std::ifstream stream(file, std::ios::binary);
  return {std::istreambuf_iterator<char>(stream), {}};
}

/// Lines of the block of a data file that starts with this comment, without comments.
inline std::vector<std::string> block(const std::string& data, const std::string& comment) {
  std::istringstream lines(data);
  std::vector<std::string> found;
  bool inside = false;
  for (std::string line; std::getline(lines, line);) {
    if (line.empty()) inside = false;
    if (inside && line[0] != '#') found.push_back(line);
    if (line == comment) inside = true;
  }
  return found;
}

inline int blocks(const std::string& data) {
  int count = 1;
  for (std::size_t at = data.find("\n\n\n"); at != std::string::npos;
       at = data.find("\n\n\n", at + 1))
    ++count;
  return count;
}

inline StudySummary one_axis(int seeds = 2) {
  return synthetic_summary(synthetic_study({"direct", "erosion"}, {kShift}, seeds));
}

}  // namespace mapscore::eval::testing
