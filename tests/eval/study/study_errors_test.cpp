// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#include "core/error.hpp"
#include "eval/study/study.hpp"

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <ostream>
#include <string>
#include <vector>

namespace mapscore::eval {
namespace {

constexpr const char* kSound =
    "scene: room.xml\n"
    "trajectory: {waypoints_m_deg: [[0.5, 0.5, 0]]}\n"
    "methods:\n"
    "  direct: {segmentation: {direct: {}}}\n"
    "  erosion: {segmentation: {erosion: {radius_px: 5}}}\n";

/// The message that a text is refused with; empty when it is not.
std::string refusal(const std::string& text, const std::vector<std::string>& overrides = {}) {
  try {
    (void)parse_study(text, "demo.yaml", overrides);
  } catch (const Error& error) {
    return error.what();
  }
  return "";
}

struct BadLine {
  const char* name;
  std::string lines;  ///< added to kSound as line 6 and on
  std::string message;
};
std::ostream& operator<<(std::ostream& stream, const BadLine& bad) {
  return stream << bad.name;
}

class BadStudy : public ::testing::TestWithParam<BadLine> {};

TEST_P(BadStudy, IsRefusedWithFileLineAndKey) {
  ASSERT_EQ(refusal(kSound), "");
  const std::string message = refusal(kSound + GetParam().lines);
  EXPECT_EQ(message, "demo.yaml:" + GetParam().message);
  EXPECT_EQ(std::ranges::count(message, '\n'), 0);
}

/// "[0.001, 0.002, ...]"
std::string numbers(int count) {
  std::string list = "[";
  for (int n = 1; n <= count; ++n) list += fmt::format("{}{}", n > 1 ? ", " : "", 0.001 * n);
  return list + ']';
}

const std::string kPose = "faults:\n  pose:\n    ";
const std::string kZeros = "[0, 0, 0, 0, 0, 0]";

INSTANTIATE_TEST_SUITE_P(
    Lines, BadStudy,
    ::testing::Values(
        BadLine{"missing_unit", "voxel: 5\n",
                "6: voxel: unknown key 'voxel'; did you mean 'voxel_m'?"},
        BadLine{"misspelt", "faults:\n  misregistration: {magnitud_m: 0}\n",
                "7: faults.misregistration.magnitud_m: unknown key 'magnitud_m'; did you mean "
                "'magnitude_m'?"},
        BadLine{"key_frames_of_single_frames",
                "  keys: {segmentation: {direct: {}}, frames: key_frames}\nscore: {unit: frame}\n",
                "6: methods.keys.frames: chooses frames of a map, and score.unit frame scores each "
                "frame by itself; leave it out, or write unit: map"},
        BadLine{"far_off", "fusion: {blend: {weight: 1}}\n",
                "6: fusion.blend.weight: unknown key 'weight'; write one of K, N, noise_at, "
                "covariance, decay"},
        BadLine{"perception_kind", "perception: {guessed: {}}\n",
                "6: perception.guessed: unknown kind 'guessed'; write one of labels, simulated, "
                "images, network"},
        BadLine{"perception_at_an_offset",
                "faults: {time_offset_ms: 20}\nperception: {simulated: {}}\n",
                "6: faults.time_offset_ms: stands beside simulated perception, which sees the "
                "depth image itself, at no offset; keep one of the two"},
        BadLine{"merge_key", "cameras: {<<: {width_px: 5}}\n",
                "6: cameras.<<: unknown key '<<'; write one of width_px, height_px, range_min_m, "
                "range_max_m, height_m, pan_deg, tilt_deg, shadows"},
        BadLine{"text_for_number", "voxel_m: wide\n", "6: voxel_m: is wide; write a number"},
        BadLine{"quoted_number", "voxel_m: \"0.05\"\n",
                "6: voxel_m: is the text 0.05; write a number, without quotes"},
        BadLine{"trailing_unit", "voxel_m: 5cm\n", "6: voxel_m: is 5cm; write a number"},
        BadLine{"no_value", "voxel_m:\n", "6: voxel_m: has no value; write a number"},
        BadLine{"list_for_number", "voxel_m: [1]\n", "6: voxel_m: is a list; write a number"},
        BadLine{"number_for_section", "cameras: 5\n",
                "6: cameras: is 5; write a section, key: value"},
        BadLine{"fraction_for_whole", "seeds: 1.5\n", "6: seeds: is 1.5; write a whole number"},
        BadLine{"huge_whole", "seeds: 99999999999\n",
                "6: seeds: 99999999999 is too great; write a whole number up to 2147483647"},
        BadLine{"yes_for_true", "cameras: {shadows: yes}\n",
                "6: cameras.shadows: is yes; write true or false"},
        BadLine{"enum", "place: cubes\n", "6: place: is cubes; write one of points, voxels"},
        BadLine{"nan", "voxel_m: .nan\n", "6: voxel_m: is .nan; write a finite number"},
        BadLine{"inf", "voxel_m: -.INF\n", "6: voxel_m: is -.INF; write a finite number"},
        BadLine{"beyond_double", "voxel_m: 1e999\n",
                "6: voxel_m: 1e999 is beyond what a double holds; write a finite number"},
        BadLine{"negative", "voxel_m: -0.05\n",
                "6: voxel_m: -0.05 is out of range; write a number above 0, up to 10"},
        BadLine{"no_seed_at_all", "seeds: 0\n",
                "6: seeds: 0 is out of range; write a number from 1, up to 100000"},
        BadLine{"element", "faults:\n  mount:\n    translation_m: [0,\n      x, 0]\n",
                "9: faults.mount.translation_m[1]: is x; write a number"},
        BadLine{"too_short", "map_origin_m: [0, 0]\n",
                "6: map_origin_m: has 2 elements; write [3 x number]"},
        BadLine{"duplicate", "voxel_m: 1\nvoxel_m: 2\n",
                "7: voxel_m: key 'voxel_m' stands twice; keep one"},
        BadLine{"detect_word", "detect: everything\n",
                "6: detect: is everything; write all, or a list of class names"},
        BadLine{"detect_none", "detect: []\n",
                "6: detect: names no class; write all, or a list of class names"},
        BadLine{"detect_twice", "detect: [cup, cup]\n", "6: detect: cup stands twice; keep one"},
        BadLine{"no_titles", "class_titles: {}\n",
                "6: class_titles: names no class; write {CLASS: TITLE, ...}, or leave the key out"},
        BadLine{"title_with_a_line", "class_titles: {cup: \"a\\nb\"}\n",
                "6: class_titles.cup: 'a\\nb' holds the control character \\n; remove it"},
        BadLine{"title_twice", "class_titles: {cup: mug, bowl: mug}\n",
                "6: class_titles: 'mug' stands for another too; write one of its own"},
        BadLine{"two_kinds", "fusion: {blend: {}, bayes: {}}\n",
                fmt::format("6: fusion: names 2 kinds; write one of {}, as {{blend: {{}}}}",
                            fmt::join(kinds_of(DrawnFusion{}), ", "))},
        BadLine{"unknown_kind", "fusion: {blond: {}}\n",
                "6: fusion.blond: unknown kind 'blond'; did you mean 'blend'?"},
        BadLine{"ranges_crossed", "cameras:\n  range_min_m: 9\n",
                "7: cameras.range_min_m: 9 is not below range_max_m, 8; write a lesser number"},
        BadLine{"two_doses", "faults:\n  mount: {magnitude_m: 0.1, translation_m: [0, 0, 1]}\n",
                "7: faults.mount.translation_m: stands beside a magnitude_m; keep one of the two"},
        BadLine{"tab", "cameras:\n\tshadows: true\n",
                "7: a tab indents this line; indent with spaces"},
        BadLine{"control_character", "voxel_m: 1\n\x04garbage",
                "7: control character 0x04; remove it"},
        BadLine{
            "second_document", "---\nvoxel_m: 1\n",
            "6: a second document begins, or a stray character ends the first; keep one document"},
        BadLine{"asymmetric",
                kPose + "covariance_m_rad: [[1, 0.5, 0, 0, 0, 0], [0.4, 1, 0, 0, 0, 0], " + kZeros +
                    ", " + kZeros + ", " + kZeros + ", " + kZeros + "]\n",
                "8: faults.pose.covariance_m_rad: is not symmetric: row 2 column 1 is 0.4, row 1 "
                "column 2 is 0.5; make them equal"},
        BadLine{"indefinite",
                kPose + "covariance_m_rad: [[1, 2, 0, 0, 0, 0], [2, 1, 0, 0, 0, 0], " + kZeros +
                    ", " + kZeros + ", " + kZeros + ", " + kZeros + "]\n",
                "8: faults.pose.covariance_m_rad: is not positive semi-definite: its least "
                "eigenvalue is -1; write the covariance of a distribution"},
        BadLine{"sweep_no_leaf", "sweep:\n  faults.misregistration: [0]\n",
                "7: sweep.faults.misregistration: is a section, not a value; name a key below it: "
                "magnitude_m, angle_deg, translation_m, rotation_deg, focal_error_percent, "
                "principal_point_px"},
        BadLine{
            "sweep_unknown", "sweep: {faults.pose.sigma_xy: [0]}\n",
            "6: sweep.faults.pose.sigma_xy: unknown key 'sigma_xy'; did you mean 'sigma_xy_m'?"},
        BadLine{"sweep_below_leaf", "sweep: {voxel_m.x: [1]}\n",
                "6: sweep.voxel_m.x: 'voxel_m' is a value and has no key 'x'; end the path there"},
        BadLine{"sweep_unknown_method", "sweep: {methods.erosoin.place: [points]}\n",
                "6: sweep.methods.erosoin.place: unknown key 'erosoin'; did you mean 'erosion'?"},
        BadLine{
            "sweep_other_kind",
            "sweep: {methods.erosion.segmentation.region_growing.radius_factor: [1]}\n",
            "6: sweep.methods.erosion.segmentation.region_growing.radius_factor: the kind here is "
            "'erosion', not 'region_growing'; choose it as a whole, as {region_growing: "
            "{...}}"},
        BadLine{"sweep_seeds", "sweep: {seeds: [1, 2]}\n",
                "6: sweep.seeds: seeds cannot be swept; remove it"},
        BadLine{"sweep_instances", "sweep: {score.instances: [true, false]}\n",
                "6: sweep.score.instances: score.instances cannot be swept; remove it"},
        BadLine{"sweep_kind", "sweep: {perception: [labels, pictures]}\n",
                "6: sweep.perception[1]: unknown kind 'pictures'; write one of labels, simulated, "
                "images, network"},
        BadLine{"sweep_section", "sweep: {perception: [labels, {simulated: {}}]}\n",
                "6: sweep.perception[1]: is a section; write the name of a kind, whose parameters "
                "stand under the key"},
        BadLine{
            "images_alone", "perception: images\n",
            "6: perception.images.folder: is missing; write folder: FOLDER, of the label images"},
        BadLine{"sweep_empty", "sweep: {voxel_m: []}\n",
                "6: sweep.voxel_m: has no values; write at least one"},
        BadLine{"sweep_no_list", "sweep: {voxel_m: 0.05}\n",
                "6: sweep.voxel_m: is 0.05; write a list, [a, b, ...]"},
        BadLine{"sweep_type", "sweep:\n  voxel_m:\n    - 0.05\n    - wide\n",
                "9: sweep.voxel_m[1]: is wide; write a number"},
        BadLine{"sweep_range", "sweep:\n  voxel_m: [0.05, 0]\n",
                "7: sweep.voxel_m[1]: 0 is out of range; write a number above 0, up to 10"},
        BadLine{"sweep_same_value", "sweep: {voxel_m: [0.01, 0.010]}\n",
                "6: sweep.voxel_m[1]: 0.01 stands twice; keep one"},
        BadLine{"sweep_same_path", "sweep:\n  voxel_m: [1]\n  voxel_m: [2]\n",
                "8: sweep.voxel_m: key 'voxel_m' stands twice; keep one"},
        BadLine{"sweep_cell", "sweep: {cameras.range_min_m: [1, 5], cameras.range_max_m: [8, 4]}\n",
                "6: sweep: with cameras.range_min_m = 5, cameras.range_max_m = 4, "
                "cameras.range_min_m: 5 is not below range_max_m, 4; write a lesser number"},
        BadLine{
            "sweep_huge",
            "sweep:\n  voxel_m: " + numbers(1001) + "\n  map_yaw_deg: " + numbers(1000) + "\n",
            "6: sweep: 1001000 cells by 2 methods and 1 seeds are 2002000 trials; at most 1000000 "
            "cells are held in memory, so --yes does not help: sweep fewer values, or write "
            "sampling: {sobol: {points: N}} and ranges"},
        BadLine{"huge_study", "seeds: 100000\nsweep:\n  map_yaw_deg: " + numbers(5001) + "\n",
                "6: seeds: 5001 cells by 2 methods and 100000 seeds are 1000200000 trials, of at "
                "most 1000000000; write fewer of them"}),
    [](const auto& test) { return std::string(test.param.name); });

TEST(BadStudyFile, OfASceneWithoutOneBesideARecording) {
  for (const char* line : {"classes: a.classes.yaml\n", "robot: a.xml\n", "motion: a.csv\n"})
    EXPECT_THAT(refusal(std::string(line) +
                        "recording: there\nmethods: {d: {segmentation: {direct: {}}}}\n"),
                ::testing::HasSubstr("stands without a scene"))
        << line;
}

TEST(BadStudyFile, WithoutSceneOrRecording) {
  EXPECT_EQ(refusal("methods: {d: {segmentation: {direct: {}}}}\n"),
            "demo.yaml:1: scene: is missing; write scene: PATH, or recording: PATH to replay one");
}

TEST(BadStudyFile, WithAnEmptyTrajectory) {
  EXPECT_EQ(refusal("scene: a.xml\ntrajectory:\n  waypoints_m_deg: []\n"
                    "methods: {d: {segmentation: {direct: {}}}}\n"),
            "demo.yaml:3: trajectory.waypoints_m_deg: the trajectory is empty; write at least one "
            "waypoint, [[x, y, yaw], ...], or for mapscore explore who chooses the way, "
            "exploration: {planner: next_best_view}");
}

TEST(BadStudyFile, WithoutMethods) {
  EXPECT_EQ(refusal("recording: a\nmethods: {}\n"),
            "demo.yaml:2: methods: there is no method; write methods: {direct: {segmentation: "
            "{direct: {}}}}");
}

TEST(BadStudyFile, WithAMethodWithoutSegmentation) {
  EXPECT_EQ(refusal("recording: a\nmethods:\n  d: {place: points}\n"),
            "demo.yaml:3: methods.d: 'segmentation' is missing; write segmentation: ...");
}

TEST(BadStudyFile, WithAMethodNameThatIsNoPartOfAPath) {
  EXPECT_EQ(refusal("recording: a\nmethods: {a.b: {segmentation: {direct: {}}}}\n"),
            "demo.yaml:2: methods.a.b: a.b cannot name a method; use letters, digits, _ and -");
  EXPECT_THAT(refusal("recording: a\nmethods: {\"null\": {segmentation: {direct: {}}}}\n"),
              ::testing::HasSubstr("null cannot name a method"))
      << "a store could not be read again";
}

TEST(BadStudyFile, ThatIsNotYaml) {
  EXPECT_THAT(refusal("scene: a.xml\ncameras: {width_px: 5\nvoxel_m: ]\n"),
              ::testing::MatchesRegex("demo.yaml:3: not YAML: .*; mend the syntax near here"));
}

/// yaml-cpp's own reader of several documents never returns from this.
TEST(BadStudyFile, ThatBeginsWithAStrayComma) {
  EXPECT_EQ(refusal(std::string(",") + kSound),
            "demo.yaml:1: a second document begins, or a stray character ends the first; keep one "
            "document");
}

TEST(BadStudyFile, ThatIsEmpty) {
  EXPECT_EQ(refusal(""), "demo.yaml:1: the file is empty; write key: value");
  EXPECT_EQ(refusal("# nothing\n"), "demo.yaml:1: the file is empty; write key: value");
}

TEST(BadStudyFile, ThatIsNotThere) {
  EXPECT_THROW((void)load_study("no/such/study.yaml"), Error);
  EXPECT_THROW((void)load_study("."), Error);
}

TEST(BadFlag, IsNamedWithItsKey) {
  EXPECT_EQ(refusal(kSound, {"voxel_m=-1"}),
            "flag voxel_m=-1: voxel_m: -1 is out of range; write a number above 0, up to 10");
  EXPECT_EQ(refusal(kSound, {"voxel=1"}),
            "flag voxel=1: voxel: unknown key 'voxel'; did you mean 'voxel_m'?");
  EXPECT_EQ(refusal(kSound, {"cameras={}"}),
            "flag cameras={}: cameras: is a section, not a value; name a key below it: width_px, "
            "height_px, range_min_m, range_max_m, height_m, pan_deg, tilt_deg, shadows");
  EXPECT_EQ(refusal(kSound, {"voxel_m"}), "flag voxel_m: write it as path=value");
}

TEST(BadFlag, IsBlamedForWhatItBreaks) {
  EXPECT_EQ(refusal(kSound, {"cameras.range_min_m=9"}),
            "flag cameras.range_min_m=9: cameras.range_min_m: 9 is not below range_max_m, 8; write "
            "a lesser number");
}

TEST(BadFlag, ForImagesOfMoreThan16MillionPixels) {
  const std::string line = refusal(kSound, {"cameras.width_px=8192", "cameras.height_px=8192"});
  EXPECT_NE(line.find("cameras.width_px: 8192 x 8192 pixels are more than 16777216"),
            std::string::npos)
      << line;
}

TEST(BadFlag, ThatTheSweepWouldOverrule) {
  EXPECT_EQ(refusal(std::string(kSound) + "sweep: {voxel_m: [1, 2]}\n", {"voxel_m=3"}),
            "flag voxel_m=3: voxel_m: is swept; set sweep.voxel_m=[...] instead");
}

}  // namespace
}  // namespace mapscore::eval
