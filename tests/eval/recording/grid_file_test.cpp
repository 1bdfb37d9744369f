// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#include "eval/recording/grid_file.hpp"

#include "core/random_stream.hpp"
#include "files/file_bytes.hpp"
#include "files/pgm.hpp"
#include "tests/support/expect_error.hpp"
#include "tests/support/mutations.hpp"
#include "tests/support/tiny_recording.hpp"

#include <gtest/gtest.h>

#include <filesystem>
#include <string>

namespace mapscore::eval {
namespace {

using mapscore::testing::expect_error;

constexpr const char* kYaml =
    "image: map.pgm\nresolution: 0.05\norigin: [-1.5, 2.25, 0.5]\nnegate: 0\n"
    "occupied_thresh: 0.65\nfree_thresh: 0.196\n";
constexpr const char* kPgm = "P2\n# made by hand\n3 2\n255\n0 205 254\n254 254 0\n";

/// A folder of its own for each test.
class GridFile : public ::testing::Test {
 protected:
  OccupancyGrid load(const std::string& yaml, const std::string& pgm) {
    write_file(folder_ / "map.yaml", yaml);
    write_file(folder_ / "map.pgm", pgm);
    return load_grid(folder_ / "map.yaml");
  }
  void refuses(const std::string& part, const std::string& yaml, const std::string& pgm = kPgm) {
    expect_error(part, [&] { static_cast<void>(load(yaml, pgm)); });
  }

