// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#include "sim/world/motion.hpp"

#include "core/error.hpp"
#include "sim/world/world.hpp"
#include "tests/sim/world/scene_files.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace mapscore::sim {
namespace {

Motion motion_of(const std::string& text) {
  const testing::SceneFolder folder;
  return read_motion(folder.write("m.csv", text));
}

void expect_refusal(const std::string& text, const std::string& part) {
  try {
    (void)motion_of(text);
    ADD_FAILURE() << "accepted: " << text;
  } catch (const Error& error) {
    EXPECT_NE(std::string(error.what()).find(part), std::string::npos) << error.what();
    EXPECT_EQ(std::string(error.what()).find('\n'), std::string::npos);
  }
}

TEST(Motion, IsLinearBetweenRowsAndStandsStillOutside) {
  const Motion motion = motion_of("# a comment\nstamp_s,a,b\n1,0.5,-2\r\n3,1.5,2\n4,0,0\n");
  EXPECT_EQ(motion.joints, (std::vector<std::string>{"a", "b"}));
  EXPECT_EQ(motion.at(0.0), (std::vector<double>{0.5, -2}));
  EXPECT_EQ(motion.at(1.0), (std::vector<double>{0.5, -2}));
  EXPECT_EQ(motion.at(1.5), (std::vector<double>{0.75, -1}));
  EXPECT_EQ(motion.at(3.0), (std::vector<double>{1.5, 2}));
  EXPECT_EQ(motion.at(3.75), (std::vector<double>{0.375, 0.5}));
  EXPECT_EQ(motion.at(9.0), (std::vector<double>{0, 0}));
  EXPECT_EQ(motion.file, "m.csv");
  EXPECT_NE(motion.hash, motion_of("stamp_s,a,b\n1,0.5,-2\n").hash);
}

TEST(Motion, RefusesWhatIsNoMotionInOneLine) {
  expect_refusal("", "no rows");
  expect_refusal("stamp_s,a\n", "no rows");
  expect_refusal("time,a\n0,0\n", ":1: the header");
  expect_refusal("stamp_s\n0\n", ":1: the header");
  expect_refusal("stamp_s,a,a\n0,0,0\n", "'a' stands twice");
  expect_refusal("stamp_s,a,b\n0,1,2\n1,1\n", ":3: 2 columns, the header has 3");
  expect_refusal("stamp_s,a\n0,1,2\n", ":2: 3 columns");
  expect_refusal("stamp_s,a\n0,1\n0,2\n", ":3: stamp 0 does not come after 0");
  expect_refusal("stamp_s,a\n2,1\n1,2\n", ":3: stamp 1 does not come after 2");
  expect_refusal("stamp_s,a\n0,nan\n", ":2: 'nan' is not a finite number");
  expect_refusal("stamp_s,a\ninf,0\n", "'inf' is not a finite number");
  expect_refusal("stamp_s,a\n0,1x\n", "'1x' is not a finite number");
  EXPECT_THROW((void)read_motion("/no/such/file.csv"), Error);
}

/// A lever of length 1 on a hinge at (2, 0, 1), a sphere on a slide, and a box that stays.
const char* const kLevers = R"(
  <body name="lever_1" pos="2 0 1">
    <joint name="swing" axis="0 0 1"/>
    <geom type="capsule" fromto="0 0 0 1 0 0" size="0.05"/>
    <body name="tip"><geom name="tip" type="mesh" mesh="tetra" pos="1 0 0"/></body>
  </body>
  <body name="ball_1" pos="3 1 0.5">
    <joint name="lift" type="slide" axis="0 0 2"/>
    <geom type="sphere" size="0.2"/>
  </body>
  <body name="tumbler_1" pos="3 -1 0.5"><freejoint name="free"/><geom type="box" size="0.1 0.1 0.1"/></body>
  <geom name="still" type="box" pos="4 0 1" size="0.1 1 1"/>)";

World levers() {
  return testing::load_text(testing::mjcf(
      kLevers, R"(<asset><mesh name="tetra" vertex="0 0 0  0.2 0 0  0 0.2 0  0 0 0.2"/></asset>)"));
}

