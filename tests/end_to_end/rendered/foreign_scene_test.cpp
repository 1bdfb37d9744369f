// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#include "tests/end_to_end/program.hpp"
#include "tests/support/tiny_recording.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <opencv2/imgcodecs.hpp>

#include <algorithm>

namespace mapscore::testing {
namespace {

namespace fs = std::filesystem;
using ::testing::HasSubstr;
using ::testing::Not;

/// A scene by itself: no class file and no robot beside it.
class ForeignScene : public ::testing::Test {
 protected:
  ForeignScene() {
    write_text(scene(),
               "<mujoco><worldbody><geom type='plane' size='0 0 1'/>\n"
               "<body name='cup_1' pos='1.5 0 0.5'><geom type='box' size='.2 .2 .3'/></body>\n"
               "<body name='cup_2' pos='1.5 1 0.5'><geom type='box' size='.2 .2 .3'/></body>\n"
               "<body name='wall' pos='3 0 1'><geom type='box' size='.1 2 1'/></body>\n"
               "<body name='pane' pos='0 3 1'><geom type='box' size='1 .1 1' rgba='1 1 1 .2'/>\n"
               "</body></worldbody></mujoco>\n");
  }
  [[nodiscard]] fs::path folder() const { return temporary_.path(); }
  [[nodiscard]] fs::path scene() const { return folder() / "room.xml"; }
  [[nodiscard]] fs::path classes() const { return folder() / "room.classes.yaml"; }

