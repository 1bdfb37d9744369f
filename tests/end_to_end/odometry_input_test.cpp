// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#include "tests/end_to_end/program.hpp"
#include "tests/eval/lab/driven_recording.hpp"
#include "tests/support/tiny_recording.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <functional>
#include <iterator>
#include <sstream>
#include <string>
#include <vector>

// Recordings from which visual odometry can learn little, or that are damaged, by the built
// program.

namespace mapscore::testing {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;

class OdometryInput : public ::testing::Test {
 protected:
  /// The driven recording after a change of its frames, with the odometry of what is left.
  void record(const std::function<void(std::vector<Frame>&)>& change,
              double wheels_late_s = 0.0) const {
    std::vector<Frame> frames = tiny_frames();
    change(frames);
    eval::RecordingInfo info = tiny_info();
    info.frame_count = static_cast<int>(frames.size());
    eval::RecordingWriter writer(folder() / "driven", info);
    for (const Frame& frame : frames) write_frame(writer, frame);
    writer.write_shapes(eval::testing::driven_home());
    std::vector<eval::OdometryPose> odometry = eval::testing::driven_odometry(frames);
    for (eval::OdometryPose& line : odometry) line.stamp_s += wheels_late_s;
    writer.write_odometry(odometry);
    writer.finish();
    write_text(folder() / "study.yaml",
               "recording: driven\nmethods: {direct: {segmentation: {direct: {}}}}\n"
               "localization: {source: visual_odometry}\n");
  }
  [[nodiscard]] Outcome localize(const std::string& source,
                                 const std::vector<std::string>& more = {}) const {
    std::vector<std::string> words{"localize", path("driven"), "-o",  path("out"),
                                   "-q",       "--source",     source};
    words.insert(words.end(), more.begin(), more.end());
    return mapscore(words);
  }
  [[nodiscard]] Outcome run() const {
    return mapscore({"run", path("study.yaml"), "-o", path("results"), "-q"});
  }

  [[nodiscard]] const std::filesystem::path& folder() const { return temporary_.path(); }
  [[nodiscard]] std::string path(const std::string& name) const { return folder() / name; }

