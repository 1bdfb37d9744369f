// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#include "tests/end_to_end/program.hpp"
#include "tests/eval/lab/driven_recording.hpp"
#include "tests/support/tiny_recording.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <set>
#include <sstream>
#include <string>
#include <vector>

namespace mapscore::testing {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::Not;
using ::testing::StartsWith;

class LocalizeRun : public ::testing::Test {
 protected:
  LocalizeRun() {
    eval::testing::write_driven_recording(folder() / "driven", true);
    eval::testing::write_driven_recording(folder() / "plain", false);
  }

  [[nodiscard]] const std::filesystem::path& folder() const { return temporary_.path(); }
  [[nodiscard]] std::string path(const std::string& name) const { return folder() / name; }
  [[nodiscard]] Outcome localize(const std::string& recording, std::vector<std::string> more) {
    std::vector<std::string> words{"localize", path(recording), "-o", path("out"), "-q"};
    words.insert(words.end(), more.begin(), more.end());
    return mapscore(words);
  }
  [[nodiscard]] std::vector<std::string> lines_of(const std::string& file) const {
    std::istringstream text(bytes_of(folder() / "out" / file));
    std::vector<std::string> lines;
    for (std::string line; std::getline(text, line);) lines.push_back(line);
    return lines;
  }

 private:
  TemporaryFolder temporary_;
};

TEST_F(LocalizeRun, ComparesEverySourceOfARecording) {
  const Outcome outcome = localize("driven", {"--source", "all", "--seeds", "2"});
  expect_done(outcome);
  EXPECT_THAT(outcome.out, AllOf(HasSubstr("converged_s"), HasSubstr("ate_aligned_m"),
                                 HasSubstr("odometry"), HasSubstr("particle_filter")));
  EXPECT_THAT(outcome.err, HasSubstr("not trajectory: no --set localization.trajectory=FILE"));
  const std::vector<std::string> scores = lines_of("localization_scores.csv");
  ASSERT_EQ(scores.size(), 9u);  // two seeds of four sources
  EXPECT_EQ(scores[0],
            "source,seed,frames,pairs,ate_m,ate_aligned_m,ate_deg,rpe_percent,rpe_deg_per_m,"
            "nees_share,nees_mean,nees6_share,nees6_mean");
  EXPECT_THAT(scores[1], StartsWith("odometry,0,4,0,0.0"));
  EXPECT_EQ(scores[2].substr(10), scores[1].substr(10)) << "odometry has no draw";
  EXPECT_THAT(scores[4], StartsWith("particle_filter,1,4,0,"));
  EXPECT_THAT(scores[5], StartsWith("visual_odometry,0,4,0,"));
  EXPECT_THAT(scores[8], StartsWith("visual_slam,1,4,0,"));
  EXPECT_THAT(outcome.err, HasSubstr("visual_odometry, seed 0: "));
  EXPECT_EQ(lines_of("localization.csv").size(), 1u + 4 * 2 * 4);
  EXPECT_THAT(
      lines_of("localization.csv").front(),
      StartsWith("seed,stamp_s,position_error_m,heading_error_deg,nees,sigma_m,converged,"));
  for (const char* file :
       {"truth_at_frames.txt", "odometry_at_frames.txt", "particle_filter_at_frames.txt",
        "localization_odometry.txt", "poses_by_source.png", "errors_over_time.png", "grid.yaml"})
    EXPECT_TRUE(std::filesystem::exists(folder() / "out" / file)) << file;
}

TEST_F(LocalizeRun, CountsWhatItGoesBy) {
  const auto progress = [&](const std::string& source) {
    return mapscore({"localize", path("driven"), "-o", path("out"), "--source", source}).err;
  };
  EXPECT_THAT(progress("visual_slam"), HasSubstr("localize 4/4 depth images"));
  EXPECT_THAT(progress("particle_filter"), HasSubstr("localize 4/4 turns"));
}

TEST_F(LocalizeRun, LeavesNothingOfAnEarlierRunBesideItsScores) {
  expect_done(localize("driven", {"--source", "all"}));
  write_text(folder() / "out/notes.txt", "mine");
  const Outcome again = localize("driven", {"--source", "visual_odometry"});
  expect_done(again);
  EXPECT_THAT(again.err, HasSubstr("of an earlier run from "));
  std::set<std::string> stems;
  for (const std::string& file : contents_of(folder() / "out"))
    stems.insert(std::filesystem::path(file).stem().string());
  EXPECT_THAT(stems,
              ::testing::ElementsAre("errors_over_time", "localization", "localization_scores",
                                     "notes", "trajectory_on_grid", "truth_at_frames",
                                     "visual_odometry_at_frames", "visual_odometry_tracking"));
}

TEST_F(LocalizeRun, KeepsWhatItReadsOfAnEarlierRun) {
  expect_done(localize("driven", {"--source", "all"}));
  const std::string slam = path("out/localization_visual_slam.txt");
  expect_done(
      localize("driven", {"--source", "trajectory", "--set", "localization.trajectory=" + slam,
                          "--grid", path("out/grid.yaml")}));
  EXPECT_TRUE(std::filesystem::exists(slam));
  EXPECT_TRUE(std::filesystem::exists(folder() / "out/grid.pgm"));
  EXPECT_FALSE(std::filesystem::exists(folder() / "out/localization_odometry.txt"));
}

TEST_F(LocalizeRun, TakesATrajectoryWhereThereAreNoLogs) {
  std::filesystem::copy(folder() / "plain/groundtruth.txt", folder() / "slam.txt");
  const Outcome outcome = localize(
      "plain", {"--source", "trajectory", "--set", "localization.trajectory=" + path("slam.txt")});
  expect_done(outcome);
  EXPECT_THAT(lines_of("localization_scores.csv").at(1), StartsWith("trajectory,0,4,0,0,"));
  EXPECT_TRUE(std::filesystem::exists(folder() / "out/localization.txt"));
  EXPECT_FALSE(std::filesystem::exists(folder() / "out/grid.yaml"));
}

TEST_F(LocalizeRun, SaysWhatASourceLacks) {
  const Outcome none = localize("plain", {"--source", "all"});
  EXPECT_EQ(none.exit_code, 2);
  EXPECT_THAT(none.err, AllOf(HasSubstr("not odometry: no odometry.txt\n"),
                              HasSubstr("not visual_slam: no odometry.txt; --set "
                                        "localization.visual.wheels=false goes without\n"),
                              HasSubstr("no source has anything to go by")));
  EXPECT_EQ(localize("plain", {}).exit_code, 2);
  expect_refused(localize("plain", {"--source", "visual_slam"}),
                 {"visual_slam needs odometry.txt", "localization.visual.wheels=false"});
  expect_done(localize("plain", {"--source", "visual_slam", "--set", "wheels=false"}));
  const Outcome trajectory = localize("driven", {"--source", "trajectory"});
  EXPECT_EQ(trajectory.exit_code, 2);
  EXPECT_THAT(trajectory.err, HasSubstr("localization.trajectory: is missing"));
  EXPECT_THAT(localize("driven", {"--source", "truth"}).err, Not(HasSubstr("terminate")));
}

TEST_F(LocalizeRun, RefusesWhatChangesNothing) {
  const auto refused = [&](std::vector<std::string> flags, const std::string& source,
                           const std::vector<std::string>& parts) {
    flags.insert(flags.end(), {"--source", source});
    expect_refused(localize("driven", flags), parts);
  };
  for (const char* key : {"voxel_m=0.1", "faults.pose.sigma_xy_m=0.01", "faults.time_offset_ms=10",
                          "faults.pose.reported_scale=4", "localization.source=truth"})
    for (const char* source : {"all", "visual_odometry", "odometry"})
      refused({"--set", key}, source, {"--set", key, "no effect", "localization."});
  refused({"--global", "--model", "beam"}, "visual_slam", {"--model", "localization.visual"});
  refused({"--global"}, "odometry", {"--global", "localization.odometry_noise"});
  refused({"--set", "temper=0.2"}, "visual_odometry", {"temper=0.2", "faults.depth"});
  refused({"--set", "localization.visual.loop_way_m=2"}, "visual_odometry", {"loop_way_m"});
  refused({"--set", "localization.visual.corrected=true"}, "visual_odometry", {"corrected"});
  refused({"--set", "faults.depth.preset=astra"}, "particle_filter", {"faults.lidar"});
  EXPECT_FALSE(std::filesystem::exists(folder() / "out"));
}

TEST_F(LocalizeRun, ObeysWhatOneOfTheSourcesObeys) {
  std::vector<std::string> flags{"--source", "all", "--global", "--model", "beam"};
  for (const char* key : {"temper=0.2", "localization.visual.loop_way_m=2", "faults.lidar.scale=2",
                          "faults.mount.magnitude_m=0.01", "most_particles=300",
                          "least_particles=100", "alpha1=0.01"})
    flags.insert(flags.end(), {"--set", key});
  expect_done(localize("driven", flags));
}

}  // namespace
}  // namespace mapscore::testing
