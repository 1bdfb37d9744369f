// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#include "tests/end_to_end/program.hpp"
#include "tests/support/tiny_recording.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <chrono>
#include <filesystem>
#include <string>
#include <thread>

namespace mapscore::testing {
namespace {

namespace fs = std::filesystem;
using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::MatchesRegex;

/// Two rooms, 5 m x 4 m and 3 m x 4 m, and a door between them that is `door_m` wide.
std::string rooms(double door_m) {
  const auto box = [](const char* name, double x, double y, double half_x, double half_y) {
    return "<body name='" + std::string(name) + "'><geom type='box' pos='" + std::to_string(x) +
           " " + std::to_string(y) + " .6' size='" + std::to_string(half_x) + " " +
           std::to_string(half_y) + " .6'/></body>\n";
  };
  const double wall_m = (4.0 - door_m) / 4.0;
  return "<mujoco><worldbody><light pos='1 0 3'/>\n"
         "<body name='floor_1'><geom type='box' pos='1.5 0 -.05' size='4.2 2.2 .05'/></body>\n" +
         box("wall_1", 5.55, 0, .05, 2.1) + box("wall_2", -2.55, 0, .05, 2.1) +
         box("wall_3", 1.5, 2.05, 4.1, .05) + box("wall_4", 1.5, -2.05, 4.1, .05) +
         box("wall_5", 2.5, 2.0 - wall_m, .05, wall_m) +
         box("wall_6", 2.5, wall_m - 2.0, .05, wall_m) + box("crate_1", -1.6, 1.2, .3, .3) +
         box("crate_2", 4.6, -1.2, .3, .3) + "</worldbody></mujoco>\n";
}

class Explore : public ::testing::Test {
 protected:
  Explore() {
    fs::copy(fs::path(MAPSCORE_SOURCE_DIR) / "scenes/robot.xml", folder());
    write_text(folder() / "rooms.xml", rooms(1.2));
    write_text(folder() / "rooms.classes.yaml",
               "classes:\n"
               "  - {name: crate, colour: \"FF0000\", detect: true, bodies: [\"crate_*\"]}\n"
               "  - {name: wall, colour: \"6A0DAD\", detect: false, bodies: [\"wall_*\"]}\n");
    write_study();
  }

  void write_study(const std::string& more = "") const {
    write_text(folder() / "study.yaml",
               "scene: rooms.xml\n"
               "trajectory: {frames_per_s: 1, speed_mps: 0.6, turn_rate_dps: 80}\n"
               "cameras: {width_px: 80, height_px: 60}\n"
               "lidar: {scans_per_s: 2, beams: 180}\n"
               "voxel_m: 0.1\n"
               "exploration: {planner: nearest_frontier, budget_m: 12, budget_s: 90}\n"
               "occupancy: {carve: true}\n"
               "faults: {depth: {preset: astra}, misregistration: {magnitude_m: 0.01}}\n"
               "methods: {direct: {segmentation: {direct: {}}}}\n" +
                   more);
  }
  /// The same faults and method over what was recorded.
  void write_replay() const {
    write_text(folder() / "replay.yaml",
               "recording: out/runs/seed0/recording\nvoxel_m: 0.1\noccupancy: {carve: true}\n"
               "faults: {depth: {preset: astra}, misregistration: {magnitude_m: 0.01}}\n"
               "methods: {direct: {segmentation: {direct: {}}}}\n");
  }
  [[nodiscard]] const fs::path& folder() const { return temporary_.path(); }
  [[nodiscard]] Outcome explore(std::vector<std::string> more = {},
                                const std::string& to = "out") const {
    more.insert(more.begin(), {"explore", folder() / "study.yaml", "-o", folder() / to});
    return mapscore(more);
  }
  void expect_refused_without_a_run(const std::vector<std::string>& parts,
                                    const std::vector<std::string>& flags = {}) const {
    expect_refused(explore(flags), parts);
    EXPECT_FALSE(fs::exists(folder() / "out/runs/seed0"));
    EXPECT_FALSE(fs::exists(folder() / "out/runs/seed0.partial"));
  }

