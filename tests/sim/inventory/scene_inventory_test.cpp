// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#include "sim/inventory/scene_inventory.hpp"

#include "tests/sim/world/scene_files.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace mapscore::sim {
namespace {

using ::testing::ElementsAre;

SceneInventory inventory_of(const std::string& mjcf, const std::string& classes = "") {
  const testing::SceneFolder folder;
  if (!classes.empty()) folder.write("s.classes.yaml", classes);
  return take_inventory(folder.write("s.xml", mjcf));
}

TEST(SceneInventory, CountsDrawnGeomsAndWhereTheyAre) {
  const auto inventory = inventory_of(testing::mjcf(
      "<geom type='plane' size='0 0 1'/>"
      "<body name='box' pos='1 2 3'><geom type='box' size='.1 .2 .3'/>"
      "<geom type='box' size='5 5 5' group='4'/><body><geom size='.5' rgba='1 0 0 0'/></body>"
      "</body>"));
  ASSERT_EQ(inventory.bodies.size(), 3u);
  EXPECT_EQ(inventory.bodies[0].drawn_geoms, 1);
  EXPECT_TRUE(inventory.bodies[0].bounds.isEmpty());
  EXPECT_EQ(inventory.bodies[1].name, "box");
  EXPECT_EQ(inventory.bodies[1].drawn_geoms, 1);
  EXPECT_TRUE(inventory.bodies[1].bounds.min().isApprox(Eigen::Vector3d(0.9, 1.8, 2.7)));
  EXPECT_TRUE(inventory.bounds.max().isApprox(Eigen::Vector3d(1.1, 2.2, 3.3)));
  EXPECT_EQ(inventory.bodies[2].parent, 1);
  EXPECT_EQ(inventory.unseen.hidden_groups, 1);
  EXPECT_EQ(inventory.unseen.invisible, 1);
  EXPECT_EQ(inventory.unseen.infinite_planes, 1);
  EXPECT_EQ(inventory.unseen.transparent, 0);
}

TEST(SceneInventory, GlassIsUnseenUnlessItsClassIsOpaque) {
  const std::string scene =
      testing::mjcf("<body name='pane_1'><geom type='box' size='1 .01 1' rgba='1 1 1 .3'/></body>");
  const auto clear = inventory_of(scene);
  EXPECT_EQ(clear.unseen.transparent, 1);
  EXPECT_THAT(clear.unseen.transparent_bodies, ElementsAre("pane_1"));
  EXPECT_EQ(clear.bodies[1].drawn_geoms, 0);
  const auto solid = inventory_of(scene, "classes:\n  - {name: pane, opaque: true}\n");
  EXPECT_EQ(solid.unseen.transparent, 0);
  EXPECT_EQ(solid.bodies[1].drawn_geoms, 1);
}

TEST(SceneInventory, MatchedIsWhatAClassClaimsWithItsParts) {
  const auto inventory = inventory_of(
      testing::mjcf("<body name='cup_1'><geom size='.1'/><body name='handle'><geom size='.1'/>"
                    "</body></body><body name='sofa'><geom size='.1'/></body>"),
      "classes:\n  - {name: cup}\n");
  EXPECT_TRUE(inventory.bodies[1].matched);
  EXPECT_TRUE(inventory.bodies[2].matched);
  EXPECT_FALSE(inventory.bodies[3].matched);
}

TEST(SceneInventory, DarknessIsNoticed) {
  const std::string off = "<visual><headlight active='0'/></visual>";
  EXPECT_FALSE(inventory_of(testing::mjcf("<geom size='.1'/>")).unseen.no_light);
  EXPECT_TRUE(inventory_of(testing::mjcf("<geom size='.1'/>", off)).unseen.no_light);
  EXPECT_TRUE(inventory_of(testing::mjcf("<light diffuse='0 0 0'/><geom size='.1'/>", off))
                  .unseen.no_light);
  EXPECT_FALSE(inventory_of(testing::mjcf("<light/><geom size='.1'/>", off)).unseen.no_light);
}

TEST(SceneInventory, KeyframesFlexesAndSitesAreCounted) {
  const auto inventory = inventory_of(
      "<mujoco><worldbody><site name='s'/><body name='b'><freejoint/><geom size='.1'/></body>"
      "<flexcomp name='cloth' type='grid' count='3 3 1' spacing='.1 .1 .1' dim='2' radius='.01'/>"
      "</worldbody><keyframe><key name='home'/></keyframe></mujoco>");
  EXPECT_EQ(inventory.unseen.keyframes, 1);
  EXPECT_EQ(inventory.unseen.flexes, 1);
  EXPECT_EQ(inventory.unseen.sites, 1);
}

}  // namespace
}  // namespace mapscore::sim