 private:
  TemporaryFolder temporary_;
};

TEST_F(ForeignScene, InfoTellsWhatIsThereAndDrawsIt) {
  const Outcome told = mapscore({"info", scene()});
  expect_done(told);
  EXPECT_THAT(told.out, HasSubstr("no class matches body 'world': 1 geoms, a plane without end"));
  EXPECT_THAT(told.out, HasSubstr("x 1.300 to 3.100, y -2.000 to 2.000, z 0.000 to 2.000 m"));
  EXPECT_THAT(told.out, HasSubstr("note: 1 geoms of alpha below 1 are left out (bodies: pane)"));
  EXPECT_THAT(told.out, HasSubstr("note: 1 planes without end"));
  EXPECT_FALSE(cv::imread(folder() / "room.classes.png").empty());
}

TEST_F(ForeignScene, ThePictureGoesWhereItIsWanted) {
  expect_done(mapscore({"info", scene(), "--no_picture"}));
  EXPECT_FALSE(fs::exists(folder() / "room.classes.png"));
  expect_done(mapscore({"info", scene(), "--picture", folder() / "my.png"}));
  EXPECT_FALSE(fs::exists(folder() / "room.classes.png"));
  EXPECT_FALSE(cv::imread(folder() / "my.png").empty());
  const std::string before = bytes_of(scene());
  expect_refused(mapscore({"info", scene(), "--picture", scene()}), {"--picture", ".png"});
  EXPECT_EQ(bytes_of(scene()), before);
  expect_refused(mapscore({"info", scene(), "--picture", folder() / "no/where.png"}),
                 {"no/where.png", "folder"});
}

TEST_F(ForeignScene, ASuggestedClassFileIsTakenAsItIs) {
  const Outcome printed = mapscore({"info", scene(), "--suggest_classes"});
  expect_done(printed);
  EXPECT_THAT(printed.out, HasSubstr("name: \"cup\""));
  expect_done(mapscore({"info", scene(), "--suggest_classes", "-o", classes()}));
  EXPECT_EQ(bytes_of(classes()), printed.out);
  const Outcome told = mapscore({"info", scene(), "--no_picture"});
  expect_done(told);
  EXPECT_THAT(told.out, HasSubstr("wall"));
  EXPECT_THAT(told.out, HasSubstr("no      1"));
  expect_refused(mapscore({"info", scene(), "--suggest_classes", "-o", classes()}),
                 {"room.classes.yaml", "exists already", "give another"});
}

TEST_F(ForeignScene, WithoutLightIsSaidInALineAndDrawnLit) {
  write_text(scene(),
             "<mujoco><visual><headlight active='0'/></visual><worldbody>\n"
             "<body name='cup_1'><geom type='box' size='.2 .2 .3'/></body></worldbody></mujoco>\n");
  const Outcome told = mapscore({"info", scene()});
  EXPECT_THAT(told.out, HasSubstr("note: no light shines"));
  const Outcome suggested = mapscore({"info", scene(), "--suggest_classes"});
  expect_done(suggested);
  EXPECT_THAT(suggested.err, HasSubstr("note: no light shines"));
  EXPECT_THAT(suggested.out, Not(HasSubstr("no light")));
  const cv::Mat3b picture = cv::imread(folder() / "room.classes.png");
  const cv::Vec3b middle = picture(picture.rows / 2, picture.cols / 2);
  EXPECT_GT(*std::max_element(middle.val, middle.val + 3), 100);
}

TEST_F(ForeignScene, ABakedCopyHasNoiseInItsImagesAndExactTruth) {
  write_text(folder() / "poses.txt", "0 0 0 0.5 -0.5 0.5 -0.5 0.5\n");
  const auto record = [&](const char* name, std::vector<std::string> flags) {
    std::vector<std::string> command{"record",
                                     scene(),
                                     "--trajectory",
                                     folder() / "poses.txt",
                                     "-o",
                                     folder() / name,
                                     "-q",
                                     "--set",
                                     "cameras.width_px=64",
                                     "--set",
                                     "cameras.height_px=48"};
    command.insert(command.end(), flags.begin(), flags.end());
    expect_done(mapscore(command));
  };
  record("exact", {});
  record("ideal", {"--bake"});
  record("noisy",
         {"--bake", "--set", "faults.depth.preset=astra", "--set", "faults.labels.boundary_px=2"});
  const auto bytes = [&](const char* name, const std::string& file) {
    return bytes_of(folder() / name / file);
  };
  ASSERT_EQ(contents_of(folder() / "noisy"), contents_of(folder() / "exact"));
  for (const std::string& file : contents_of(folder() / "exact")) {
    if (fs::is_directory(folder() / "exact" / file)) continue;
    EXPECT_EQ(bytes("ideal", file), bytes("exact", file)) << file;
    const bool baked = file.starts_with("depth/") || file.starts_with("label/") ||
                       file == "hashes.txt" || file == "recording.yaml";
    EXPECT_EQ(bytes("noisy", file) != bytes("exact", file), baked) << file;
  }
  EXPECT_THAT(bytes("noisy", "recording.yaml"), HasSubstr("\nbaked: {seed: "));
  EXPECT_THAT(mapscore({"info", folder() / "noisy"}).out, HasSubstr("boundary_px: 2"));
}

TEST_F(ForeignScene, FlagsOfScenesApplyToScenesAlone) {
  expect_refused(mapscore({"info", scene(), "-o", classes()}), {"--output", "--suggest_classes"});
  expect_refused(mapscore({"info", folder(), "--suggest_classes"}), {"not a scene"});
  expect_refused(mapscore({"info", scene(), "--suggest_classes", "--picture", "a.png"}),
                 {"--picture", "suggestion"});
}

TEST_F(ForeignScene, TruthNeedsNoRobot) {
  expect_done(mapscore({"truth", scene(), "-o", folder() / "truth.csv"}));
}

TEST_F(ForeignScene, IsRecordedWithTheProgramsOwnRobot) {
  write_text(folder() / "poses.txt", "0 0 0 0.5 -0.5 0.5 -0.5 0.5\n");
  expect_done(mapscore({"record", scene(), "--trajectory", folder() / "poses.txt", "-o",
                        folder() / "recording", "-q", "--set", "cameras.width_px=64", "--set",
                        "cameras.height_px=48"}));
  EXPECT_TRUE(fs::exists(folder() / "recording/color/000000.png"));
}

TEST_F(ForeignScene, ARecordingOfASceneHoldsAllClasses) {
  write_text(folder() / "poses.txt", "0 0 0 0.5 -0.5 0.5 -0.5 0.5\n");
  expect_refused(mapscore({"record", scene(), "--trajectory", folder() / "poses.txt", "-o",
                           folder() / "recording", "--set", "detect=[cup]"}),
                 {"detect", "class file"});
  EXPECT_FALSE(fs::exists(folder() / "recording"));
}

TEST_F(ForeignScene, BadClassFilesAreRefusedInOneLine) {
  const auto refused = [&](const std::string& text, const std::vector<std::string>& parts) {
    write_text(classes(), text);
    expect_refused(mapscore({"info", scene()}), parts);
  };
  refused("classes:\n  - {name: cup}\n  - {name: chair, bodies: [\"chiar_*\"]}\n",
          {"room.classes.yaml:3", "chiar_*", "matches no body"});
  refused("classes:\n  - {name: cup, bodies: [\"cup_*\", \"cup_*\"]}\n",
          {"room.classes.yaml:2", "cup_*", "twice"});
  refused("classes:\n  - {name: cup, bodies: [\"cup_1\"]}\n  - {name: mug, bodies: [\"*_1\"]}\n",
          {"room.classes.yaml", "cup_1", "narrow"});
  refused("classes:\n  - {name: cup, shape: round}\n", {"room.classes.yaml:2", "shape", "known"});
  refused("classes: []\ncolours: []\n", {"room.classes.yaml:2", "colours", "known"});
  refused("classes:\n  - {name: cup, name: mug}\n", {"room.classes.yaml:2", "name", "twice"});
}

}  // namespace
}  // namespace mapscore::testing
