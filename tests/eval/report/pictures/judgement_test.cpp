// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#include "eval/report/pictures/judgement.hpp"

#include "core/error.hpp"
#include "tests/support/tiny_recording.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstring>
#include <filesystem>
#include <fstream>
#include <iterator>

namespace mapscore::eval {
namespace {

namespace fs = std::filesystem;
using ::testing::EndsWith;
using ::testing::HasSubstr;

JudgedMap two_voxels() {
  JudgedMap map;
  map.edge_m = 0.1;
  map.T_world_map.translation() = Eigen::Vector3d(7, 8, 9);  // the file is in frame map
  map.voxels = {{{-1, 0, 12}, 3, Verdict::leak, false}, {{-1, 0, 12}, 258, Verdict::missed, true}};
  return map;
}

struct Vertex {
  float x, y, z;
  std::uint8_t red, green, blue;
  std::uint16_t class_id;
  std::uint8_t verdict;
};

template <class T>
T take(const char*& from) {
  T value;
  std::memcpy(&value, from, sizeof(T));
  from += sizeof(T);
  return value;
}

Vertex take_vertex(const char*& from) {
  const float x = take<float>(from), y = take<float>(from), z = take<float>(from);
  const auto red = take<std::uint8_t>(from), green = take<std::uint8_t>(from),
             blue = take<std::uint8_t>(from);
  const auto class_id = take<std::uint16_t>(from);
  return {x, y, z, red, green, blue, class_id, take<std::uint8_t>(from)};
}

class ErrorPly : public ::testing::Test {
 protected:
  mapscore::testing::TemporaryFolder temporary;
  const fs::path& folder = temporary.path();
};

TEST_F(ErrorPly, HoldsAVertexAVoxel) {
  write_error_ply(folder / "errors.ply", two_voxels());
  std::ifstream stream(folder / "errors.ply", std::ios::binary);
  const std::string bytes{std::istreambuf_iterator<char>(stream), {}};
  EXPECT_EQ(bytes, error_ply_bytes(two_voxels()));
  const std::size_t end = bytes.find("end_header\n") + 11;
  EXPECT_EQ(bytes.substr(0, end),
            "ply\nformat binary_little_endian 1.0\n"
            "comment verdict 0 true 1 near 2 leak 3 floating 4 missed\n"
            "element vertex 2\nproperty float x\nproperty float y\nproperty float z\n"
            "property uchar red\nproperty uchar green\nproperty uchar blue\n"
            "property ushort class\nproperty uchar verdict\nend_header\n");
  ASSERT_EQ(bytes.size(), end + 2 * 18);
  const char* from = bytes.data() + end;
  const Vertex leak = take_vertex(from), missed = take_vertex(from);
  EXPECT_FLOAT_EQ(leak.x, -0.05f);
  EXPECT_FLOAT_EQ(leak.y, 0.05f);
  EXPECT_FLOAT_EQ(leak.z, 1.25f);
  EXPECT_EQ((Colour{leak.red, leak.green, leak.blue}), colour_of(Verdict::leak));
  EXPECT_EQ(leak.class_id, 3);
  EXPECT_EQ(leak.verdict, 2);
  EXPECT_EQ((Colour{missed.red, missed.green, missed.blue}), colour_of(Verdict::missed));
  EXPECT_EQ(missed.class_id, 258);
  EXPECT_EQ(missed.verdict, 4);
}

TEST_F(ErrorPly, OfAnEmptyMapHasNoVertex) {
  EXPECT_THAT(error_ply_bytes({}), HasSubstr("element vertex 0\n"));
  EXPECT_THAT(error_ply_bytes({}), EndsWith("end_header\n"));
}

TEST_F(ErrorPly, LeavesNothingBehindWhereItCannotBeWritten) {
  fs::create_directories(folder / "taken.ply" / "by_a_folder");
  for (const char* name : {"errors.obj", "errors", "taken.ply", "no_such_folder/errors.ply"})
    EXPECT_THROW(write_error_ply(folder / name, two_voxels()), Error) << name;
  EXPECT_EQ(std::distance(fs::directory_iterator(folder), {}), 1) << "the folder in the way alone";
}

}  // namespace
}  // namespace mapscore::eval
