// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#include "tests/end_to_end/program.hpp"
#include "tests/eval/lab/driven_recording.hpp"
#include "tests/support/tiny_recording.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <functional>
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
  void record(const std::function<void(std::vector<Frame>&)>& change) const {
    std::vector<Frame> frames = tiny_frames();
    change(frames);
    eval::RecordingInfo info = tiny_info();
    info.frame_count = static_cast<int>(frames.size());
    eval::RecordingWriter writer(folder() / "driven", info);
    for (const Frame& frame : frames) write_frame(writer, frame);
    writer.write_shapes(eval::testing::driven_home());
    writer.write_odometry(eval::testing::driven_odometry(frames));
    writer.finish();
    write_text(folder() / "study.yaml",
               "recording: driven\nmethods: {direct: {segmentation: {direct: {}}}}\n"
               "localization: {source: visual_odometry}\n");
  }
  [[nodiscard]] Outcome localize(const std::string& source) const {
    return mapscore({"localize", path("driven"), "-o", path("out"), "-q", "--source", source});
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

TEST_F(OdometryInput, WithoutDepthTheWheelsCarryAndItIsSaid) {
  record([](std::vector<Frame>& frames) {
    for (Frame& frame : frames) frame.depth.setTo(0);
  });
  const Outcome outcome = localize("visual_odometry");
  expect_done(outcome);
  EXPECT_THAT(outcome.err, HasSubstr("4 blind of 4 depth images"));
  EXPECT_THAT(bytes_of(folder() / "out/visual_odometry_tracking.csv"), HasSubstr(",blind,0,0,"));
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
  EXPECT_THAT(outcome.err, HasSubstr(" of 4 depth images"));
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
  const std::string info = bytes_of(folder() / "driven/recording.yaml");
  std::filesystem::remove(folder() / "driven/hashes.txt");
  const Outcome outcome = localize("visual_odometry");
  EXPECT_EQ(outcome.exit_code, 2) << info << outcome.err;
  EXPECT_THAT(outcome.err, HasSubstr("odometry"));
}

}  // namespace
}  // namespace mapscore::testing