  mapscore::testing::TemporaryFolder temporary_;
  const std::filesystem::path& folder_ = temporary_.path();
};

std::string with(std::string text, const std::string& from, const std::string& to) {
  return text.replace(text.find(from), from.size(), to);
}

OccupancyGrid random_cells(const std::vector<Occupancy>& values) {
  RandomStream stream(1, "grid file");
  OccupancyGrid grid({1.0 / 30.0, {-0.1, 1.0 / 7.0, -2.9}, 23, 17});
  for (GridCell cell; cell.row < 17; ++cell.row)
    for (cell.column = 0; cell.column < 23; ++cell.column)
      grid.set(cell, values[stream.bits() % values.size()]);
  return grid;
}

TEST_F(GridFile, ReadsByHand) {
  const OccupancyGrid grid = load(kYaml, kPgm);
  EXPECT_EQ(grid.frame(), (GridFrame{0.05, {-1.5, 2.25, 0.5}, 3, 2}));
  EXPECT_EQ(grid.cells(), (std::vector<Occupancy>{0, 0, 100, 100, -1, 0}));  // last line first
}

TEST_F(GridFile, NegatedAndScaled) {
  const OccupancyGrid negated = load(with(kYaml, "negate: 0", "negate: 1"), kPgm);
  EXPECT_EQ(negated.cells(), (std::vector<Occupancy>{100, 100, 0, 0, 100, 100}));
  const OccupancyGrid scaled = load(std::string(kYaml) + "mode: scale\n", "P5 2 1 255\n\x80\xcc");
  // 127/255: 1 + 98 (0.49804 - 0.196) / 0.454 = 66.2; 51/255: 1 + 98 (0.2 - 0.196) / 0.454 = 1.86
  EXPECT_EQ(scaled.cells(), (std::vector<Occupancy>{66, 1}));
}

TEST_F(GridFile, RoundTripsTrinary) {
  const OccupancyGrid grid = random_cells({-1, 0, 100});
  save_grid(grid, folder_ / "home.yaml");
  EXPECT_EQ(load_grid(folder_ / "home.yaml"), grid);
  EXPECT_EQ(read_file(folder_ / "home.pgm").substr(0, 13), "P5\n23 17\n255\n");
  EXPECT_FALSE(std::filesystem::exists(folder_ / "home.pgm.partial"));
  EXPECT_FALSE(std::filesystem::exists(folder_ / "home.yaml.partial"));
}

TEST_F(GridFile, RoundTripsEveryPercentage) {
  std::vector<Occupancy> values;
  for (int percent = 0; percent <= 100; ++percent)
    values.push_back(static_cast<Occupancy>(percent));
  OccupancyGrid grid = random_cells(values);
  for (int n = 0; n <= 100; ++n) grid.set({n % 23, n / 23}, values[static_cast<std::size_t>(n)]);
  save_grid(grid, folder_ / "home.yaml");
  EXPECT_EQ(load_grid(folder_ / "home.yaml"), grid);
}

TEST_F(GridFile, RefusesToSaveWhatItCannotSay) {
  expect_error("unknown cells", [&] { save_grid(random_cells({-1, 50}), folder_ / "a.yaml"); });
  expect_error("a cell is 101", [&] { save_grid(random_cells({101}), folder_ / "a.yaml"); });
  expect_error("ending .yaml", [&] { save_grid(random_cells({0}), folder_ / "a.pgm"); });
  expect_error("cannot be written",
               [&] { save_grid(random_cells({0}), folder_ / "no" / "a.yaml"); });
  EXPECT_TRUE(std::filesystem::is_empty(folder_));
}

TEST_F(GridFile, RefusesWrongYaml) {
  refuses("resolution", with(kYaml, "0.05", "-0.05"));
  refuses("resolution", with(kYaml, "0.05", "fine"));
  refuses("'origin' is missing", with(kYaml, "origin: [-1.5, 2.25, 0.5]\n", ""));
  refuses("[x, y, yaw]", with(kYaml, ", 0.5]", "]"));
  refuses("origin", with(kYaml, "2.25", ".nan"));
  refuses("negate", with(kYaml, "negate: 0", "negate: 2"));
  refuses("give 0 to 1", with(kYaml, "0.65", "65"));
  refuses("below occupied_thresh", with(kYaml, "0.196", "0.7"));
  refuses("trinary or scale", std::string(kYaml) + "mode: raw\n");
  refuses("unknown key 'resolutoin'", std::string(kYaml) + "resolutoin: 1\n");
  refuses("stands twice", std::string(kYaml) + "negate: 0\n");
  refuses("absent.pgm", with(kYaml, "map.pgm", "absent.pgm"));
  refuses("map.yaml", "just text");
}

TEST_F(GridFile, RefusesWrongImages) {
  refuses("neither P5 nor P2", kYaml, "P6\n1 1\n255\n000");
  refuses("neither P5 nor P2", kYaml, "");
  refuses("no white space", kYaml, "P53 2 255\n");
  refuses("the width", kYaml, "P5\n0 2\n255\n");
  refuses("the height", kYaml, "P5\n3 two\n255\n");
  refuses("the width", kYaml, "P5\n99999999999 2\n255\n");
  refuses("maxval", kYaml, "P5\n1 1\n65535\n00");
  refuses("do not fit", kYaml, "P5\n100000 100000\n255\n0");
  refuses("holds 9 bytes of pixels where 5 x 2 are 10", kYaml, "P5\n5 2\n255\n123456789");
  refuses("holds 3 bytes", kYaml, "P5\n2 1\n255\n123");
  refuses("a pixel", kYaml, "P2\n3 1\n255\n0 256 0\n");
  refuses("a pixel is missing", kYaml, "P2\n3 1\n255\n0 0      \n");
  refuses("follows the pixels", kYaml, "P2\n3 1\n255\n0 0 0 0\n");
}

TEST_F(GridFile, EveryMutationIsReadOrRefusedInOneLine) {
  const std::string image = encode_pgm({3, 2, {0, 205, 254, 254, 254, 0}});
  for (const std::string& pgm : {image, std::string(kPgm)}) {
    const auto tally = mapscore::testing::read_mutations(
        pgm, 300, [&](const std::string& bytes) { static_cast<void>(load(kYaml, bytes)); });
    EXPECT_GT(tally.read, 0);
    EXPECT_GT(tally.refused, 100);
  }
  const auto tally = mapscore::testing::read_mutations(
      kYaml, 300, [&](const std::string& bytes) { static_cast<void>(load(bytes, image)); });
  EXPECT_GT(tally.read, 0);
  EXPECT_GT(tally.refused, 100);
}

}  // namespace
}  // namespace mapscore::eval
