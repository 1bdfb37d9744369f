// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#include "sim/world/world.hpp"

#include "core/error.hpp"
#include "sim/world/drawn_scene.hpp"
#include "tests/sim/world/scene_files.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <map>

namespace mapscore::sim {
namespace {

using testing::data_file;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using testing::kBox;
using testing::load_text;
using testing::message_of;
using testing::mjcf;
using testing::SceneFolder;

std::vector<std::string> instance_names(const World& world) {
  std::vector<std::string> names;
  for (const Instance& instance : world.classes().instances) names.push_back(instance.name);
  return names;
}

std::vector<std::string> class_names(const World& world) {
  std::vector<std::string> names;
  for (const SemanticClass& c : world.classes().classes) names.push_back(c.name);
  return names;
}

const Shape& only_shape(const World& world) {
  EXPECT_EQ(world.shapes().size(), 1u);
  return world.shapes().at(0);
}

TEST(WorldFilesTest, RefusesWhatIsMissingOrBrokenOnOneLine) {
  const SceneFolder folder;
  const auto good = folder.write("good.xml", mjcf(kBox));
  const auto robot = data_file("robot.xml");
  EXPECT_THAT(message_of([&] {
                return World::load({"/nowhere/room.xml", {}, robot}, {});
              }),
              HasSubstr("/nowhere/room.xml: no such scene file"));
  EXPECT_THAT(message_of([&] {
                return World::load({good, {}, "/nowhere/robot.xml"}, {});
              }),
              HasSubstr("/nowhere/robot.xml: no such robot file"));
  EXPECT_THAT(message_of([&] {
                return World::load({good, "/nowhere/c.yaml", robot}, {});
              }),
              HasSubstr("/nowhere/c.yaml: no such class file"));
  EXPECT_THAT(message_of([&] {
                return World::load({good, {}, good}, {});
              }),
              HasSubstr("base_footprint"));
  for (const char* body : {"<geom type='bax' size='1'/>", "<geom type='box' size='0 1 1'/>"}) {
    const auto broken = folder.write("broken.xml", mjcf(body));
    const std::string message = message_of([&] { return World::load({broken, {}, robot}, {}); });
    EXPECT_THAT(message, HasSubstr("broken.xml: "));
    EXPECT_THAT(message, HasSubstr("geom"));
    EXPECT_EQ(message.find('\n'), std::string::npos);
  }
}

TEST(WorldFilesTest, ClassFileBesideTheSceneIsFound) {
  const SceneFolder folder;
  folder.write("room.classes.yaml", "classes: [{name: crate, bodies: ['box_*']}]\n");
  const World world =
      World::load({folder.write("room.xml", mjcf(kBox)), {}, data_file("robot.xml")}, {});
  EXPECT_THAT(class_names(world), ElementsAre("background", "crate"));
}

const char* const kNested = R"(
  <geom name='ground' type='plane' size='3 3 1'/>
  <body name='chair_2'>
    <geom name='seat' type='box' size='.2 .2 .02'/>
    <body><geom name='leg' type='box' size='.02 .02 .2'/></body>
    <body name='cup_1'><geom name='cup' type='cylinder' size='.03 .05'/></body>
  </body>
  <body name='empty_1'><site/></body>
  <body name='chair_1'><geom name='other seat' type='box' size='.2 .2 .02'/></body>)";

TEST(WorldClasses, ComeFromBodyNamesWithoutAClassFile) {
  const World world = load_text(mjcf(kNested));
  EXPECT_THAT(class_names(world), ElementsAre("background", "chair", "cup"));
  EXPECT_THAT(instance_names(world), ElementsAre("background", "chair_2", "cup_1", "chair_1"));
  EXPECT_THAT(world.unmatched_bodies(), ElementsAre("world"));
  EXPECT_TRUE(world.classes().detected(1));
  EXPECT_EQ(world.classes().class_of(3), 1);
}

TEST(WorldClasses, AGeomBelongsToTheNearestMatchedBody) {
  const World world = load_text(mjcf(kNested), "classes: [{name: chair, bodies: 'chair_*'}]\n");
  EXPECT_THAT(instance_names(world), ElementsAre("background", "chair_2", "chair_1"));
  for (const Shape& shape : world.shapes()) {
    const std::map<std::string, InstanceId> expected = {
        {"ground", 0}, {"seat", 1}, {"leg", 1}, {"cup", 1}, {"other seat", 2}};
    EXPECT_EQ(shape.instance, expected.at(shape.name)) << shape.name;
  }
}

TEST(WorldClasses, WorldGeomsCanHaveAClass) {
  const World world = load_text(mjcf(kNested), "classes: [{name: floor, bodies: world}]\n");
  EXPECT_THAT(instance_names(world), ElementsAre("background", "world"));
  EXPECT_THAT(world.unmatched_bodies(), ::testing::Contains("cup_1"));
}

TEST(WorldClasses, ABodyOfTwoClassesIsRefused) {
  const std::string classes = "classes: [{name: a, bodies: 'box*'}, {name: b, bodies: '*_1'}]\n";
  const std::string message = message_of([&] { return load_text(mjcf(kBox), classes); });
  EXPECT_THAT(message, HasSubstr("classes.yaml"));
  EXPECT_THAT(message, HasSubstr("body `box_1` belongs to `a` and to `b`"));
}

TEST(WorldShapes, LeaveOutWhatIsNotDrawn) {
  const std::string scene = mjcf(R"(
    <body name='glass_1'>
      <geom name='pane' type='box' size='1 1 .01' rgba='1 1 1 .3'/>
      <geom name='frame' type='box' size='1 .1 .1'/>
      <geom name='hull' type='box' size='2 2 2' group='3'/>
      <geom name='hidden' type='box' size='2 2 2' rgba='1 1 1 0'/>
    </body>)");
  EXPECT_EQ(only_shape(load_text(scene)).name, "frame");
  const World opaque = load_text(scene, "classes: [{name: glass, opaque: true}]\n");
  ASSERT_EQ(opaque.shapes().size(), 2u);
  EXPECT_EQ(opaque.shapes()[0].name, "pane");
  EXPECT_EQ(opaque.drawn().geoms[0].rgba[3], 1.0f);
}

TEST(WorldShapes, LeaveOutTheRobot) {
  const World world = load_text(mjcf(kBox));
  EXPECT_EQ(only_shape(world).instance, 1);
  int robot_geoms = 0;
  for (int geom = 0; geom < static_cast<int>(world.geom_instances().size()); ++geom) {
    robot_geoms += world.robot_geom(geom);
    EXPECT_EQ(world.geom_instances()[geom] == 0, world.robot_geom(geom));
  }
  EXPECT_EQ(robot_geoms, 2);
}

TEST(WorldShapes, StandWhereTheSceneSays) {
  const World world =
      load_text(mjcf("<body name='a_1' pos='1 2 3' euler='0 0 90'><geom type='capsule' pos='.5 0 "
                     "0' size='.1 .4'/></body>"));
  const Shape& shape = only_shape(world);
  EXPECT_EQ(shape.kind, ShapeKind::capsule);
  EXPECT_EQ(shape.size.head<2>(), Eigen::Vector2d(0.1, 0.4));
  EXPECT_LT((shape.T_world_shape * Eigen::Vector3d::Zero() - Eigen::Vector3d(1, 2.5, 3)).norm(),
            1e-12);
}

TEST(WorldShapes, InfinitePlanesEndAtTheOtherGeoms) {
  const World world =
      load_text(mjcf("<geom name='ground' type='plane' size='0 0 1'/>"
                     "<body name='a_1' pos='3 1 .5'><geom type='box' size='1 .5 .5'/></body>"
                     "<body name='b_1' pos='-2 0 .5'><geom type='box' size='.5 .5 .5'/></body>"));
  const Shape& ground = world.shapes().at(0);
  ASSERT_EQ(ground.kind, ShapeKind::plane);
  EXPECT_LT((ground.size - Eigen::Vector3d(3.25, 1.0, 0)).norm(), 1e-9);
  EXPECT_LT((ground.T_world_shape.translation() - Eigen::Vector3d(0.75, 0.5, 0)).norm(), 1e-9);
}

TEST(WorldShapes, MeshesKeepTheirTriangles) {
  const World world =
      load_text(mjcf("<body name='a_1' pos='0 0 1'><geom type='mesh' mesh='tetra'/></body>",
                     "<asset><mesh name='tetra' vertex='0 0 0  1 0 0  0 1 0  0 0 1'/></asset>"));
  const Shape& shape = only_shape(world);
  EXPECT_EQ(shape.kind, ShapeKind::mesh);
  ASSERT_EQ(shape.triangles.size(), 4u);
  Eigen::AlignedBox3d bounds;
  for (const Triangle& t : shape.triangles) {
    for (const Eigen::Vector3d& p : t) bounds.extend(shape.T_world_shape * p);
  }
  EXPECT_LT((bounds.min() - Eigen::Vector3d(0, 0, 1)).norm(), 1e-6);
  EXPECT_LT((bounds.max() - Eigen::Vector3d(1, 1, 2)).norm(), 1e-6);
}

TEST(WorldShapes, HeightFieldsAreClosedSurfaces) {
  const World world = load_text(mjcf("<geom type='hfield' hfield='hill'/>",
                                     "<asset><hfield name='hill' nrow='3' ncol='4' size='2 1 .5 .1'"
                                     " elevation='0 0 0 0  0 1 .5 0  0 0 .2 0'/></asset>"));
  const Shape& shape = only_shape(world);
  // A closed surface facing outwards: its area vectors cancel and its volume is positive.
  Eigen::Vector3d area = Eigen::Vector3d::Zero();
  double volume = 0;
  for (const auto& [a, b, c] : shape.triangles) {
    area += (b - a).cross(c - a) / 2;
    volume += a.dot(b.cross(c)) / 6;
  }
  EXPECT_LT(area.norm(), 1e-9);
  EXPECT_GT(volume, 4 * 2 * 0.1);  // more than its base
}

TEST(WorldHash, FollowsContentAndNotPlace) {
  const auto hash = [](const std::string& scene, const std::string& classes) {
    return load_text(scene, classes).hash();
  };
  const std::string scene = mjcf(kBox), classes = "classes: [{name: box}]\n";
  const std::string original = hash(scene, classes);
  EXPECT_EQ(original.size(), 32u);
  EXPECT_EQ(hash(scene, classes), original);  // another folder
  EXPECT_NE(hash(scene + " ", classes), original);
  EXPECT_NE(hash(scene, "classes: [{name: box, detect: false}]\n"), original);
}

TEST(WorldHash, FollowsIncludedFiles) {
  const SceneFolder folder;
  const auto scene = folder.write("scene.xml", "<mujoco><include file='part.xml'/></mujoco>");
  const auto hash_with = [&](const std::string& size) {
    folder.write("part.xml", "<mujoco><worldbody><body name='b_1'><geom type='box' size='" + size +
                                 "'/></body></worldbody></mujoco>");
    return World::load({scene, {}, data_file("robot.xml")}, {}).hash();
  };
  EXPECT_NE(hash_with("1 1 1"), hash_with("1 1 2"));
}

TEST(WorldLoading, TakesTinyAndFlatRoundGeoms) {
  const World world =
      load_text(mjcf("<body name='a_1'><geom type='sphere' size='.0005'/><geom type='ellipsoid' "
                     "size='.3 .2 .0005'/>"
                     "<geom type='cylinder' size='.3 .0002'/></body>"));
  EXPECT_EQ(world.shapes().size(), 3u);
  EXPECT_EQ(world.shapes()[0].kind, ShapeKind::sphere);
}

TEST(WorldLoading, KeepsBodiesThatMujocoWouldFuse) {
  const World world = load_text(mjcf(kNested, "<compiler fusestatic='true'/>"));
  EXPECT_THAT(instance_names(world), ElementsAre("background", "chair_2", "cup_1", "chair_1"));
}

TEST(MujocoVersion, IsANumber) {
  EXPECT_THAT(mujoco_version(), HasSubstr("."));
}

}  // namespace
}  // namespace mapscore::sim