 private:
  TemporaryFolder temporary_;
};

TEST_F(OdometryInput, OneFrameIsAtItsStart) {
  record([](std::vector<Frame>& frames) { frames.resize(1); });
  for (const char* source : {"visual_odometry", "visual_slam"}) {
    const Outcome outcome = localize(source);
    expect_done(outcome);
    EXPECT_THAT(outcome.err, HasSubstr("1 started of 1 depth images; 0 loops closed"));
    EXPECT_THAT(bytes_of(folder() / "out/localization_scores.csv"),
                HasSubstr(std::string(source) + ",0,1,0,"));
  }
  const Outcome mapped = run();
  expect_done(mapped);
  EXPECT_THAT(mapped.out, HasSubstr("# poses: 1 started of 1 depth images"));
}

TEST_F(OdometryInput, WithoutAnyDepthThereAreNoPoses) {
  record([](std::vector<Frame>& frames) {
    for (Frame& frame : frames) frame.depth.setTo(0);
  });
  for (const char* source : {"visual_odometry", "visual_slam"})
    expect_refused(localize(source), {"depth.txt", "no depth image has enough depth"});
  expect_refused(run(), {"depth.txt", "no depth image has enough depth"});
}

TEST_F(OdometryInput, NorWhereTheStudysCameraSeesNone) {
  record([](std::vector<Frame>&) {});
  expect_done(localize("visual_odometry"));
  const auto files = {"localization.txt", "localization_scores.csv", "trajectory_on_grid.png",
                      "visual_odometry_tracking.csv"};
  std::vector<std::string> earlier;
  for (const char* file : files) earlier.push_back(bytes_of(folder() / "out" / file));
  expect_refused(localize("visual_odometry", {"--set", "faults.depth.range=1", "--set",
                                              "faults.depth.range_max_m=0.61"}),
                 {"depth.txt", "no depth image has enough depth", "faults.depth"});
  std::size_t n = 0;
  for (const char* file : files)
    EXPECT_EQ(bytes_of(folder() / "out" / file), earlier.at(n++))
        << "what was there is lost: " << file;
}

TEST_F(OdometryInput, ADarkFrameInATrialIsSaidByRunAndInTheTidyTable) {
  record([](std::vector<Frame>& frames) { frames[2].depth.setTo(0); });
  const Outcome mapped = run();
  expect_done(mapped);
  EXPECT_THAT(mapped.out, AllOf(HasSubstr("# poses: 1 started, "), HasSubstr("1 blind")));
  expect_done(mapscore({"sweep", path("study.yaml"), "-o", path("results"), "-q"}));
  const Outcome table = mapscore({"table", path("results"), "--tidy"});
  expect_done(table);
  EXPECT_THAT(table.out, AllOf(HasSubstr("trial,direct,0,all,images_blind,1\n"),
                               HasSubstr("trial,direct,0,all,images_started,1\n"),
                               HasSubstr("trial,direct,0,all,loops_closed,0\n")));
}

TEST_F(OdometryInput, AGapOfSecondsIsCarriedByTheWheels) {
  record([](std::vector<Frame>& frames) {
    for (std::size_t n = 2; n < frames.size(); ++n) frames[n].stamp_s += 20.0;
  });
  const Outcome outcome = localize("visual_odometry");
  expect_done(outcome);
  EXPECT_THAT(outcome.err, AllOf(HasSubstr(" of 4 depth images"),
                                 HasSubstr("s lie in gaps of the depth images")));
  // Between the images the robot knows less and less of where it is, and then what they show.
  std::vector<double> variances_x;
  std::istringstream lines(bytes_of(folder() / "out/localization.txt"));
  for (std::string line; std::getline(lines, line);) {
    if (line[0] == '#') continue;
    std::istringstream words(line);
    const std::vector<double> numbers{std::istream_iterator<double>(words), {}};
    ASSERT_EQ(numbers.size(), 44u);
    if (numbers[0] > 1.0 && numbers[0] < 20.0) variances_x.push_back(numbers[8]);
  }
  ASSERT_GT(variances_x.size(), 50u);
  EXPECT_TRUE(std::ranges::is_sorted(variances_x));
  EXPECT_GT(variances_x.back(), 4.0 * variances_x.front());
}

TEST_F(OdometryInput, StampsThatJumpBackAreOneLine) {
  record([](std::vector<Frame>&) {});
  const std::string list = bytes_of(folder() / "driven/depth.txt");
  const std::size_t second = list.find("depth/000001");
  const std::size_t line = list.rfind('\n', second) + 1;
  write_text(folder() / "driven/depth.txt", list.substr(0, line) + "-1 " + list.substr(second));
  std::filesystem::remove(folder() / "driven/hashes.txt");
  expect_refused(localize("visual_odometry"), {"depth.txt", "does not come after"});
  expect_refused(run(), {"depth.txt", "does not come after"});
}

TEST_F(OdometryInput, OdometryThatEndsBeforeTheImagesIsOneLine) {
  record([](std::vector<Frame>&) {});
  const std::string log = bytes_of(folder() / "driven/odometry.txt");
  const std::size_t third = log.rfind('\n', log.rfind('\n', log.size() - 2) - 1);
  write_text(folder() / "driven/odometry.txt", log.substr(0, third + 1));
  std::filesystem::remove(folder() / "driven/hashes.txt");
  expect_refused(localize("visual_odometry"), {"odometry.txt", "2 lines"});
}

TEST_F(OdometryInput, OdometryThatStartsAfterTheImagesIsOneLine) {
  const std::vector<Frame> frames = tiny_frames();
  record([](std::vector<Frame>&) {}, 2.5 * (frames[1].stamp_s - frames[0].stamp_s));
  for (const char* source : {"odometry", "visual_odometry"})
    expect_refused(localize(source), {"odometry.txt: reaches from", "not to the stamp"});
}

}  // namespace
}  // namespace mapscore::testing