TEST(MovingScene, MovesWhatHangsOnTheJointsAndNothingElse) {
  const World world =
      levers().moving(motion_of("stamp_s,swing,lift\n0,0,0\n2,3.14159265358979,1\n"));
  MovingScene scene(world);
  scene.move_to(1.0);  // a quarter turn, half the lift
  for (std::size_t i = 0; i < world.shapes().size(); ++i) {
    const Shape& shape = world.shapes()[i];
    const Eigen::Vector3d before = shape.T_world_shape.translation();
    const Eigen::Vector3d now = scene.poses()[i].translation();
    const Eigen::Vector3d arm = before - Eigen::Vector3d(2, 0, 1);
    if (shape.kind == ShapeKind::capsule || shape.kind == ShapeKind::mesh)
      EXPECT_LT((now - Eigen::Vector3d(2 - arm.y(), arm.x(), 1 + arm.z())).norm(), 1e-9);
    else if (shape.kind == ShapeKind::sphere)
      EXPECT_LT((now - Eigen::Vector3d(3, 1, 1.0)).norm(), 1e-12);
    else
      EXPECT_TRUE(scene.poses()[i].matrix() == shape.T_world_shape.matrix()) << shape.name;
  }
}

TEST(MovingScene, AtTheJointsOwnZeroIsTheSceneAsLoaded) {
  const World world = levers();
  const World moving = world.moving(motion_of("stamp_s,swing,lift\n0,0,0\n2,0,0\n"));
  const World there = moving.at(1.3);
  EXPECT_EQ(there.motion(), nullptr);
  EXPECT_EQ(moving.hash(), world.hash());
  for (std::size_t i = 0; i < world.shapes().size(); ++i)
    EXPECT_TRUE(there.shapes()[i].T_world_shape.matrix() ==
                world.shapes()[i].T_world_shape.matrix());
}

TEST(MovingScene, RefusesJointsThatAreNotThereOrTurnFreely) {
  const World world = levers();
  try {
    (void)world.moving(motion_of("stamp_s,sving\n0,0\n"));
    FAIL();
  } catch (const Error& error) {
    EXPECT_STREQ(error.what(),
                 "m.csv: the scene has no joint 'sving'; its joints: swing, lift, free");
  }
  EXPECT_THROW((void)world.moving(motion_of("stamp_s,free\n0,0\n")), Error);
}

/// The committed person: soles stay above the rug, hands and steps are as fast as they should be.
TEST(MovingPerson, StandsOnTheRugAndMovesAsFastAsPeopleDo) {
  const std::filesystem::path scenes = std::filesystem::path(MAPSCORE_SOURCE_DIR) / "scenes";
  const World world = World::load({scenes / "moving_person.xml", {}, scenes / "robot.xml"}, {})
                          .moving(read_motion(scenes / "moving_person.motion.csv"));
  ASSERT_EQ(world.motion()->stamps_s.size(), 715u);
  ASSERT_LT(std::filesystem::file_size(scenes / "moving_person.motion.csv"), 300000u);
  MovingScene scene(world);
  double lowest = 1.0, highest_sole = -1.0, fastest_hand = 0.0, fastest_hip = 0.0;
  std::vector<Pose> before;
  for (int frame = 0; frame < 715; ++frame) {
    scene.move_to(frame / 30.0);
    double least_sole = 1.0;
    for (std::size_t i = 0; i < world.shapes().size(); ++i) {
      const Shape& shape = world.shapes()[i];
      if (world.classes().instances[shape.instance].name != "person_1") continue;
      const Pose& pose = scene.poses()[i];
      const double speed =
          before.empty() ? 0 : (pose.translation() - before[i].translation()).norm() * 30;
      if (shape.kind == ShapeKind::ellipsoid && std::abs(shape.size.z() - 0.083) < 1e-9)
        fastest_hand = std::max(fastest_hand, speed);
      if (shape.kind == ShapeKind::ellipsoid && std::abs(shape.size.y() - 0.178) < 1e-9)
        fastest_hip = std::max(fastest_hip, speed);
      if (shape.kind != ShapeKind::box) continue;
      for (int corner = 0; corner < 8; ++corner) {
        const Eigen::Vector3d sign(corner & 1 ? 1 : -1, corner & 2 ? 1 : -1, corner & 4 ? 1 : -1);
        least_sole = std::min(least_sole, (pose * shape.size.cwiseProduct(sign)).z());
      }
    }
    lowest = std::min(lowest, least_sole);
    highest_sole = std::max(highest_sole, least_sole);
    before = scene.poses();
  }
  EXPECT_GT(lowest, 0.0106 - 0.004);
  EXPECT_LT(highest_sole, 0.0106 + 0.004);  // one foot is always down
  EXPECT_GT(fastest_hand, 1.0);
  EXPECT_LT(fastest_hand, 4.0);
  EXPECT_GT(fastest_hip, 0.5);
  EXPECT_LT(fastest_hip, 1.2);
}

}  // namespace
}  // namespace mapscore::sim
