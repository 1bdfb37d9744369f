// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#include "sim/world/costly_scene.hpp"

#include "core/error.hpp"
#include "scene_files.hpp"
#include "sim/inventory/scene_inventory.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/stat.h>

#include <cstdint>
#include <cstdlib>
#include <string>
#include <vector>

namespace mapscore::sim {
namespace {

using ::testing::HasSubstr;
using testing::mjcf;
using ::testing::Not;
using testing::SceneFolder;

const std::string kLargeBox = R"(<body name="box_1"><geom type="box" size="1 1 1"/></body>)";

/// What refuses the scene, in the words of the one who waits for it; empty when nothing does.
std::string scene_refusal(const std::string& scene) {
  const SceneFolder folder;
  try {
    (void)take_inventory(folder.write("scene.xml", scene));
  } catch (const Error& error) {
    return error.what();
  }
  return "";
}

std::string height_field(const std::string& rows, const std::string& columns) {
  return mjcf(R"(<geom type="hfield" hfield="h"/>)", R"(<asset><hfield name="h" nrow=")" + rows +
                                                         R"(" ncol=")" + columns +
                                                         R"(" size="1 1 1 1"/></asset>)");
}

std::string with_assets(const std::string& assets) {
  return mjcf(kLargeBox, "<asset>" + assets + "</asset>");
}

std::string made_mesh(const std::string& attributes) {
  return mjcf(R"(<geom type="mesh" mesh="m"/>)",
              R"(<asset><mesh name="m" )" + attributes + "/></asset>");
}

bool costly(const std::string& scene) {
  const SceneFolder folder;
  return may_cost_much(folder.write("scene.xml", scene));
}

/// PNG header of an image without pixels.
std::string png_header(std::uint32_t width_px, std::uint32_t height_px) {
  std::string head("\x89PNG\r\n\x1a\n\0\0\0\rIHDR", 16);
  for (const std::uint32_t side : {width_px, height_px})
    for (int shift = 24; shift >= 0; shift -= 8) head += static_cast<char>(side >> shift & 255U);
  return head;
}

class CostlyScene : public ::testing::TestWithParam<std::string> {};

TEST_P(CostlyScene, IsRefusedInOneLineThatNamesIt) {
  const std::string reason = scene_refusal(GetParam());
  EXPECT_THAT(reason, HasSubstr("scene.xml: "));
  EXPECT_THAT(reason, Not(HasSubstr("\n")));
}

INSTANTIATE_TEST_SUITE_P(
    Memory, CostlyScene,
    ::testing::Values(
        height_field("100000", "100000"), height_field("65536", "65537"),
        height_field("2147483647", "2"), height_field("3200", "3200"),
        with_assets(
            R"(<texture name="t" type="2d" builtin="flat" width="100000" height="60000"/>)"),
        made_mesh(R"(builtin="supersphere" params="100000 1 1")"),
        made_mesh(R"(builtin="supertorus" params="100000 .5 1 1")"),
        made_mesh(R"(builtin="plate" params="100000 100000")"),
        made_mesh(R"(builtin="wedge" params="100000 100000 1 1 0")"),
        made_mesh(R"(builtin="cone" params="2000000000 1")"),
        mjcf(R"(<flexcomp name="f" type="grid" count="9000 9000 9000" spacing="1 1 1" dim="3"/>)"),
        mjcf(kLargeBox, R"(<size memory="10T"/>)"),
        mjcf(kLargeBox, R"(<size nuserdata="2000000000"/>)"),
        mjcf(kLargeBox + R"(<attach model="m" body="box_1" prefix="p"/>)",
             R"(<asset><model name="m" file="scene.xml"/></asset>)")));

TEST(CostlySceneTest, PipesAndDevicesAreRefusedBeforeTheyAreOpened) {
  const SceneFolder folder;
  const std::filesystem::path scene = folder.write("scene.xml", R"(<mujoco>
      <asset><texture name="t" type="2d" file="pipe.png"/></asset></mujoco>)");
  ASSERT_EQ(mkfifo((scene.parent_path() / "pipe.png").c_str(), 0600), 0);
  EXPECT_THROW((void)may_cost_much(scene), Error);
  for (const char* element : {"texture", "mesh", "hfield", "model", "include"})
    EXPECT_THROW(
        (void)costly(std::string("<mujoco><") + element + R"( file="/dev/zero"/></mujoco>)"), Error)
        << element;
}

TEST(CostlySceneTest, SlicesAreBounded) {
  const std::string scene = mjcf(kLargeBox, R"(<visual><quality numslices="100000"/></visual>)");
  EXPECT_THROW((void)testing::load_text(scene), Error);
}

TEST(CostlySceneTest, SmallOnesAreTriedAndTaken) {
  for (const std::string& scene :
       {height_field("8", "8"), made_mesh(R"(builtin="sphere" params="2")"),
        mjcf(R"(<replicate count="3" offset="3 0 0">)" + kLargeBox + "</replicate>")}) {
    EXPECT_TRUE(costly(scene)) << scene;
    EXPECT_EQ(scene_refusal(scene), "") << scene;
  }
}

TEST(CostlySceneTest, MujocosOwnReasonComesThrough) {
  EXPECT_THAT(scene_refusal(mjcf(R"(<replicate count="2"><geom size="-1"/></replicate>)")),
              HasSubstr("MuJoCo refuses it: "));
}

TEST(MjcfCost, TheHomesOfThisProjectNeedNoTrial) {
  const std::filesystem::path scenes = std::filesystem::path(MAPSCORE_SOURCE_DIR) / "scenes";
  int count = 0;
  for (const auto& entry : std::filesystem::directory_iterator(scenes)) {
    if (entry.path().extension() != ".xml") continue;
    EXPECT_FALSE(may_cost_much(entry.path())) << entry.path();
    ++count;
  }
  EXPECT_GE(count, 6);
}

TEST(MjcfCost, KnowsPlainTextAndSmallAssets) {
  EXPECT_FALSE(costly(mjcf(kLargeBox)));
  EXPECT_FALSE(costly("<?xml version='1.0'?><!-- <replicate> --><mujoco model = 'a > b'/>"));
  EXPECT_FALSE(costly(
      with_assets(R"(<texture name="t" type="2d" builtin="flat" width="512" height="512"/>)")));
  EXPECT_FALSE(may_cost_much("there/is/none.xml"));
}

TEST(MjcfCost, NoTagHides) {
  const std::string many = R"(<replicate count="9"/>)";
  const std::string texture = R"(<texture builtin="flat" width="90000" height="90000"/>)";
  for (const std::string& text : {
           many,
           "<a>" + many,
           "<geom name='>'/>" + many,
           "<!--> <geom name='-->" + many + "<!--'/> -->",
           R"(<body></body a="> <geom name='">)" + many + "<!-- '/> -->",
           "<![CDATA[ <!-- ]]>" + many + "<!-- -->",
           "<!DOCTYPE a [<!ENTITY b '<!--'>]>" + many + "<!-- -->",
           std::string("<geom name='&lt;'/>"),
           std::string("<geom name='unclosed/>"),
           std::string("<texture builtin='flat' width='1e5' height='1e5'/>"),
           std::string("<texture builtin='flat'\fwidth='90000'\vheight='90000'/>"),
           std::string("<texture width='90000' height='90000' name='<geom' builtin='flat'/>"),
           std::string("<geom user='0'/>"),
           std::string("<mesh builtin='sphere' params='4'/>"),
       })
    EXPECT_TRUE(costly(text)) << text;
  std::string textures;
  for (int n = 0; n < 40; ++n)
    textures += R"(<texture builtin="flat" width="1024" height="1024"/>)";
  EXPECT_TRUE(costly(with_assets(textures)));
}

TEST(MjcfCost, CountsThePixelsOfPictures) {
  const SceneFolder folder;
  const std::filesystem::path scene = folder.write("scene.xml", R"(<mujoco>
      <asset><texture name="t" type="2d" file="picture.png"/></asset>
      <compiler texturedir="pictures"/></mujoco>)");
  std::filesystem::create_directory(scene.parent_path() / "pictures");
  folder.write("pictures/picture.png", png_header(1024, 1024));
  EXPECT_FALSE(may_cost_much(scene));
  folder.write("pictures/picture.png", png_header(30000, 30000));
  EXPECT_TRUE(may_cost_much(scene));
  folder.write("pictures/picture.png", "of another kind");
  EXPECT_TRUE(may_cost_much(scene));
}

TEST(TrialProcess, PassesOnWhatWasThrown) {
  try_apart("scene.xml", [] {});
  try {
    try_apart("scene.xml", [] { throw Error("here: this"); });
    FAIL();
  } catch (const Error& error) {
    EXPECT_STREQ(error.what(), "here: this");
  }
}

TEST(TrialProcess, OutlivesAnAbort) {
  EXPECT_THROW(try_apart("scene.xml", [] { std::abort(); }), Error);
}

TEST(TrialProcess, EndsWhatTakesTooLong) {
  const auto forever = [] {
    volatile bool busy = true;
    while (busy) {
    }
  };
  try {
    try_apart("scene.xml", forever, {2, 1});
    FAIL();
  } catch (const Error& error) {
    EXPECT_THAT(error.what(), HasSubstr("scene.xml: MuJoCo is not done with it in 1 s"));
  }
}

TEST(TrialProcess, EndsWhatTakesTooMuch) {
  EXPECT_THROW(try_apart("scene.xml", [] { std::vector<char> many(3UL << 30U); }), Error);
}

}  // namespace
}  // namespace mapscore::sim
