// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#include "sim/world/class_file.hpp"

#include "core/error.hpp"
#include "tests/sim/world/scene_files.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace mapscore::sim {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;

std::vector<ClassRule> read(const std::string& text) {
  const testing::SceneFolder folder;
  return read_class_file(folder.write("room.classes.yaml", text));
}

std::string class_refusal(const std::string& text) {
  try {
    (void)read(text);
  } catch (const Error& error) {
    return error.what();
  }
  return "accepted";
}

TEST(ClassFile, ReadsClassesInOrder) {
  const auto rules = read(
      "classes:\n"
      "  - {name: cup, colour: \"FF8001\", bodies: [\"cup_*\", \"mug*\"]}\n"
      "  - {name: floor, detect: false, bodies: \"floor?\", opaque: true}\n"
      "  - {name: chair}\n");
  ASSERT_EQ(rules.size(), 3u);
  EXPECT_EQ(rules[0].semantic_class.id, 1);
  EXPECT_EQ(rules[0].semantic_class.name, "cup");
  EXPECT_EQ(rules[0].semantic_class.colour, (Colour{0xFF, 0x80, 0x01}));
  EXPECT_TRUE(rules[0].semantic_class.detect);
  EXPECT_FALSE(rules[0].opaque);
  EXPECT_THAT(rules[0].bodies, ElementsAre("cup_*", "mug*"));
  EXPECT_EQ(rules[1].semantic_class.id, 2);
  EXPECT_FALSE(rules[1].semantic_class.detect);
  EXPECT_TRUE(rules[1].opaque);
  EXPECT_THAT(rules[2].bodies, ElementsAre("chair", "chair_*"));
}

TEST(ClassFile, MatchesLikeAShell) {
  ClassRule rule;
  rule.bodies = {"chair*", "cup_?"};
  EXPECT_TRUE(rule.matches("chair_12"));
  EXPECT_TRUE(rule.matches("cup_1"));
  EXPECT_FALSE(rule.matches("cup_12"));
  EXPECT_FALSE(rule.matches("armchair_1"));
}

TEST(ClassFile, WorldIsMatchedByItsOwnNameOnly) {
  ClassRule rule;
  rule.bodies = {"*"};
  EXPECT_FALSE(rule.matches("world"));
  rule.bodies = {"world"};
  EXPECT_TRUE(rule.matches("world"));
}

TEST(ClassFile, RefusesWithFileLineAndKey) {
  EXPECT_THAT(
      class_refusal("classes:\n  - {name: cup}\n  - {name: tv, color: \"FF0000\"}\n"),
      HasSubstr(
          "room.classes.yaml:3: classes[1].color: unknown key 'color'; did you mean 'colour'?"));
  EXPECT_THAT(class_refusal("classes:\n  - {name: cup, colour: red}\n"),
              HasSubstr("room.classes.yaml:2: classes[0].colour: is red; write six hexadecimal"));
  EXPECT_THAT(class_refusal("classes:\n  - {name: cup, detect: 3}\n"),
              HasSubstr("[0].detect: is 3; write true or false"));
  EXPECT_THAT(class_refusal("classes:\n  - {name: cup}\n  - {name: cup}\n"), HasSubstr("twice"));
  EXPECT_THAT(
      class_refusal("classes:\n  - {name: cup, bodies: [a]}\n  - {name: tv, bodies: [a]}\n"),
      HasSubstr("room.classes.yaml:3: classes[1].bodies: pattern `a` stands twice"));
  EXPECT_THAT(class_refusal("classes:\n  - {name: background}\n"), HasSubstr("background"));
  EXPECT_THAT(class_refusal("classes:\n  - {bodies: [a]}\n"),
              HasSubstr("classes[0]: 'name' is missing"));
  EXPECT_THAT(class_refusal("classes:\n  - {name: cup, name: mug}\n"),
              HasSubstr("room.classes.yaml:2: classes[0].name: key 'name' stands twice"));
  EXPECT_THAT(class_refusal("classes: 3\n"), HasSubstr("classes: is 3; write a list"));
  EXPECT_THAT(class_refusal("classes: [\n"), HasSubstr("not YAML"));
  EXPECT_THROW((void)read_class_file("/nowhere/x.yaml"), Error);
}

TEST(ClassFile, APatternThatMatchesNoBodyIsRefused) {
  const std::string scene = testing::mjcf("<body name='cup_1'><geom size='.1'/></body>");
  const auto load = [&](const std::string& classes) { return testing::load_text(scene, classes); };
  EXPECT_NO_THROW((void)load("classes: [{name: cup, bodies: ['cup_?', world]}, {name: sofa}]\n"));
  try {
    (void)load("classes:\n  - {name: cup}\n  - {name: mug, bodies: ['cup_1*', 'mugg_*']}\n");
    FAIL() << "accepted";
  } catch (const Error& error) {
    EXPECT_THAT(error.what(), HasSubstr("belongs to `cup` and to `mug`"));
  }
  try {
    (void)load("classes:\n  - {name: sofa}\n  - {name: mug, bodies: ['cup_1*', 'mugg_*']}\n");
    FAIL() << "accepted";
  } catch (const Error& error) {
    EXPECT_THAT(error.what(), HasSubstr("classes.yaml:3: classes[1].bodies: pattern `mugg_*` "
                                        "matches no body of the scene; mend or drop it"));
  }
}

TEST(ClassFile, ErrorsAreOneLine) {
  EXPECT_EQ(class_refusal("classes: [\n").find('\n'), std::string::npos);
}

TEST(ClassNames, EndAtTheLastNumber) {
  EXPECT_EQ(class_name_of_body("chair_1"), "chair");
  EXPECT_EQ(class_name_of_body("coffee_table_12"), "coffee_table");
  EXPECT_EQ(class_name_of_body("cup_2_3"), "cup_2");
  EXPECT_EQ(class_name_of_body("tv"), "tv");
  EXPECT_EQ(class_name_of_body("table_top"), "table_top");
  EXPECT_EQ(class_name_of_body("table_"), "table_");
  EXPECT_EQ(class_name_of_body("_7"), "_7");
}

TEST(Palette, NeighboursDiffer) {
  for (ClassId a = 1; a <= 24; ++a) {
    for (ClassId b = 1; b < a; ++b)
      EXPECT_NE(palette_colour(a), palette_colour(b)) << a << " " << b;
  }
}

}  // namespace
}  // namespace mapscore::sim
