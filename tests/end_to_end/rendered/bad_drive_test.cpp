// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#include "tests/end_to_end/program.hpp"
#include "tests/support/tiny_recording.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace mapscore::testing {
namespace {

namespace fs = std::filesystem;

/// A study that drives on wheels before a wall and round a table.
class BadDrive : public ::testing::Test {
 protected:
  BadDrive() {
    fs::copy(fs::path(MAPSCORE_SOURCE_DIR) / "scenes/robot.xml", folder());
    write_text(folder() / "room.xml",
               "<mujoco><worldbody>\n"
               "<body name='floor_1'><geom type='box' pos='0 0 -.05' size='4 4 .05'/></body>\n"
               "<body name='wall_3'><geom type='box' pos='2 0 1' size='.05 1 1'/></body>\n"
               "<body name='table_7'><geom type='box' pos='-2 0 .7' size='.4 .4 .02'/></body>\n"
               "</worldbody></mujoco>\n");
    write_study("[[0, 0, 0], [0.5, 0, 0]]");
  }

  void write_study(const std::string& waypoints, const std::string& more = "") const {
    write_text(folder() / "study.yaml",
               "scene: room.xml\n"
               "trajectory: {waypoints_m_deg: " +
                   waypoints +
                   ", drive: wheels}\n"
                   "cameras: {width_px: 64, height_px: 48}\n"
                   "methods: {direct: {segmentation: {direct: {}}}}\n" +
                   more);
  }
  [[nodiscard]] const fs::path& folder() const { return temporary_.path(); }
  [[nodiscard]] Outcome record(const std::vector<std::string>& flags = {}) const {
    std::vector<std::string> arguments{"record", folder() / "study.yaml", "-o",
                                       folder() / "recording"};
    for (const std::string& flag : flags) arguments.insert(arguments.end(), {"--set", flag});
    return mapscore(arguments);
  }
  void expect_refused_without_a_trace(const std::vector<std::string>& parts,
                                      const std::vector<std::string>& flags = {}) const {
    expect_refused(record(flags), parts);
    EXPECT_FALSE(fs::exists(folder() / "recording"));
    EXPECT_FALSE(fs::exists(folder() / "recording.partial"));
  }

 private:
  TemporaryFolder temporary_;
};

TEST_F(BadDrive, TheSoundOneIsRecordedAndItsLogsAreTold) {
  const Outcome outcome = record();
  expect_done(outcome);
  EXPECT_THAT(outcome.err, ::testing::HasSubstr("drive 2/2 waypoints"));
  EXPECT_THAT(outcome.err, ::testing::HasSubstr("record "));
  const Outcome info = mapscore({"info", folder() / "recording"});
  expect_done(info);
  EXPECT_THAT(info.out, ::testing::HasSubstr("odometry: "));
  EXPECT_THAT(info.out, ::testing::HasSubstr("deg off the truth"));
  EXPECT_THAT(info.out, ::testing::HasSubstr("scans of 360 beams, 0.15 to 12 m"));
}

TEST_F(BadDrive, AStartInsideAWall) {
  write_study("[[2, 0.3, 0], [0, 0, 0]]");
  expect_refused_without_a_trace(
      {"trajectory: waypoint 1 (2.000, 0.300 m), the start", "would stand in `wall_3`", "move"});
}

TEST_F(BadDrive, AWaypointUnderATable) {
  write_study("[[0, 0, 0], [0, 1, 0], [-2, 0, 0]]");
  expect_refused_without_a_trace({"waypoint 3 (-2.000, 0.000 m)", "would stand in `table_7`"});
}

TEST_F(BadDrive, AWaypointThatCannotBeReached) {
  write_study("[[0, 0, 0], [3, 0, 0]]");
  expect_refused_without_a_trace(
      {"waypoint 2 (3.000, 0.000 m) cannot be reached", "`wall_3` stands in the way", "around"});
}

TEST_F(BadDrive, AWaypointBesideTheFloor) {
  write_study("[[0, 0, 0], [0, 6, 0]]");
  expect_refused_without_a_trace({"waypoint 2", "no floor"});
}

TEST_F(BadDrive, SettingsThatCannotBe) {
  const std::string wheels = "trajectory.drive.wheels.";
  expect_refused_without_a_trace({"encoder_ticks_per_turn", "0 is out of range"},
                                 {wheels + "encoder_ticks_per_turn=0"});
  expect_refused_without_a_trace({"clearance_m", "-1 is out of range"},
                                 {wheels + "clearance_m=-1"});
  expect_refused_without_a_trace({"acceleration_mps2", "out of range"},
                                 {wheels + "acceleration_mps2=0"});
  expect_refused_without_a_trace({"wheel_radius_error_percent", "out of range"},
                                 {wheels + "wheel_radius_error_percent=-100"});
  expect_refused_without_a_trace({"drive", "unknown kind 'legs'", "wheels"},
                                 {"trajectory.drive={legs: {}}"});
  expect_refused_without_a_trace({"lidar.range_min_m", "20 is not below range_max_m, 12"},
                                 {"lidar.range_min_m=20"});
  expect_refused_without_a_trace({"lidar.beams", "out of range"}, {"lidar.beams=0"});
}

TEST_F(BadDrive, ARobotWithoutWheels) {
  fs::remove(folder() / "robot.xml");
  fs::copy(fs::path(MAPSCORE_SOURCE_DIR) / "tests/data/robot.xml", folder());
  expect_refused_without_a_trace({"robot.xml", "no hinge joint `wheel_left`"});
}

TEST_F(BadDrive, OfARecordingWhoseScansAreCut) {
  expect_done(record());
  const fs::path scans = folder() / "recording/scan/scans.bin";
  const std::string bytes = bytes_of(scans);
  write_text(scans, bytes.substr(0, bytes.size() / 2));
  expect_refused(mapscore({"info", folder() / "recording"}),
                 {"scans.bin", "not as its header says"});
  fs::remove(scans);
  expect_refused(mapscore({"info", folder() / "recording"}), {"scans.bin", "file is missing"});
}

}  // namespace
}  // namespace mapscore::testing
