// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#include "eval/explore/exploration_files.hpp"

#include "files/file_bytes.hpp"
#include "tests/support/expect_error.hpp"
#include "tests/support/tiny_recording.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>

namespace mapscore::eval {
namespace {

namespace fs = std::filesystem;
using ::testing::HasSubstr;

/// A drive of 4 m in 30 s, a frame each 10 s.
ExplorationResult straight_drive() {
  ExplorationResult result;
  OccupancyGrid floor({0.05, {}, 8, 4});
  floor.set({2, 1}, kFreeCell);
  for (const double stamp_s : {0.0, 10.0, 20.0, 30.0}) {
    const double driven_m = stamp_s * 4.0 / 30.0;
    result.curve.push_back({stamp_s, driven_m, 1, 0.01 * stamp_s, 0.0, MapState{}});
    result.frames.push_back({stamp_s, Pose(Eigen::Translation3d(driven_m, 0.0, 0.0))});
    result.moments.push_back({stamp_s, driven_m, floor, {{stamp_s, 1.0}}});
  }
  result.driven_m = 4.0;
  result.duration_s = 30.0;
  return result;
}

class ExplorationFiles : public ::testing::Test {
 protected:
  ExplorationFiles() {
    fs::create_directories(run_);
    write_file(run_ / kMapFile, "a map");
    testing::write_tiny_recording(run_ / "recording");
    write_exploration(straight_drive(), "key", run_);
  }

  void expect_damaged(const std::string& part) const {
    testing::expect_error(part, [&] { (void)read_exploration(run_); });
    testing::expect_error("remove " + run_.string() + " to explore it anew",
                          [&] { (void)read_exploration(run_); });
  }
  void replace_in(const char* name, const std::string& from, const std::string& to) const {
    std::string text = read_file(run_ / name);
    ASSERT_NE(text.find(from), text.npos);
    write_file(run_ / name, text.replace(text.find(from), from.size(), to));
  }

  testing::TemporaryFolder temporary_;
  const fs::path run_ = temporary_.path() / "runs/seed0";
};

TEST_F(ExplorationFiles, ReadBackAsTheyWereWritten) {
  EXPECT_EQ(key_of_exploration(run_), "key");
  const auto kept = read_exploration(run_);
  ASSERT_TRUE(kept);
  EXPECT_EQ(kept->end, "budget");
  EXPECT_EQ(kept->frames, 4u);
  EXPECT_EQ(curve_text(kept->curve), curve_text(straight_drive().curve));
  EXPECT_FALSE(read_exploration(run_.parent_path()));
  EXPECT_FALSE(key_of_exploration(run_.parent_path()));
}

// Of a robot that looks around at 0 m, and then drives 4 m to the end.
TEST_F(ExplorationFiles, NoMomentIsKeptTwiceAndTheLastIsTheEnd) {
  ExplorationResult result = straight_drive();
  result.moments[1].driven_m = result.moments[2].driven_m = 0.0;
  write_exploration(result, "key", run_);
  EXPECT_EQ(read_file(run_ / kMomentsFile), "moment,stamp_s,driven_m\n1,20,0\n2,30,4\n");
  EXPECT_EQ(read_file(run_ / kFrontiersFile), "moment,x_map_m,y_map_m\n1,20,1\n2,30,1\n");
}

TEST_F(ExplorationFiles, WhatIsMeasuredMayChange) {
  write_file(run_ / kTimesFile, "");
  EXPECT_TRUE(read_exploration(run_));
}

TEST_F(ExplorationFiles, ACutFileIsRefused) {
  for (const char* name : {kCurveFile, kViewsFile, kWayFile, kMomentsFile, kFrontiersFile, kMapFile,
                           "floor_2.pgm", "floor_2.yaml"}) {
    const std::string whole = read_file(run_ / name);
    write_file(run_ / name, whole.substr(0, whole.size() / 2));
    expect_damaged(std::string(name) + ": is not as it was written");
    fs::remove(run_ / name);
    expect_damaged(std::string(name) + ": is missing");
    write_file(run_ / name, whole);
    EXPECT_TRUE(read_exploration(run_));
  }
}

TEST_F(ExplorationFiles, SoIsARecordingWithoutAllItsImages) {
  fs::remove(*fs::directory_iterator(run_ / "recording/color"));
  expect_damaged("color");
  fs::remove_all(run_ / "recording");
  expect_damaged("recording: is missing");
}

TEST_F(ExplorationFiles, SoIsARunThatCannotHaveBeenWritten) {
  replace_in(kRunFile, "end: budget", "end: banana");
  expect_damaged("run.yaml:2: end: is banana; write one of explored, nothing_reachable, budget");
  replace_in(kRunFile, "end: banana", "end: budget");
  replace_in(kRunFile, "frames: 4", "frames: 5");
  expect_damaged("curve.csv: holds 4 points, and run.yaml says 5 frames");
  replace_in(kRunFile, "key: key\n", "");
  testing::expect_error("run.yaml", [&] { (void)key_of_exploration(run_); });
}

}  // namespace
}  // namespace mapscore::eval
