// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#include "eval/map_files/map_file.hpp"
#include "tests/eval/map_files/cloud_bytes.hpp"
#include "tests/support/expect_error.hpp"

#include <fmt/format.h>
#include <liblzf/lzf.h>

#include <bit>
#include <limits>

namespace mapscore::eval {
namespace {

using testing::expect_error;
using testing::Labels;
using testing::Points;
using testing::put;

constexpr float kNan = std::numeric_limits<float>::quiet_NaN();

struct PcdFile : testing::MapFiles {
  MapFile read(const std::string& bytes, NotFinite not_finite = NotFinite::refuse) {
    return read_pcd(file("map.pcd", bytes), not_finite);
  }
  void expect_refusal(const std::string& bytes, const std::string& part) {
    const auto path = file("map.pcd", bytes);
    expect_error("map.pcd:", [&] { (void)read_pcd(path); });
    expect_error(part, [&] { (void)read_pcd(path); });
  }
};

/// The header that the Point Cloud Library writes.
std::string header(const std::string& fields, const std::string& sizes, const std::string& types,
                   const std::string& counts, int width, int height, const std::string& data) {
  return fmt::format(
      "# .PCD v0.7 - Point Cloud Data file format\nVERSION 0.7\nFIELDS {}\nSIZE {}\nTYPE {}\n"
      "COUNT {}\nWIDTH {}\nHEIGHT {}\nVIEWPOINT 0 0 0 1 0 0 0\nPOINTS {}\nDATA {}\n",
      fields, sizes, types, counts, width, height, width * height, data);
}
std::string xyz(int points, const std::string& data) {
  return header("x y z", "4 4 4", "F F F", "1 1 1", points, 1, data);
}

/// A colour as the library packs it into a float; with alpha 255 most are not a number.
float packed(std::uint32_t rgb, std::uint32_t alpha) {
  return std::bit_cast<float>(alpha << 24 | rgb);
}

/// An organised cloud of 4 x 2 pixels as a depth camera gives it: no return in the first column.
struct Pixel {
  float x, y, z;
  std::uint32_t rgb;
};
std::vector<Pixel> organised() {
  std::vector<Pixel> pixels;
  for (int v = 0; v < 2; ++v)
    for (int u = 0; u < 4; ++u) {
      const bool hole = u == 0;
      pixels.push_back({hole ? kNan : 0.25f * static_cast<float>(u),
                        hole ? kNan : -0.5f * static_cast<float>(v), hole ? kNan : 1.5f,
                        u < 2 ? 0xff8000u : 0x0000ffu});
    }
  return pixels;
}
const Points kSeen{{0.25, 0, 1.5},    {0.5, 0, 1.5},    {0.75, 0, 1.5},
                   {0.25, -0.5, 1.5}, {0.5, -0.5, 1.5}, {0.75, -0.5, 1.5}};
const Labels kColours{0xff8000, 0xff, 0xff, 0xff8000, 0xff, 0xff};

TEST_F(PcdFile, OrganisedXyzrgbAsTheLibraryWritesPointClouds) {
  for (const std::uint32_t alpha : {0u, 255u}) {
    std::string bytes = header("x y z rgb", "4 4 4 4", "F F F F", "1 1 1 1", 4, 2, "binary");
    for (const Pixel& pixel : organised())
      for (const float value : {pixel.x, pixel.y, pixel.z, packed(pixel.rgb, alpha)})
        put(bytes, value);
    expect_refusal(bytes, "2 of 8 points are not finite; leave them out with --skip_nan");
    const MapFile map = read(bytes, NotFinite::skip);
    EXPECT_EQ(map.points, kSeen);
    EXPECT_EQ(map.label_kind, LabelKind::colour);
    EXPECT_EQ(map.labels, kColours);
  }
}

/// Messages are written with the gaps that aligned points have in memory.
TEST_F(PcdFile, OrganisedXyzrgbAsRosWritesMessages) {
  std::string bytes =
      header("x y z _ rgb _", "4 4 4 1 4 1", "F F F U F U", "1 1 1 4 1 12", 4, 2, "binary");
  for (const Pixel& pixel : organised()) {
    for (const float value : {pixel.x, pixel.y, pixel.z, 1.0f, packed(pixel.rgb, 255)})
      put(bytes, value);
    bytes += std::string(12, '\x7f');
  }
  const MapFile map = read(bytes, NotFinite::skip);
  EXPECT_EQ(map.points, kSeen);
  EXPECT_EQ(map.labels, kColours);
}

TEST_F(PcdFile, XyzlAsTheLibraryWritesIt) {
  std::string bytes = header("x y z label", "4 4 4 4", "F F F U", "1 1 1 1", 3, 1, "binary");
  for (int point = 0; point < 3; ++point) {
    for (int axis = 0; axis < 3; ++axis) put(bytes, static_cast<float>(point) + 0.5f);
    put(bytes, static_cast<std::uint32_t>(point) * 2'000'000'000u);
  }
  const MapFile map = read(bytes);
  EXPECT_EQ(map.points, (Points{{0.5, 0.5, 0.5}, {1.5, 1.5, 1.5}, {2.5, 2.5, 2.5}}));
  EXPECT_EQ(map.label_kind, LabelKind::id);
  EXPECT_EQ(map.labels, (Labels{0, 2000000000, 4000000000}));
}

/// Fields one behind the other, compressed, two sizes ahead. Gaps are left out unless wanted.
std::string compressed(const std::string& head, const std::string& by_field) {
  std::string packed_bytes(by_field.size() * 2 + 64, '\0');
  const unsigned size =
      lzf_compress(by_field.data(), static_cast<unsigned>(by_field.size()), packed_bytes.data(),
                   static_cast<unsigned>(packed_bytes.size()));
  std::string bytes = head;
  put(bytes, static_cast<std::uint32_t>(size));
  put(bytes, static_cast<std::uint32_t>(by_field.size()));
  return bytes + packed_bytes.substr(0, size);
}

std::string by_field(bool with_gaps) {
  std::string x, y, z, rgb, gap;
  for (const Pixel& pixel : organised()) {
    put(x, pixel.x);
    put(y, pixel.y);
    put(z, pixel.z);
    put(rgb, packed(pixel.rgb, 255));
    if (with_gaps) gap += "abcd";
  }
  return x + y + z + gap + rgb;
}

TEST_F(PcdFile, BinaryCompressedWithAndWithoutItsGaps) {
  const std::string plain =
      header("x y z rgb", "4 4 4 4", "F F F F", "1 1 1 1", 4, 2, "binary_compressed");
  const std::string gaps =
      header("x y z _ rgb", "4 4 4 1 4", "F F F U F", "1 1 1 4 1", 4, 2, "binary_compressed");
  for (const std::string& bytes :
       {compressed(plain, by_field(false)), compressed(gaps, by_field(false)),
        compressed(gaps, by_field(true))}) {
    const MapFile map = read(bytes, NotFinite::skip);
    EXPECT_EQ(map.points, kSeen);
    EXPECT_EQ(map.labels, kColours);
    expect_refusal(bytes.substr(0, bytes.size() - 1), "truncated");
    expect_refusal(bytes + 'x', "bytes follow the last point");
    EXPECT_EQ(read(bytes + std::string(4095, '\0'), NotFinite::skip).points, kSeen);
    expect_refusal(bytes + std::string(4096, '\0'), "bytes follow the last point");
    expect_refusal(bytes + std::string(9, '\0') + 'x', "bytes follow the last point");
  }
  expect_refusal(compressed(plain, by_field(true)),
                 "unpacks to 160 bytes, the header asks for 128");
}

TEST_F(PcdFile, BadCompressedBodies) {
  const std::string head = xyz(2, "binary_compressed");
  expect_refusal(head + "1234567", "no sizes of the compressed body");
  std::string damaged = compressed(head, std::string(24, 'a'));
  damaged[head.size() + 8] = '\xff';  // refers back to before the first byte
  expect_refusal(damaged, "compressed body is damaged");
  std::string bomb = xyz(300'000'000, "binary_compressed");
  put(bomb, std::uint32_t{4});
  put(bomb, std::uint32_t{3'600'000'000});
  expect_refusal(bomb + "abcd",
                 "4 compressed bytes would unpack to 3600000000, more than 10 times");
  expect_refusal(xyz(400'000'000, "binary_compressed") + "12345678",
                 "400000000 points do not fit into one compressed body");
}

TEST_F(PcdFile, BodiesThatUnpackToMuchMoreThanCloudsDoAreRefused) {
  constexpr int kRoom = (1 << 24) / 12;  // the most that may be all the same
  const auto equal_points = [](int points) {
    return compressed(xyz(points, "binary_compressed"), std::string(12 * std::size_t(points), 1));
  };
  EXPECT_EQ(read(equal_points(kRoom)).points.size(), std::size_t{kRoom});
  expect_refusal(equal_points(kRoom + 1), "more than 10 times as many; is the file damaged?");
}

TEST_F(PcdFile, FieldsBeyondAThousandAreRefused) {
  std::string names;
  for (int n = 0; n < 1025; ++n) names += fmt::format(" f{}", n);
  expect_refusal("VERSION 0.7\nFIELDS" + names + "\n", "map.pcd:2: FIELDS has more than 1024");
}

TEST_F(PcdFile, AsciiWithArraysAndColoursAsFloats) {
  const std::string head =
      header("x hist y z rgb", "4 4 4 8 4", "F F F F F", "1 3 1 1 1", 3, 1, "ascii");
  // 4.2108e+06 is the tutorial's; 0000ff is a float far below the smallest normal one.
  const MapFile map = read(
      head + "1 9 9 9 2 3 4.2108e+06\n4 9 9 9 5 6 3.5733110840282835e-43\nnan 9 9 9 nan nan nan\n",
      NotFinite::skip);
  EXPECT_EQ(map.points, (Points{{1, 2, 3}, {4, 5, 6}}));
  EXPECT_EQ(map.labels, (Labels{std::bit_cast<std::uint32_t>(4.2108e+06f) & 0xffffff, 0x0000ff}));
  expect_refusal(head + "1 9 9 9 2 3 nan\n1 9 9 9 2 3 0\n1 9 9 9 2 3 0\n",
                 "map.pcd:12: packed colour nan is no whole number");
}

TEST_F(PcdFile, AsciiColoursAsWholeNumbersAndByChannel) {
  const MapFile whole = read(header("x y z rgba", "4 4 4 4", "F F F U", "1 1 1 1", 1, 1, "ascii") +
                             "0 0 0 4278255360\n");
  EXPECT_EQ(whole.labels, Labels{0x00ff00});
  const MapFile channels =
      read(header("x y z r g b", "8 8 8 1 1 1", "F F F U U U", "1 1 1 1 1 1", 1, 1, "ascii") +
           "0 0 0 1 2 3\n");
  EXPECT_EQ(channels.labels, Labels{0x010203});
}

TEST_F(PcdFile, IntensityIsNoLabel) {
  const MapFile map =
      read(header("x y z intensity", "4 4 4 4", "F F F F", "1 1 1 1", 1, 1, "ascii") + "0 0 0 5\n");
  EXPECT_EQ(map.label_kind, LabelKind::none);
}

TEST_F(PcdFile, OldHeadersWithoutWidthCountAndViewpoint) {
  const MapFile map = read(
      "# .PCD v.5\nVERSION .5\nCOLUMNS x y z\nSIZE 4 4 4\nTYPE F F F\nPOINTS 1\nDATA ascii\n1 2 3");
  EXPECT_EQ(map.points, (Points{{1, 2, 3}}));
}

TEST_F(PcdFile, BadHeaders) {
  const std::string good = xyz(1, "ascii") + "0 0 0\n";
  const auto with = [&](const std::string& from, const std::string& to) {
    std::string text = good;
    return text.replace(text.find(from), from.size(), to);
  };
  EXPECT_EQ(read(good).size(), 1u);
  expect_refusal("", "has no line DATA");
  expect_refusal(with("DATA ascii\n0 0 0\n", ""), "has no line DATA");
  expect_refusal(with("DATA ascii", "DATA text"), "map.pcd:11: DATA is none of ascii");
  expect_refusal(with("SIZE 4 4 4\n", ""), "the header has no line SIZE");
  expect_refusal(with("SIZE 4 4 4", "SIZE 4 4"), "map.pcd:4: SIZE has 2 values for 3 fields");
  expect_refusal(with("TYPE F F F", "TYPE F F X"), "there is no type 'X' of size 4");
  expect_refusal(with("SIZE 4 4 4", "SIZE 4 4 3"), "there is no type 'F' of size 3");
  expect_refusal(with("COUNT 1 1 1", "COUNT 1 1 2"), "field 'z' is a list");
  expect_refusal(with("COUNT 1 1 1", "COUNT 1 1 99999999999"), "map.pcd:6: COUNT is 0, or in all");
  expect_refusal(with("COUNT 1 1 1", "COUNT 1 1 -1"), "map.pcd:6: expected a whole number");
  expect_refusal(with("WIDTH 1", "WIDTH 2"), "WIDTH 2 times HEIGHT 1 is not POINTS 1");
  expect_refusal(with("WIDTH 1", "WIDTH 4294967297"), "is not POINTS 1");
  expect_refusal(with("POINTS 1", "POINTS 1 1"), "POINTS needs one value");
  expect_refusal(with("POINTS 1\n", "POINTS 1\nPOINTS 1\n"), "map.pcd:11: POINTS stands twice");
  expect_refusal(with("VERSION", "VERSIONS"), "map.pcd:2: unknown word 'VERSIONS'");
  expect_refusal(with("FIELDS x y z", "FIELDS x y x"), "field 'x' stands twice");
  expect_refusal(with("FIELDS x y z", "FIELDS x y w"), "no x, y and z");
  expect_refusal(with("FIELDS x y z", "FIELDS"), "SIZE has 3 values for 0 fields");
  expect_refusal(header("x y z rgb", "4 4 4 8", "F F F F", "1 1 1 1", 1, 1, "ascii"),
                 "field 'rgb' is 8 bytes wide; a packed colour has 4");
}

TEST_F(PcdFile, BadBodies) {
  expect_refusal(xyz(0, "ascii"), "the map is empty");
  expect_refusal(xyz(0, "binary"), "the map is empty");
  expect_refusal(xyz(2, "ascii") + "0 0 0\n", "truncated");
  expect_refusal(xyz(1, "ascii") + "0 0 0\n1 1 1\n", "map.pcd:13: follows the last point");
  expect_refusal(xyz(1, "ascii") + "0 0 0 0\n", "map.pcd:12: 4 numbers, the header announces 3");
  expect_refusal(xyz(1, "ascii") + "0 0 zero\n", "map.pcd:12: 'zero' is no number");
  expect_refusal(xyz(1, "binary") + "12345678901",
                 "truncated: 1 points of 12 bytes are announced, 11 bytes are there");
  expect_refusal(xyz(1, "binary") + "1234567890123", "bytes follow the last point");
  EXPECT_EQ(read(xyz(1, "binary") + std::string(12 + 4095, '\0'), NotFinite::skip).points.size(),
            1u);
  expect_refusal(xyz(1, "binary") + std::string(12 + 4096, '\0'), "bytes follow the last point");
  for (const char* data : {"ascii", "binary"})
    expect_refusal(fmt::format("FIELDS x y z\nSIZE 4 4 4\nTYPE F F F\nWIDTH 1000000\n"
                               "HEIGHT 1000000\nPOINTS 1000000000000\nDATA {}\n0 0 0\n",
                               data),
                   "1000000000000 points");
}

}  // namespace
}  // namespace mapscore::eval
