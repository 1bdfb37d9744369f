// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#include "eval/map_files/map_file.hpp"
#include "eval/truth/truth_file.hpp"
#include "files/text_rows.hpp"
#include "tests/eval/map_files/cloud_bytes.hpp"
#include "tests/support/expect_error.hpp"

#include <fmt/format.h>

namespace mapscore::eval {
namespace {

using testing::expect_error;
using testing::Labels;
using testing::Points;
using testing::put;

struct PlyFile : testing::MapFiles {
  MapFile read(const std::string& bytes, NotFinite not_finite = NotFinite::refuse) {
    return read_ply(file("map.ply", bytes), not_finite);
  }
  void expect_refusal(const std::string& bytes, const std::string& part) {
    const auto path = file("map.ply", bytes);
    expect_error("map.ply:", [&] { (void)read_ply(path); });
    expect_error(part, [&] { (void)read_ply(path); });
  }
};

std::string ascii(const std::string& properties, const std::string& rows, int count) {
  return fmt::format(
      "ply\nformat ascii 1.0\ncomment made by hand\nelement vertex {}\n{}end_header\n{}", count,
      properties, rows);
}
const std::string kXyz = "property float x\nproperty float y\nproperty float z\n";

TEST_F(PlyFile, AsciiPointsAlone) {
  const MapFile map = read(ascii(kXyz, "0 1 2\n-0.5 +1e-3 2.25e1  \n", 2));
  EXPECT_EQ(map.points, (Points{{0, 1, 2}, {-0.5, 1e-3, 22.5}}));
  EXPECT_EQ(map.label_kind, LabelKind::none);
  EXPECT_EQ(map.size(), 2u);
  EXPECT_TRUE(map.labels.empty() && map.probabilities.empty() && map.instances.empty());
}

TEST_F(PlyFile, LinesMayEndInCrLfAndTheLastOneInNothing) {
  const std::string text = ascii(kXyz, "0 1 2\n\n3 4 5", 2);
  std::string with_cr;
  for (const char letter : text) {
    if (letter == '\n') with_cr.push_back('\r');
    with_cr.push_back(letter);
  }
  EXPECT_EQ(read(with_cr).points, (Points{{0, 1, 2}, {3, 4, 5}}));
}

TEST_F(PlyFile, ALabelComesBeforeAColour) {
  const std::string colours = "property uchar red\nproperty uchar green\nproperty uchar blue\n";
  const MapFile coloured = read(ascii(kXyz + colours, "0 0 0 255 16 1\n", 1));
  EXPECT_EQ(coloured.label_kind, LabelKind::colour);
  EXPECT_EQ(coloured.labels, Labels{0xff1001});
  const MapFile labelled =
      read(ascii("property int class\n" + colours + kXyz, "7 255 16 1 0 0 0\n", 1));
  EXPECT_EQ(labelled.label_kind, LabelKind::id);
  EXPECT_EQ(labelled.labels, Labels{7});
}

class PlyLabelName : public PlyFile, public ::testing::WithParamInterface<const char*> {};
TEST_P(PlyLabelName, IsALabel) {
  const MapFile map =
      read(ascii(fmt::format("{}property float {}\n", kXyz, GetParam()), "0 0 0 12\n", 1));
  EXPECT_EQ(map.label_kind, LabelKind::id);
  EXPECT_EQ(map.labels, Labels{12});
}
INSTANTIATE_TEST_SUITE_P(Every, PlyLabelName,
                         ::testing::Values("label", "class", "class_id", "semantic", "scalar_label",
                                           "scalar_Label", "category", "scalar_Classification"));

TEST_F(PlyFile, TheFirstLabelOfTheListWins) {
  const MapFile map =
      read(ascii(kXyz + "property int category\nproperty int label\n", "0 0 0 4 5\n", 1));
  EXPECT_EQ(map.labels, Labels{5});
}

TEST_F(PlyFile, ColoursInUnitRangeAndOfMaterials) {
  const MapFile map = read(ascii(kXyz + "property float diffuse_red\nproperty float diffuse_green\n"
                                        "property float diffuse_blue\n",
                                 "0 0 0 1 0.5 0\n", 1));
  EXPECT_EQ(map.labels, Labels{0xff8000});
}

TEST_F(PlyFile, ProbabilityInstanceAndNegativeIds) {
  const MapFile map = read(
      ascii(kXyz + "property int label\nproperty double confidence\nproperty short object_id\n",
            "0 0 0 -1 0.25 -1\n1 0 0 3 1 9\n", 2));
  EXPECT_EQ(map.labels, (Labels{0xffffffffu, 3}));
  EXPECT_EQ(map.probabilities, (std::vector<double>{0.25, 1.0}));
  EXPECT_EQ(map.instances, (Labels{0, 9}));
}

/// Two vertices with every type, a list among them, and faces before and after.
std::string every_type(bool big_endian) {
  const bool swapped = big_endian;
  std::string bytes = fmt::format(
      "ply\nformat binary_{}_endian 1.0\nobj_info x\nelement camera 1\nproperty double f\n"
      "property list short double k\nelement nothing 1000000000000\nelement vertex 2\n"
      "property char a\nproperty double z\nproperty list uchar ushort neighbours\n"
      "property float32 x\nproperty int16 y\nproperty uint label\nproperty uint8 b\n"
      "element face 1\nproperty list uint int vertex_indices\nproperty ushort c\nend_header\n",
      big_endian ? "big" : "little");
  put(bytes, 1.5, swapped);
  put(bytes, std::int16_t{2}, swapped);
  put(bytes, 1.0, swapped);
  put(bytes, 2.0, swapped);
  for (int vertex = 0; vertex < 2; ++vertex) {
    put(bytes, std::int8_t{-3}, swapped);
    put(bytes, 0.1 + vertex, swapped);
    put(bytes, static_cast<std::uint8_t>(vertex * 3), swapped);
    for (int n = 0; n < vertex * 3; ++n) put(bytes, std::uint16_t{999}, swapped);
    put(bytes, 0.5f + static_cast<float>(vertex), swapped);
    put(bytes, static_cast<std::int16_t>(-7 - vertex), swapped);
    put(bytes, static_cast<std::uint32_t>(70000 + vertex), swapped);
    put(bytes, std::uint8_t{200}, swapped);
  }
  put(bytes, std::uint32_t{3}, swapped);
  for (const std::int32_t index : {0, 1, 0}) put(bytes, index, swapped);
  put(bytes, std::uint16_t{1}, swapped);
  return bytes;
}

TEST_F(PlyFile, BinaryOfBothByteOrdersWithListsAndOtherElements) {
  for (const bool big_endian : {false, true}) {
    const std::string bytes = every_type(big_endian);
    const MapFile map = read(bytes);
    EXPECT_EQ(map.points, (Points{{0.5, -7, 0.1}, {1.5, -8, 1.1}}));
    EXPECT_EQ(map.labels, (Labels{70000, 70001}));
    expect_refusal(bytes + '\0', "1 bytes follow the last element");
    const std::size_t body = bytes.find("end_header\n") + 11;
    for (std::size_t size = body; size < bytes.size(); ++size)
      expect_refusal(bytes.substr(0, size), "truncated");
  }
}

TEST_F(PlyFile, PointsThatAreNotFinite) {
  const std::string text =
      ascii(kXyz + "property int label\n", "0 0 nan 3000000000000\n1 2 3 4\n-inf 0 0 0.5\n", 3);
  expect_refusal(text, "2 of 3 points are not finite; leave them out with --skip_nan");
  const MapFile map = read(text, NotFinite::skip);
  EXPECT_EQ(map.points, (Points{{1, 2, 3}}));
  EXPECT_EQ(map.labels, Labels{4});
  const auto path = file("nan.ply", ascii(kXyz, "0 0 nan\n", 1));
  expect_error("the map is empty: none of its 1 points is finite",
               [&] { (void)read_ply(path, NotFinite::skip); });
}

TEST_F(PlyFile, WhatTheTruthIsWrittenAs) {
  const SurfaceTruth truth({{{-1, 2, 3}, 0, true}, {{0, 0, 10}, 1, false}, {{0, 0, 10}, 2, false}},
                           0.1);
  write_truth(folder_ / "truth.ply", truth, nullptr, testing::household());
  const MapFile map = read_ply(folder_ / "truth.ply");
  EXPECT_EQ(map.label_kind, LabelKind::id);
  EXPECT_EQ(map.labels, (Labels{0, 1, 2}));
  ASSERT_EQ(map.points.size(), 3u);
  EXPECT_EQ(voxel_of(map.points[0], 0.1), (VoxelKey{-1, 2, 3}));
  EXPECT_EQ(voxel_of(map.points[2], 0.1), (VoxelKey{0, 0, 10}));
}

TEST_F(PlyFile, BadHeaders) {
  expect_refusal("solid x\n", "no PLY file");
  expect_refusal("", "no PLY file");
  expect_refusal("ply\nformat ascii 1.0\nelement vertex 3\n", "the header does not end");
  expect_refusal("ply\nelement vertex 0\nend_header\n", "no line 'format'");
  expect_refusal("ply\nformat ascii 1.1\nend_header\n", "map.ply:2: expected 'format NAME 1.0'");
  expect_refusal("ply\nformat middle_endian 1.0\n", "map.ply:2: format 'middle_endian' is none of");
  expect_refusal("ply\nformat ascii 1.0\nelement vertex -3\n", "map.ply:3: expected 'element");
  expect_refusal("ply\nformat ascii 1.0\nproperty int x\n", "a property before the first element");
  expect_refusal("ply\nformat ascii 1.0\nelement v 1\nproperty half x\n",
                 "map.ply:4: type 'half' is none of PLY's");
  expect_refusal("ply\nformat ascii 1.0\nelement v 1\nproperty list float int x\n",
                 "a list's length is no whole number");
  expect_refusal("ply\nformat ascii 1.0\nelement v 1\nelement v 1\n", "element 'v' stands twice");
  expect_refusal("ply\nformat ascii 1.0\nvertices 3\n", "map.ply:3: unknown word 'vertices'");
  expect_refusal("ply\nformat ascii 1.0\nelement face 0\nend_header\n", "no element 'vertex'");
  expect_refusal(ascii("property float x\nproperty float y\n", "0 0\n", 1), "no x, y and z");
  expect_refusal(ascii(kXyz + "property int x\n", "0 0 0 0\n", 1), "field 'x' stands twice");
  expect_refusal(ascii(kXyz + "property list int int label\n", "0 0 0 0\n", 1),
                 "field 'label' is a list");
}

TEST_F(PlyFile, BadBodies) {
  expect_refusal(ascii(kXyz, "", 0), "the map is empty");
  expect_refusal(ascii(kXyz, "0 0 0\n", 2), "truncated");
  expect_refusal(ascii(kXyz, "0 0 0\n\n \n\n\n", 2), "truncated: it ends before");
  expect_refusal(ascii(kXyz, "0 0 0\n1 1 1\n", 1), "map.ply:10: follows the last element");
  expect_refusal(ascii(kXyz, "0 0 0\n1 1\n\n\n", 2), "map.ply:10: only 2 numbers");
  expect_refusal(ascii(kXyz, "0 0 0 0\n", 1), "map.ply:9: 4 numbers, the header announces 3");
  expect_refusal(ascii(kXyz, "0 0 0x1\n", 1), "map.ply:9: '0x1' is no number");
  expect_refusal(ascii(kXyz + "property float label\n", "0 0 0 1.5\n", 1),
                 "map.ply:10: label 1.5 is no whole number");
  expect_refusal(ascii(kXyz + "property float score\n", "0 0 0 1.5\n", 1),
                 "map.ply:10: probability 1.5 is not in [0, 1]");
  expect_refusal(ascii(kXyz + "property float score\n", "0 0 0 nan\n", 1), "probability nan");
  expect_refusal(ascii(kXyz + "property int red\nproperty int green\nproperty int blue\n",
                       "0 0 0 256 0 0\n", 1),
                 "256 is not within a colour's range");
}

TEST_F(PlyFile, CountsBeyondTheFileAreRefusedBeforeAnythingIsHeld) {
  for (const char* format : {"ascii", "binary_little_endian", "binary_big_endian"})
    for (const char* element : {"vertex", "face"})
      expect_refusal(
          fmt::format("ply\nformat {} 1.0\nelement {} 1000000000000\n{}{}end_header\n"
                      "0 0 0 0 0 0 0 0\n",
                      format, element, kXyz, element[0] == 'f' ? "element vertex 0\n" + kXyz : ""),
          "truncated: the header announces 1000000000000");
}

TEST_F(PlyFile, HeadersOfManyEntriesAreRefused) {
  for (const std::string entry : {"element e{} 0\n", "property char p{}\n"}) {
    std::string entries;
    for (int n = 0; n < 1024; ++n) entries += fmt::format(fmt::runtime(entry), n);
    expect_refusal("ply\nformat ascii 1.0\nelement vertex 1\n" + entries + "end_header\n",
                   "map.ply:1027: more than 1024 elements and properties");
  }
}

TEST_F(PlyFile, WordsOfALineAreCutToABound) {
  std::string text;
  for (std::size_t n = 0; n < kMostWords + 10; ++n) text += "1 ";
  TextLines lines(text);
  std::vector<std::string_view> words;
  ASSERT_TRUE(lines.next_words(words));
  EXPECT_EQ(words.size(), kMostWords + 1);
}

}  // namespace
}  // namespace mapscore::eval
