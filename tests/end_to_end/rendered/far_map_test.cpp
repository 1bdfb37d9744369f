// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#include "tests/end_to_end/program.hpp"
#include "tests/support/tiny_recording.hpp"

#include <fmt/format.h>
#include <gmock/gmock.h>

#include <fstream>

namespace mapscore::testing {
namespace {

using ::testing::HasSubstr;

/// Where the map lies its voxels have no indices, so that it has no score before.
TEST(FarMap, InTheCoordinatesOfACountryIsAligned) {
  const TemporaryFolder folder;
  const std::string scene = MAPSCORE_SOURCE_DIR "/tests/data/shapes_room.xml";
  const std::string truth = folder.path() / "truth.csv", map = folder.path() / "map.csv";
  expect_done(mapscore({"truth", scene, "-o", truth}));
  std::ifstream voxels(truth);
  std::ofstream points(map);
  std::string line;
  std::getline(voxels, line);  // the head
  points << "x,y,z\n";
  for (int i = 0, j = 0, k = 0; std::getline(voxels, line);) {
    ASSERT_EQ(std::sscanf(line.c_str(), "%d,%d,%d", &i, &j, &k), 3);
    points << fmt::format("{:.3f},{:.3f},{:.3f}\n", 0.05 * i + 3512345.678, 0.05 * j + 5398765.432,
                          0.05 * k);
  }
  points.close();
  const Outcome aligned = mapscore({"score", map, "--align", "--truth", scene});
  expect_done(aligned);
  EXPECT_THAT(aligned.out, HasSubstr(": F1 - -> 1.000, "));
  expect_refused(mapscore({"score", map, "--truth", scene}), {"--scale", "--transform"});
}

}  // namespace
}  // namespace mapscore::testing
