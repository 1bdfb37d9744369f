// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#include "sim/inventory/class_suggestion.hpp"

#include "sim/world/class_file.hpp"
#include "tests/sim/world/scene_files.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

namespace mapscore::sim {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

constexpr const char* kGeom = "<geom size='.1'/>";

std::string body(const std::string& name, const std::string& inside = kGeom) {
  return "<body name='" + name + "'>" + inside + "</body>";
}

std::vector<SuggestedClass> suggested(const std::string& world) {
  const testing::SceneFolder folder;
  return suggest_classes(take_inventory(folder.write("s.xml", testing::mjcf(world))).bodies);
}

TEST(StemOfBody, DropsNamespacesNumbersAndRoles) {
  EXPECT_EQ(stem_of_body("chair_1"), "chair");
  EXPECT_EQ(stem_of_body("chair12"), "chair");
  EXPECT_EQ(stem_of_body("Chair.003"), "chair");
  EXPECT_EQ(stem_of_body("coffee_table_2_main"), "coffee_table");
  EXPECT_EQ(stem_of_body("cup_g0"), "cup");
  EXPECT_EQ(stem_of_body("kitchen/oven_body"), "oven");
  EXPECT_EQ(stem_of_body("robot0:base_link"), "base");
  EXPECT_EQ(stem_of_body("panda0_link0"), "panda");
  EXPECT_EQ(stem_of_body("ovenroot"), "oven");
  EXPECT_EQ(stem_of_body("root"), "root");
  EXPECT_EQ(stem_of_body("object"), "object");
  EXPECT_EQ(stem_of_body("_7"), "7");
  EXPECT_EQ(stem_of_body("___"), "object");
  EXPECT_EQ(stem_of_body("a/"), "a");
}

TEST(SuggestClasses, GroupsByStemInOrderOfFirstUse) {
  const auto classes =
      suggested(body("oven_main") + body("cup_1") + body("cup_12") + body("wall_n"));
  ASSERT_EQ(classes.size(), 3u);
  EXPECT_EQ(classes[0].name, "oven");
  EXPECT_THAT(classes[0].patterns, ElementsAre("oven_main"));
  EXPECT_EQ(classes[1].name, "cup");
  EXPECT_THAT(classes[1].bodies, ElementsAre("cup_1", "cup_12"));
  EXPECT_THAT(classes[1].patterns, ElementsAre("cup_*"));
  EXPECT_TRUE(classes[1].detect);
  EXPECT_EQ(classes[2].name, "wall_n");
  EXPECT_FALSE(classes[2].detect);
}

TEST(SuggestClasses, AGlobThatWouldTakeOthersGivesWayToNames) {
  const auto classes =
      suggested(body("cup_1", kGeom + body("cup_1_handle")) + body("cup_2") + body("cupboard"));
  ASSERT_EQ(classes.size(), 2u);
  EXPECT_THAT(classes[0].patterns, ElementsAre("cup_1", "cup_2"));
  EXPECT_THAT(classes[0].parts, ElementsAre("cup_1_handle"));
}

TEST(SuggestClasses, LooksIntoWhatOnlyHoldsOthers) {
  const auto classes =
      suggested(body("kitchen", body("oven") + body("fridge") + body("camera", "")) +
                body("arm", body("link", kGeom)) + body("empty", ""));
  ASSERT_EQ(classes.size(), 3u);
  EXPECT_THAT(classes[0].bodies, ElementsAre("oven"));
  EXPECT_THAT(classes[1].bodies, ElementsAre("fridge"));
  EXPECT_THAT(classes[2].bodies, ElementsAre("arm"));
}

TEST(SuggestClasses, WhatHangsOnNoBodyIsAClassOfItsOwn) {
  const auto room = suggested(kGeom + body("cup"));
  ASSERT_EQ(room.size(), 2u);
  EXPECT_EQ(room[1].name, "world");
  EXPECT_THAT(room[1].patterns, ElementsAre("world"));
  EXPECT_FALSE(room[1].detect);
  const auto arena = suggested(kGeom + body("wall_1"));
  ASSERT_EQ(arena.size(), 2u);
  EXPECT_TRUE(arena[1].detect);
}

TEST(SuggestClasses, CollisionHullsAloneAreNoObject) {
  EXPECT_THAT(suggested(body("ghost", "<geom size='.1' group='3'/>")), IsEmpty());
}

TEST(SuggestClasses, TheFileLoadsAsItIsAndClaimsEveryNamedBody) {
  const std::string world = body("cup_1") + body("cup_2", kGeom + body("cup_lid_1")) +
                            body("a[1]*?") + body("quote&quot;d\\") + body("background") +
                            body("floor_2");
  const testing::SceneFolder folder;
  const auto scene = folder.write("s.xml", testing::mjcf(world));
  const std::string text = class_file_text(suggest_classes(take_inventory(scene).bodies), "s.xml");
  folder.write("s.classes.yaml", text);
  const SceneInventory after = take_inventory(scene);
  for (std::size_t i = 1; i < after.bodies.size(); ++i)
    EXPECT_TRUE(after.bodies[i].matched) << after.bodies[i].name << "\n" << text;
  const World loaded = World::load({scene, std::nullopt, {}}, {});
  EXPECT_EQ(loaded.classes().instances.size(), 1u + 6u) << text;  // the lid is part of its cup
  EXPECT_THAT(loaded.unmatched_bodies(), IsEmpty());
}

TEST(SuggestClasses, ASceneWithoutNamesGivesAFileThatLoads) {
  const testing::SceneFolder folder;
  EXPECT_THAT(read_class_file(folder.write("c.yaml", class_file_text({}, "s.xml"))), IsEmpty());
}

TEST(SeparatedColours, AreFarApart) {
  const std::vector<Colour> colours = separated_colours(40);
  ASSERT_EQ(colours.size(), 40u);
  for (std::size_t a = 0; a < colours.size(); ++a) {
    for (std::size_t b = 0; b < a; ++b) {
      const double apart = std::hypot(colours[a].r - colours[b].r, colours[a].g - colours[b].g,
                                      colours[a].b - colours[b].b);
      EXPECT_GT(apart, a < 12 ? 80 : 20) << a << " " << b;
    }
  }
}

}  // namespace
}  // namespace mapscore::sim
