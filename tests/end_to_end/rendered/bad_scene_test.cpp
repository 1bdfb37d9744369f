// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#include "tests/end_to_end/program.hpp"
#include "tests/support/tiny_recording.hpp"

#include <gtest/gtest.h>

namespace mapscore::testing {
namespace {

namespace fs = std::filesystem;

/// A folder with a sound scene, room.xml, the robot, and a study of it.
class BadScene : public ::testing::Test {
 protected:
  BadScene() {
    fs::copy(fs::path(MAPSCORE_SOURCE_DIR) / "scenes/robot.xml", folder());
    write_text(folder() / "room.xml", kRoom);
    write_text(folder() / "study.yaml",
               "scene: room.xml\n"
               "trajectory: {waypoints_m_deg: [[0, 0, 0], [0.5, 0, 0]], frames_per_s: 4}\n"
               "cameras: {width_px: 64, height_px: 48}\n"
               "methods: {direct: {segmentation: {direct: {}}}}\n");
  }

  static constexpr const char* kRoom =
      "<mujoco><worldbody>\n"
      "<body name='cup_1' pos='1.5 0 0.5'><geom type='box' size='.2 .2 .3'/></body>\n"
      "</worldbody></mujoco>\n";

  [[nodiscard]] const fs::path& folder() const { return temporary_.path(); }
  [[nodiscard]] Outcome sweep(const Surroundings& surroundings = {}) const {
    return mapscore({"sweep", folder() / "study.yaml", "-o", folder() / "results", "-q"},
                    surroundings);
  }
  void expect_refused_without_a_trace(const std::vector<std::string>& parts) const {
    const auto before = contents_of(folder());
    expect_refused(sweep(), parts);
    EXPECT_EQ(contents_of(folder()), before);
  }

 private:
  TemporaryFolder temporary_;
};

TEST_F(BadScene, TheSoundOneIsSwept) {
  expect_done(sweep());
}

TEST_F(BadScene, ThatIsNotThere) {
  fs::remove(folder() / "room.xml");
  expect_refused_without_a_trace({"room.xml", "no such scene", "check the path"});
}

TEST_F(BadScene, OfBrokenXml) {
  write_text(folder() / "room.xml", "<mujoco>\n<worldbody>\n<geom></worldbody></mujoco>\n");
  expect_refused_without_a_trace({"room.xml", "MuJoCo refuses it", "Line number=3", "mend"});
}

TEST_F(BadScene, WithAnUnknownElement) {
  write_text(folder() / "room.xml", "<mujoco><worldbody>\n<chair/>\n</worldbody></mujoco>\n");
  expect_refused_without_a_trace({"room.xml", "MuJoCo refuses it", "'chair', line 2", "mend"});
}

TEST_F(BadScene, ThatDoesNotCompile) {
  write_text(folder() / "room.xml",
             "<mujoco><worldbody>\n<geom type='mesh' mesh='teapot'/>\n</worldbody></mujoco>\n");
  expect_refused_without_a_trace({"room.xml", "'teapot' not found", "line 2", "mend"});
}

TEST_F(BadScene, WithABrokenClassFile) {
  write_text(folder() / "room.classes.yaml", "classes:\n  - {nam: cup}\n");
  expect_refused_without_a_trace({"room.classes.yaml:2", "classes[0].nam", "did you mean 'name'?"});
  write_text(folder() / "room.classes.yaml", "classes: [\n");
  expect_refused_without_a_trace({"room.classes.yaml:", "YAML"});
}

TEST_F(BadScene, WithoutARobot) {
  fs::remove(folder() / "robot.xml");
  expect_refused_without_a_trace({"robot.xml", "no such robot", "check the path"});
}

TEST_F(BadScene, AFullDiskLeavesNoRecording) {
  expect_refused(sweep({.file_size_limit = 300, .standard_output = {}}),
                 {"recordings/room", "cannot write", "make room"});
  EXPECT_TRUE(contents_of(folder() / "results/recordings").empty());
  expect_done(sweep());
}

TEST_F(BadScene, AFileInTheWayOfTheRecording) {
  write_text(folder() / "results", "mine");
  expect_refused_without_a_trace({"results", "cannot create the folder", "give another"});
  EXPECT_EQ(bytes_of(folder() / "results"), "mine");
}

TEST_F(BadScene, ARecordingThatIsThereIsKept) {
  const std::string recording = folder() / "taken";
  fs::create_directory(recording);
  expect_refused(mapscore({"record", folder() / "study.yaml", "-o", recording}),
                 {"taken", "exists already", "give another"});
  EXPECT_TRUE(fs::is_empty(recording));
}

}  // namespace
}  // namespace mapscore::testing
