// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#include "eval/recording/recording.hpp"
#include "files/file_bytes.hpp"
#include "tests/support/expect_error.hpp"
#include "tests/support/tiny_recording.hpp"

#include <gtest/gtest.h>

namespace mapscore::eval {
namespace {

using mapscore::testing::expect_error;
using mapscore::testing::TemporaryFolder;
using mapscore::testing::write_tiny_recording;

/// A whole recording, to be broken by each test.
class BrokenRecording : public ::testing::Test {
 protected:
  BrokenRecording() { write_tiny_recording(tiny_); }

  /// Replaces the first `from` in a file; the test fails when there is none.
  void replace(const std::string& file, const std::string& from, const std::string& to) const {
    std::string text = read_file(tiny_ / file);
    const std::size_t at = text.find(from);
    ASSERT_NE(at, std::string::npos) << from;
    write_file(tiny_ / file, text.replace(at, from.size(), to));
  }
  void remove(const std::string& file) const { std::filesystem::remove_all(tiny_ / file); }
  void expect_refusal(const std::string& what) const {
    expect_error(what, [&] { (void)Recording::open(tiny_); });
  }

  TemporaryFolder folder_;
  const std::filesystem::path tiny_ = folder_.path() / "tiny";
};

TEST_F(BrokenRecording, MissingFolder) {
  expect_error("no such folder", [&] { (void)Recording::open(folder_.path() / "nowhere"); });
  expect_error("no such folder", [&] { (void)Recording::open(tiny_ / "color.txt"); });
}

TEST_F(BrokenRecording, AnImageThatIsNotTheHashedOne) {
  const Recording recording = Recording::open(tiny_);
  std::filesystem::copy_file(tiny_ / "label/000001.png", tiny_ / "label/000000.png",
                             std::filesystem::copy_options::overwrite_existing);
  const std::string what = "label/000000.png: is not the image of this recording";
  expect_error(what, [&] { (void)recording.read(0); });
  expect_error(what, [&] { (void)Recording::open(tiny_).read(0); });
  EXPECT_EQ(recording.read(1).index, 1);
  remove("hashes.txt");
  EXPECT_EQ(Recording::open(tiny_).read(0).index, 0) << "taken as they are";
}

TEST_F(BrokenRecording, PathsThatLeaveTheFolder) {
  const std::string what = "leads out of the folder; a recording holds its own images";
  const std::string list = read_file(tiny_ / "color.txt");
  write_file(folder_.path() / "outside.png", read_file(tiny_ / "color/000000.png"));
  for (const std::string& path :
       {std::string("../outside.png"), (folder_.path() / "outside.png").string(),
        std::string("color/../../outside.png"), std::string("color/../color/000000.png")}) {
    replace("color.txt", "color/000000.png", path);
    expect_refusal(what);
    write_file(tiny_ / "color.txt", list);
  }
  remove("color/000000.png");
  std::filesystem::create_symlink("../../outside.png", tiny_ / "color/000000.png");
  expect_refusal(what);
}

TEST_F(BrokenRecording, AFolderOfImagesThatIsALinkOut) {
  std::filesystem::rename(tiny_ / "depth", folder_.path() / "depth");
  std::filesystem::create_directory_symlink("../depth", tiny_ / "depth");
  expect_refusal("image 'depth/000000.png' leads out of the folder");
}

TEST_F(BrokenRecording, LinksWithinTheFolderAreFollowed) {
  std::filesystem::rename(tiny_ / "color", tiny_ / "images");
  std::filesystem::create_directory_symlink("images", tiny_ / "color");
  EXPECT_EQ(Recording::open(tiny_).frame_count(), 4);
}

TEST_F(BrokenRecording, NamesThatATerminalObeys) {
  replace("recording.yaml", "name: \"background\", colour", "name: \"a\\x1b[2J\", colour");
  expect_refusal("classes[0].name: 'a\\x1b[2J' holds the control character \\x1b; remove it");
}

TEST_F(BrokenRecording, NoRecordingYaml) {
  remove("recording.yaml");
  expect_refusal("not a recording (no recording.yaml in it)");
}

TEST_F(BrokenRecording, BrokenYaml) {
  write_file(tiny_ / "recording.yaml", "format_version: 1\nscene: [a, b\n");
  expect_refusal("not YAML");
  write_file(tiny_ / "recording.yaml", "");
  expect_refusal("recording.yaml:1: the file is empty; write key: value");
}

TEST_F(BrokenRecording, OtherFormatVersion) {
  replace("recording.yaml", "format_version: 1", "format_version: 2\nnews: 3");
  expect_refusal("recording.yaml:1: format_version: recording of format 2, this program reads 1");
}

struct YamlCase {
  const char* name;
  const char* from;
  const char* to;
  const char* what;
};
void PrintTo(const YamlCase& c, std::ostream* out) {
  *out << c.name;
}
class BrokenYaml : public BrokenRecording, public ::testing::WithParamInterface<YamlCase> {};

TEST_P(BrokenYaml, IsRefusedWithKeyAndReason) {
  replace("recording.yaml", GetParam().from, GetParam().to);
  expect_refusal(GetParam().what);
}

INSTANTIATE_TEST_SUITE_P(
    Every, BrokenYaml,
    ::testing::Values(
        YamlCase{"no_seed", "seed: 7\n", "", "'seed' is missing; write seed: ..."},
        YamlCase{"seed_below_0", "seed: 7", "seed: -7",
                 "recording.yaml:5: seed: is \"-7\"; write a whole number from 0 to"},
        YamlCase{"key_of_no_meaning", "seed: 7", "seed: 7\nspeed: 1",
                 "recording.yaml:6: speed: unknown key 'speed'; did you mean 'seed'?"},
        YamlCase{"key_twice", "seed: 7", "seed: 7\nseed: 8", "key 'seed' stands twice"},
        YamlCase{"truth_neither_true_nor_false", "has_truth: true", "has_truth: maybe",
                 "has_truth: is maybe; write true or false"},
        YamlCase{"rate_0", "rate_hz: 2}", "rate_hz: 0}", "color.rate_hz: 0 is not above 0"},
        YamlCase{"width_in_powers_of_ten", "width_px: 64", "width_px: 1e9",
                 "color.width_px: is 1e9; write a whole number"},
        YamlCase{"cx_nan", "cx_px: 31.5", "cx_px: .nan",
                 "color.cx_px: is .nan; write a finite number"},
        YamlCase{"cy_infinite", "cy_px: 23.5", "cy_px: .inf",
                 "color.cy_px: is .inf; write a finite number"},
        YamlCase{"cy_the_word_nan", "cy_px: 23.5", "cy_px: nan",
                 "color.cy_px: is nan; write a finite number"},
        YamlCase{"no_cy", "cy_px: 23.5, ", "", "color: 'cy_px' is missing"},
        YamlCase{"camera_key_of_no_meaning", "cy_px: 23.5", "cy_px: 23.5, k1: 0",
                 "color.k1: unknown key 'k1'"},
        YamlCase{"range_from_beyond_its_end", "range_min_m: 0.6", "range_min_m: 9",
                 "depth: expected 0 <= range_min_m"},
        YamlCase{"pose_of_six_numbers", "T_color_depth: [0.025, 0", "T_color_depth: [0.025",
                 "T_color_depth: expected [tx"},
        YamlCase{"pose_with_a_letter", "T_color_depth: [0.025", "T_color_depth: [x",
                 "T_color_depth[0]: is x; write a finite number"},
        YamlCase{"quaternion_too_long", "0, 0, 0, 1]", "0, 0, 0, 2]", "T_color_depth: quaternion"},
        YamlCase{"classes_no_list", "classes:\n", "classes: 3\nold:\n", "unknown key 'old'"},
        YamlCase{"class_left_out", "{id: 1, name: \"crate\"", "{id: 3, name: \"crate\"",
                 "classes[1].id: is 3; write a whole number from 1 to 1"},
        YamlCase{"class_name_twice", "\"wall\"", "\"crate\"", "two classes have this name"},
        YamlCase{"colour_by_name", "\"FF0000\"", "\"red\"",
                 "classes[1].colour: is red; write six hexadecimal digits in quotes"},
        YamlCase{"class_beyond_the_table", "class: 2", "class: 3",
                 "instances[2].class: is 3; write a whole number from 0 to 2"},
        YamlCase{"background_with_a_class", "class: 0", "class: 1", "instance 0 is background"},
        YamlCase{"frame_too_many", "frame_count: 4", "frame_count: 5",
                 "color.txt: 4 lines, recording.yaml says frame_count 5"}));

TEST_F(BrokenRecording, MissingLists) {
  for (const char* list : {"color.txt", "depth.txt", "groundtruth.txt"}) {
    const std::string text = read_file(tiny_ / list);
    remove(list);
    expect_refusal(std::string(list) + ": cannot open");
    write_file(tiny_ / list, "# nothing\n");
    expect_refusal(std::string(list) + ": no lines");
    write_file(tiny_ / list, text);
  }
}

TEST_F(BrokenRecording, ListsOutOfOrderOrDoubled) {
  replace("color.txt", "\n1 ", "\n0.5 ");
  expect_refusal("color.txt:4: stamp 0.5 does not come after 0.5");
  replace("color.txt", "\n0.5 color/000002", "\n0.2 color/000002");
  expect_refusal("color.txt:4: stamp 0.2 does not come after 0.5");
}

TEST_F(BrokenRecording, LinesThatAreNotOfTheFormat) {
  replace("depth.txt", "1.5 depth", "x depth");
  expect_refusal("depth.txt:5: 'x' is no time stamp");
  replace("depth.txt", "x depth", "depth");
  expect_refusal("depth.txt:5: expected 'stamp_s path'");
}

TEST_F(BrokenRecording, ALineLostFromAList) {
  replace("color.txt", "1.5 color/000003.png\n", "");
  expect_refusal("color.txt: 3 lines, recording.yaml says frame_count 4");
}

TEST_F(BrokenRecording, ALineLostFromTheDepthList) {
  replace("depth.txt", "1.5 depth/000003.png\n", "");
  expect_refusal("hashes.txt: does not list the images of color.txt and depth.txt");
}

TEST_F(BrokenRecording, PosesMissingOrBroken) {
  replace("groundtruth.txt", "\n0.5 ", "\n0.51 ");
  expect_refusal("groundtruth.txt: no pose at stamp 0.5 of depth/000001.png");
  write_file(tiny_ / "groundtruth.txt", "0 0 0 0 0 0 0 1\n0.5 0 0 0 0 0 0 1\n");
  expect_refusal("groundtruth.txt: no pose at stamp 1 of depth/000002.png");
  write_file(tiny_ / "groundtruth.txt", "0 0 0 0 0 0 0 1\n0.5 0 0 0 0 0 0 1.002\n");
  expect_refusal("groundtruth.txt:2: quaternion qx qy qz qw is not of length 1");
  write_file(tiny_ / "groundtruth.txt", "0 0 0 nan 0 0 0 1\n");
  expect_refusal("groundtruth.txt:1: 'nan' is not a finite number");
  write_file(tiny_ / "groundtruth.txt", "0 0 0 0 0 0 0\n");
  expect_refusal("groundtruth.txt:1: expected 'stamp_s tx ty tz qx qy qz qw'");
}

TEST_F(BrokenRecording, MissingImages) {
  for (const char* channel : {"color", "depth", "label", "depth_label"}) {
    const std::string image = std::string(channel) + "/000002.png";
    const std::string bytes = read_file(tiny_ / image);
    remove(image);
    expect_refusal(image + ": image is missing");
    write_file(tiny_ / image, bytes);
  }
  EXPECT_EQ(Recording::open(tiny_).frame_count(), 4);
}

TEST_F(BrokenRecording, MissingSurfaces) {
  remove("truth/shapes.csv");
  expect_refusal("truth/shapes.csv: file is missing");
}

TEST_F(BrokenRecording, HashesOfOtherImages) {
  replace("hashes.txt", "color/000002.png", "color/000009.png");
  expect_refusal("hashes.txt: does not list the images");
}

TEST_F(BrokenRecording, DamagedImagesAreRefusedWhenRead) {
  const std::string png = read_file(tiny_ / "depth/000001.png");
  remove("hashes.txt");
  const auto read = [&] { (void)Recording::open(tiny_).read(1); };
  write_file(tiny_ / "depth/000001.png", png.substr(0, png.size() - 7));
  expect_error("depth/000001.png: PNG cut off", read);
  write_file(tiny_ / "depth/000001.png", read_file(tiny_ / "color/000001.png"));
  expect_error("depth/000001.png: image is not 16-bit grey", read);
  EXPECT_EQ(Recording::open(tiny_).read(2).index, 2);
}

TEST_F(BrokenRecording, ImagesOfAnotherSize) {
  replace("recording.yaml", "depth: {width_px: 64", "depth: {width_px: 65");
  const Recording recording = Recording::open(tiny_);
  expect_error("depth/000000.png: image is 64 x 48, recording.yaml says 65 x 48",
               [&] { (void)recording.read(0); });
}

TEST_F(BrokenRecording, FramesBeyondTheLast) {
  const Recording recording = Recording::open(tiny_);
  for (const int index : {-1, 4})
    expect_error("the recording has frames 0 to 3", [&] { (void)recording.read(index); });
}

TEST_F(BrokenRecording, CamerasOfMoreThan16MillionPixels) {
  replace("recording.yaml", "color: {width_px: 64, height_px: 48",
          "color: {width_px: 16384, height_px: 16384");
  expect_refusal("color: 16384 x 16384 pixels are more than 16777216, as of 4096 x 4096");
}

TEST_F(BrokenRecording, YamlOfManyValues) {
  write_file(tiny_ / "recording.yaml", "a: [" + std::string(1 << 19, ',') + "]\n");
  expect_refusal("recording.yaml: more than 524288 values; is it the right file?");
}

TEST_F(BrokenRecording, LinesOfManyWordsAndCells) {
  std::string words = "0";
  for (int n = 0; n < 1000; ++n) words += " 0";
  write_file(tiny_ / "groundtruth.txt", words + "\n");
  expect_refusal("groundtruth.txt:1: expected 'stamp_s tx ty tz qx qy qz qw'");
}

TEST_F(BrokenRecording, ShapesOfManyCells) {
  const auto shapes = tiny_ / "truth/shapes.csv";
  write_file(shapes, read_file(shapes) + std::string(1000, ',') + "\n");
  expect_error("shapes.csv:4: expected 13 columns",
               [&] { (void)Recording::open(tiny_).read_shapes(); });
}

TEST_F(BrokenRecording, HashesOfMoreImagesThanThereAre) {
  write_file(tiny_ / "hashes.txt", read_file(tiny_ / "hashes.txt") + "0 a\n0 b\n0 c\n");
  expect_refusal("hashes.txt: does not list the images of color.txt and depth.txt");
}

}  // namespace
}  // namespace mapscore::eval
