// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#include "eval/render/study_recording.hpp"

#include "eval/render/own_robot.hpp"
#include "tests/support/tiny_recording.hpp"

#include <gtest/gtest.h>

#include <fstream>

namespace mapscore::eval {
namespace {

namespace fs = std::filesystem;

void write_robot(const fs::path& folder) {
  fs::create_directories(folder);
  std::ofstream(folder / "robot.xml") << "<mujoco/>";
}

TEST(OwnRobot, IsThatOfTheSourceTreeOrOfTheInstallation) {
  const mapscore::testing::TemporaryFolder folder;
  fs::create_directories(folder.path() / "build/release");
  EXPECT_EQ(own_robot_of(folder.path() / "build/release"), std::nullopt);
  write_robot(folder.path() / "scenes");
  EXPECT_EQ(own_robot_of(folder.path() / "build/release"), folder.path() / "scenes/robot.xml");
  fs::create_directories(folder.path() / "usr/bin");
  write_robot(folder.path() / "usr/share/mapscore/scenes");
  EXPECT_EQ(own_robot_of(folder.path() / "usr/bin"),
            folder.path() / "usr/share/mapscore/scenes/robot.xml");
}

TEST(OwnRobot, RobotsOfOtherScenesAreNotTakenForOurs) {
  const mapscore::testing::TemporaryFolder folder;
  const fs::path file = folder.path() / "robot.xml";
  EXPECT_FALSE(names_base_footprint(file));
  std::ofstream(file) << "<mujocoinclude><body name='robot0:base_link'/></mujocoinclude>";
  EXPECT_FALSE(names_base_footprint(file));
  std::ofstream(file) << "<mujoco><worldbody><body name='base_footprint'/></worldbody></mujoco>";
  EXPECT_TRUE(names_base_footprint(file));
  EXPECT_TRUE(names_base_footprint(fs::path(MAPSCORE_SOURCE_DIR) / "scenes/robot.xml"));
}

}  // namespace
}  // namespace mapscore::eval
