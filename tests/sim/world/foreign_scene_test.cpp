// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

// Traits of scenes that were not written for mapscore, each in the smallest MJCF that has it.

#include "core/error.hpp"
#include "sim/world/shape_bounds.hpp"
#include "tests/sim/world/scene_files.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <numbers>

namespace mapscore::sim {
namespace {

using ::testing::HasSubstr;

/// A robot with joints, an actuator, degrees and names that scenes use too.
constexpr const char* kRobot = R"(
<mujoco model="scene">
  <compiler angle="degree" eulerseq="xyz"/>
  <default><geom rgba="1 0 0 0.5" group="4"/><default class="part"><geom size="0.3"/></default></default>
  <asset><material name="wood" rgba="0 1 0 1"/></asset>
  <worldbody>
    <body name="base_footprint">
      <joint name="slide" type="slide"/>
      <geom name="shell" class="part" material="wood"/>
      <body name="camera_link" pos="0 0 1" euler="0 90 0">
        <joint name="pan" axis="0 0 1"/>
        <geom size="0.01"/>
        <camera name="color" fovy="45"/><camera name="depth" fovy="45"/>
      </body>
    </body>
  </worldbody>
  <actuator><velocity name="drive" joint="slide"/></actuator>
  <keyframe><key name="home" qpos="1 2"/></keyframe>
</mujoco>)";

World load(const std::string& scene, const std::string& robot = kRobot) {
  const testing::SceneFolder folder;
  return World::load(
      {folder.write("scene.xml", scene), std::nullopt, folder.write("robot.xml", robot)}, {});
}

Eigen::AlignedBox3d bounds(const World& world, const std::string& instance) {
  Eigen::AlignedBox3d box;
  for (const Shape& shape : world.shapes())
    if (world.classes().instances.at(shape.instance).name == instance) box.extend(bounds_of(shape));
  return box;
}

/// What the robot brings along changes nothing in the scene.
void expect_same_without_robot(const std::string& scene) {
  const testing::SceneFolder folder;
  const World alone = World::load({folder.write("scene.xml", scene), std::nullopt, {}}, {});
  const World with = load(scene);
  ASSERT_EQ(alone.shapes().size(), with.shapes().size());
  for (std::size_t i = 0; i < alone.shapes().size(); ++i) {
    const Shape &a = alone.shapes()[i], &b = with.shapes()[i];
    EXPECT_EQ(a.kind, b.kind);
    EXPECT_EQ(a.instance, b.instance);
    EXPECT_EQ(a.size, b.size);
    EXPECT_EQ(a.triangles, b.triangles);
    EXPECT_TRUE(a.T_world_shape.isApprox(b.T_world_shape, 1e-12));
  }
}

TEST(ForeignScene, CompilerSettingsSurviveTheRobot) {
  const std::string scene =
      "<mujoco><compiler angle='radian' eulerseq='ZYX'/><worldbody>"
      "<body name='beam' euler='1.5707963267948966 0 0'><geom type='box' size='1 .1 .2'/></body>"
      "</worldbody></mujoco>";
  expect_same_without_robot(scene);
  EXPECT_TRUE(bounds(load(scene), "beam").max().isApprox(Eigen::Vector3d(.1, 1, .2), 1e-9));
}

TEST(ForeignScene, TheRobotKeepsItsOwnSettings) {
  const World world =
      load("<mujoco><compiler angle='radian'/><worldbody><geom size='.1'/></worldbody></mujoco>");
  const Eigen::Vector3d forward = world.calibration().T_base_depth.linear().col(2);
  EXPECT_TRUE(forward.isApprox(-Eigen::Vector3d::UnitX(), 1e-9)) << forward.transpose();
}

TEST(ForeignScene, DefaultsAndNamesOfTheRobotStayItsOwn) {
  const std::string scene =
      "<mujoco model='scene'><default><geom size='.2'/><default class='part'><geom size='.4'/>"
      "</default></default><asset><material name='wood' rgba='1 1 1 1'/></asset><worldbody>"
      "<body name='base_footprint'><geom name='shell'/><camera name='color'/>"
      "<joint name='slide' type='slide'/></body><body name='camera_link' childclass='part'>"
      "<geom material='wood'/></body></worldbody>"
      "<actuator><motor name='drive' joint='slide'/></actuator></mujoco>";
  expect_same_without_robot(scene);
  const World world = load(scene);
  EXPECT_NEAR(bounds(world, "base_footprint").max().x(), 0.2, 1e-12);
  EXPECT_NEAR(bounds(world, "camera_link").max().x(), 0.4, 1e-12);
}

// Bodies stand as the file places them (qpos0), whatever keyframes say.
TEST(ForeignScene, KeyframesAreNotUsedAndDoNotDisturb) {
  const std::string scene =
      "<mujoco><worldbody><body name='cup' pos='1 0 2'><freejoint/><geom size='.1'/></body>"
      "<body name='door'><joint axis='0 0 1' ref='1'/><geom size='.1' pos='3 0 0'/></body>"
      "</worldbody><keyframe><key name='home' qpos='5 5 5 1 0 0 0 2'/></keyframe></mujoco>";
  expect_same_without_robot(scene);
  const World world = load(scene);
  EXPECT_TRUE(bounds(world, "cup").center().isApprox(Eigen::Vector3d(1, 0, 2), 1e-12));
  EXPECT_TRUE(bounds(world, "door").center().isApprox(Eigen::Vector3d(3, 0, 0), 1e-12));
}

TEST(ForeignScene, EqualitiesActuatorsSensorsAndTendonsLoad) {
  expect_same_without_robot(
      "<mujoco><worldbody><body name='a'><joint name='ja'/><geom size='.1'/></body>"
      "<body name='b' pos='1 0 0'><joint name='jb'/><geom size='.1'/></body></worldbody>"
      "<equality><joint joint1='ja' joint2='jb'/></equality>"
      "<tendon><fixed name='t'><joint joint='ja' coef='1'/></fixed></tendon>"
      "<actuator><position joint='ja'/><motor tendon='t'/></actuator>"
      "<sensor><jointpos joint='jb'/></sensor>"
      "<contact><exclude body1='a' body2='b'/></contact></mujoco>");
}

TEST(ForeignScene, MeshesAreScaledAndMoved) {
  const std::string scene =
      "<mujoco><asset><mesh name='m' scale='2 3 4' refpos='1 0 0'"
      " vertex='1 0 0  2 0 0  1 1 0  1 0 1'/></asset><worldbody>"
      "<body name='tent' pos='10 0 0'><geom type='mesh' mesh='m'/></body></worldbody></mujoco>";
  expect_same_without_robot(scene);
  const Eigen::AlignedBox3d box = bounds(load(scene), "tent");
  EXPECT_TRUE(box.sizes().isApprox(Eigen::Vector3d(2, 3, 4), 1e-6)) << box.sizes().transpose();
}

TEST(ForeignScene, FilesAreFoundWhereTheSceneSaysTheyAre) {
  const testing::SceneFolder folder;
  const std::filesystem::path inside = folder.write("x", "").parent_path() / "parts";
  std::filesystem::create_directories(inside / "meshes");
  std::ofstream(inside / "meshes/tent.obj")
      << "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nf 1 3 2\nf 1 2 4\nf 2 3 4\nf 1 4 3\n";
  folder.write("parts/chair.xml",
               "<mujocoinclude><body name='chair_1'><geom type='mesh' mesh='tent'/></body>"
               "</mujocoinclude>");
  const auto scene =
      folder.write("scene.xml",
                   "<mujoco><compiler meshdir='parts/meshes' texturedir='nowhere'/>"
                   "<asset><mesh file='tent.obj'/></asset>"
                   "<worldbody><include file='parts/chair.xml'/></worldbody></mujoco>");
  const World world = World::load({scene, std::nullopt, folder.write("robot.xml", kRobot)}, {});
  EXPECT_TRUE(bounds(world, "chair_1").sizes().isApprox(Eigen::Vector3d(1, 1, 1), 1e-6));
}

TEST(ForeignScene, AMissingTextureIsRefusedByName) {
  try {
    (void)load(
        "<mujoco><asset><texture name='t' type='2d' file='bricks.png'/></asset><worldbody>"
        "<geom size='.1'/></worldbody></mujoco>");
    FAIL() << "accepted";
  } catch (const Error& error) {
    EXPECT_THAT(error.what(), HasSubstr("bricks.png"));
    EXPECT_EQ(std::string(error.what()).find('\n'), std::string::npos);
  }
}

TEST(ForeignScene, HeightFieldsAndReplicasHaveSurfaces) {
  const std::string scene =
      "<mujoco><asset><hfield name='h' nrow='2' ncol='2' size='1 1 .5 .1' elevation='0 0 0 1'/>"
      "</asset><worldbody><body name='hill'><geom type='hfield' hfield='h'/></body>"
      "<replicate count='3' offset='1 0 0'><body name='post'><geom type='capsule' size='.1 .5'/>"
      "</body></replicate></worldbody></mujoco>";
  expect_same_without_robot(scene);
  const World world = load(scene);
  EXPECT_NEAR(bounds(world, "hill").max().z(), 0.5, 1e-6);
  EXPECT_EQ(world.classes().instances.size(), 1u + 1u + 3u);
}

TEST(ForeignScene, WorldsOfAnySizeLoad) {
  for (const char* size : {"1e-4", "1e-2", "50", "4000"}) {
    SCOPED_TRACE(size);
    expect_same_without_robot(testing::mjcf("<body name='ball'><geom size='" + std::string(size) +
                                            "'/></body><geom type='plane' size='0 0 1'/>"));
  }
}

}  // namespace
}  // namespace mapscore::sim