 private:
  TemporaryFolder temporary_;
};

TEST_F(Explore, EndsWithAReasonAndRecordsWhatOtherVerbsTake) {
  const Outcome outcome = explore();
  expect_done(outcome);
  EXPECT_THAT(outcome.out, HasSubstr("# seed0: ended: "));
  EXPECT_THAT(outcome.err, HasSubstr("explore 12/12 m"));
  const fs::path run = folder() / "out/runs/seed0";
  EXPECT_THAT(bytes_of(run / "run.yaml"),
              ::testing::ContainsRegex("\nend: (explored|nothing_reachable|budget)\n"));
  EXPECT_THAT(bytes_of(run / "run.yaml"), HasSubstr("\nbump_contacts: 0\n"));

  const std::string totals = bytes_of(run / "run.yaml");
  const std::size_t driven = totals.find("driven_m: ") + 10;
  const std::string driven_m = totals.substr(driven, totals.find('\n', driven) - driven);
  EXPECT_TRUE(bytes_of(run / "moments.csv").ends_with(',' + driven_m + '\n'));  // the end

  const Outcome info = mapscore({"info", run / "recording"});
  expect_done(info);
  EXPECT_THAT(info.out, AllOf(HasSubstr("odometry: "), HasSubstr("scans of 180 beams")));
  expect_done(mapscore({"map", run / "recording", "-o", folder() / "again.ot", "-q"}));
  write_replay();
  expect_done(mapscore({"sweep", folder() / "replay.yaml", "-o", folder() / "swept", "-q"}));
}

TEST_F(Explore, WhatIsMappedOnTheWayIsWhatIsMappedOfTheRecording) {
  const std::vector<std::vector<std::string>> beliefs{
      {"faults.pose.sigma_xy_m=0.02", "faults.pose.sigma_yaw_deg=0.5", "faults.pose.kind=walk",
       "fusion.blend.N=3"},
      {"localization.source=odometry", "fusion.blend.N=3"},
      {"localization.source=truth"}};
  for (const std::vector<std::string>& belief : beliefs) {
    std::vector<std::string> flags{"-q"};
    for (const std::string& flag : belief) flags.insert(flags.end(), {"--set", flag});
    fs::remove_all(folder() / "out");
    fs::remove_all(folder() / "swept");
    std::vector<std::string> exploring = flags;
    exploring.insert(exploring.end(), {"--set", "exploration.budget_m=4", "--set",
                                       "trajectory.drive={wheels: {track_error_percent: 3}}"});
    expect_done(explore(exploring));
    write_replay();
    flags.insert(flags.begin(), {"run", folder() / "replay.yaml", "-o", folder() / "swept"});
    expect_done(mapscore(flags));
    std::string mapped;
    for (const std::string& name : contents_of(folder() / "swept/runs"))
      if (name.ends_with("/map.ot")) mapped = bytes_of(folder() / "swept/runs" / name);
    EXPECT_FALSE(mapped.empty());
    EXPECT_TRUE(mapped == bytes_of(folder() / "out/runs/seed0/map.ot")) << belief.front();
  }
}

TEST_F(Explore, SameBytesForAnyNumberOfJobsAndNothingIsRunTwice) {
  const std::vector<std::string> two{"-q", "--set", "seeds=2", "--set", "exploration.budget_m=3"};
  std::vector<std::string> one_job = two, two_jobs = two;
  one_job.insert(one_job.end(), {"-j", "1"});
  two_jobs.insert(two_jobs.end(), {"-j", "2"});
  const Outcome first = explore(one_job, "a"), second = explore(two_jobs, "b");
  expect_done(first);
  expect_done(second);
  const std::vector<std::string> files = contents_of(folder() / "a");
  EXPECT_EQ(files, contents_of(folder() / "b"));
  for (const std::string& file : files) {
    if (file.ends_with("times.csv") || !fs::is_regular_file(folder() / "a" / file)) continue;
    EXPECT_EQ(bytes_of(folder() / "a" / file), bytes_of(folder() / "b" / file)) << file;
  }
  const auto written = fs::last_write_time(folder() / "a/runs/seed1/run.yaml");
  const Outcome again = explore(one_job, "a");
  EXPECT_EQ(again.out, first.out);
  EXPECT_EQ(fs::last_write_time(folder() / "a/runs/seed1/run.yaml"), written);
  // Of another study it is not taken for this one's.
  expect_refused(explore({"-q", "--set", "exploration.budget_m=2"}, "a"),
                 {"runs", "seed0", "another study"});
  std::vector<std::string> without = one_job, one_seed = one_job;
  without.emplace_back("--scores_only");
  expect_refused(explore(without, "a"), {"with its recording", "leave out --scores_only"});
  // Tables of some say so.
  one_seed.insert(one_seed.end(), {"--seed", "0"});
  const Outcome some = explore(one_seed, "a");
  EXPECT_EQ(some.exit_code, 0);
  EXPECT_THAT(some.err, HasSubstr("a/runs holds 1 more exploration, which the tables leave out"));
  // What is damaged is not scored.
  const std::string curve = bytes_of(folder() / "a/runs/seed0/curve.csv");
  write_text(folder() / "a/runs/seed0/curve.csv", curve.substr(0, curve.find('\n', 200) + 1));
  expect_refused(explore(one_job, "a"), {"seed0/curve.csv", "is not as it was written", "remove"});
}

TEST_F(Explore, TimeEndsItBeforeAFrameThatIsDueLater) {
  const Outcome outcome =
      explore({"-q", "--scores_only", "--set", "trajectory.frames_per_s=0.04", "--set",
               "exploration.budget_s=30", "--set", "exploration.planner=lawn_mower"});
  expect_done(outcome);
  EXPECT_THAT(bytes_of(folder() / "out/runs/seed0/run.yaml"),
              ::testing::ContainsRegex("\nduration_s: (2[0-9]|30)([.][0-9]*)?\n"));
}

TEST_F(Explore, ADoorTooNarrowEndsWithAReason) {
  write_text(folder() / "rooms.xml", rooms(0.45));
  write_study();
  const Outcome outcome =
      explore({"-q", "--scores_only", "--set", "exploration.start_m_deg=[-1, -1, 0]"});
  expect_done(outcome);
  EXPECT_THAT(outcome.out, HasSubstr("# seed0: ended: "));
  EXPECT_FALSE(fs::exists(folder() / "out/runs/seed0/recording"));
}

TEST_F(Explore, AStartInFurnitureNamesIt) {
  expect_refused_without_a_run({"exploration.start_m_deg", "would stand in `crate_1`", "move"},
                               {"-q", "--set", "exploration.start_m_deg=[-1.6, 1.2, 0]"});
}

TEST_F(Explore, AStartBesideTheFloor) {
  expect_refused_without_a_run({"exploration.start_m_deg", "no floor"},
                               {"-q", "--set", "exploration.start_m_deg=[9, 9, 0]"});
}

TEST_F(Explore, AStartAtTheEdgeOfTheFloor) {
  write_text(folder() / "rooms.xml",
             "<mujoco><worldbody><body name='floor_1'><geom type='box' pos='0 0 -.05' size='2 2 "
             ".05'/></body></worldbody></mujoco>");
  fs::remove(folder() / "rooms.classes.yaml");
  expect_refused_without_a_run({"exploration.start_m_deg", "the floor ends", "move the start"},
                               {"-q", "--set", "exploration.start_m_deg=[1.9, 0, 0]"});
}

TEST_F(Explore, WithoutARobot) {
  fs::remove(folder() / "robot.xml");
  expect_refused_without_a_run({"robot.xml: no such robot file in ", "key robot"}, {"-q"});
}

TEST_F(Explore, ASceneWithoutAPlaceToStand) {
  write_text(folder() / "rooms.xml",
             "<mujoco><worldbody><body name='crate_1'><geom type='box' size='1 1 .5'/></body>"
             "</worldbody></mujoco>");
  fs::remove(folder() / "rooms.classes.yaml");
  expect_refused_without_a_run({"rooms.xml", "no place where the robot can stand"}, {"-q"});
}

TEST_F(Explore, WhatCannotActIsRefused) {
  expect_refused_without_a_run({"exploration.planner", "unknown kind 'best'"},
                               {"--set", "exploration.planner=best"});
  expect_refused_without_a_run(
      {"exploration.planner", "none"},
      {"--set", "exploration.planner=none", "--set", "trajectory.waypoints_m_deg=[[0, 0, 0]]"});
  expect_refused_without_a_run({"occupancy.carve"}, {"-q", "--set", "occupancy.carve=false"});
  expect_refused_without_a_run({"trajectory.max_frames", "exploration.budget_m"},
                               {"-q", "--set", "trajectory.max_frames=3"});
  expect_refused_without_a_run({"localization.source: particle_filter", "whole recording"},
                               {"-q", "--set", "localization.source=particle_filter"});
  expect_refused_without_a_run(
      {"faults.time_offset_ms", "recording"},
      {"-q", "--set", "faults.time_offset_ms=30", "--set", "trajectory.depth_frames_per_s=1"});
  expect_refused_without_a_run({"faults.time_offset_ms", "recording"},
                               {"-q", "--set", "faults.time_offset_ms=30"});
  expect_refused_without_a_run({"trajectory.waypoints_m_deg", "exploration: {planner"},
                               {"--set", "exploration.planner=none"});
  expect_refused_without_a_run({"trajectory.drive", "wheels"}, {"--set", "trajectory.drive=poses"});
  expect_refused_without_a_run({"trajectory.waypoints_m_deg", "is empty"},
                               {"--set", "exploration.planner=waypoints"});
  // And other verbs say whose key it is.
  expect_refused(mapscore({"record", folder() / "study.yaml", "-o", folder() / "recording"}),
                 {"exploration.planner", "mapscore explore"});
  expect_refused(mapscore({"sweep", folder() / "study.yaml", "-o", folder() / "swept"}),
                 {"exploration.planner", "mapscore explore"});
}

TEST_F(Explore, StoppedItLeavesNothingHalfMade) {
  Process running(mapscore_command({"explore", folder() / "study.yaml", "-o", folder() / "out",
                                    "-q", "--set", "trajectory.frames_per_s=50"}));
  const auto images = [&] {
    return contents_of(folder() / "out/runs/seed0.partial/recording.partial/color").size();
  };
  for (int tries = 0; tries < 3000 && images() < 3; ++tries)
    std::this_thread::sleep_for(std::chrono::milliseconds(10));
  ASSERT_GE(images(), 3u);
  running.interrupt();
  const Outcome stopped = running.wait();
  EXPECT_EQ(stopped.exit_code, 130) << stopped.err;
  EXPECT_THAT(stopped.err, HasSubstr("stopped while an exploration ran"));
  EXPECT_FALSE(fs::exists(folder() / "out/runs/seed0"));
  EXPECT_FALSE(fs::exists(folder() / "out/runs/seed0.partial"));
}

}  // namespace
}  // namespace mapscore::testing
