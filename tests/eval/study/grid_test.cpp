// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#include "eval/study/grid.hpp"

#include "core/error.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <set>
#include <string>
#include <tuple>
#include <variant>

namespace mapscore::eval {
namespace {

using ::testing::ElementsAre;
using ::testing::IsEmpty;
using ::testing::Pair;

Study study_with(const std::string& sweep) {
  return parse_study(
      "recording: somewhere\nseeds: 3\n"
      "methods:\n"
      "  direct: {segmentation: {direct: {}}}\n"
      "  erosion: {segmentation: {erosion: {radius_px: 5}}}\n" +
          sweep,
      "demo.yaml");
}

Study two_axes() {
  return study_with(
      "sweep:\n"
      "  faults.misregistration.magnitude_m: [0, 0.010]\n"
      "  methods.erosion.segmentation.erosion.radius_px: [2, 5, 8]\n");
}

TEST(Grid, WithoutASweepHasOneCellWithoutDoses) {
  const auto grid = cells(study_with(""));
  ASSERT_EQ(grid.size(), 1u);
  EXPECT_EQ(grid[0].index, 0);
  EXPECT_THAT(grid[0].doses, IsEmpty());
  EXPECT_EQ(text_of(grid[0]), "");
}

TEST(Grid, IsTheProductWithTheLastPathFastest) {
  const auto grid = cells(two_axes());
  ASSERT_EQ(grid.size(), 6u);
  for (int i = 0; i < 6; ++i) EXPECT_EQ(grid[static_cast<std::size_t>(i)].index, i);
  EXPECT_EQ(text_of(grid[1]),
            "faults.misregistration.magnitude_m = 0, "
            "methods.erosion.segmentation.erosion.radius_px = 5");
  EXPECT_THAT(grid[3].doses,
              ElementsAre(Pair("faults.misregistration.magnitude_m", "0.01"),
                          Pair("methods.erosion.segmentation.erosion.radius_px", "2")));
}

TEST(Grid, AppliesTheDosesOfACell) {
  const Study study = two_axes();
  const Study resolved = resolve(study, cells(study)[5]);
  Study expected = study;
  expected.sweep.clear();
  expected.faults.misregistration.rigid.magnitude_m = 0.01;
  expected.methods[1].segmentation = Erosion{8};
  EXPECT_EQ(resolved, expected);
}

TEST(Grid, ARefusedDoseNamesItsPath) {
  const Study study = study_with("");
  try {
    (void)resolve(study, Cell{0, {{"voxel_m", "-1"}}});
    FAIL() << "a negative edge was taken";
  } catch (const Error& error) {
    EXPECT_STREQ(error.what(), "voxel_m: -1 is out of range; write a number above 0, up to 10");
  }
}

TEST(Trials, HoldEachMethodCellAndSeedOnce) {
  const Study study = two_axes();
  const auto all = trials(study);
  ASSERT_EQ(all.size(), 2u * 6u * 3u);
  std::set<std::tuple<std::string, int, int>> distinct;
  for (std::size_t i = 0; i < all.size(); ++i) {
    EXPECT_EQ(all[i].index, static_cast<int>(i));
    distinct.emplace(all[i].method, all[i].cell.index, all[i].seed_index);
    EXPECT_EQ(all[i].cell, cells(study)[static_cast<std::size_t>(all[i].cell.index)]);
  }
  EXPECT_EQ(distinct.size(), all.size());
}

TEST(Trials, ComeInTurnAsTheyAreCounted) {
  const auto all = trials(two_axes());
  std::size_t position = 0;
  for (const TrialSpec& spec : all) EXPECT_EQ(spec, all[position++]);
  EXPECT_EQ(position, all.size());
}

TEST(Trials, VaryMethodsFastestThenSeeds) {
  const auto all = trials(two_axes());
  EXPECT_EQ(all[0].method, "direct");
  EXPECT_EQ(all[1].method, "erosion");
  EXPECT_EQ(all[1].seed_index, 0);
  EXPECT_EQ(all[2].seed_index, 1);
  EXPECT_EQ(all[5].cell.index, 0);
  EXPECT_EQ(all[6].cell.index, 1);
}

TEST(Check, CoversStudiesMadeInCode) {
  Study study = study_with("");
  study.sweep = {{"voxel_m", {"0.05", "0"}}};
  EXPECT_THROW(check(study), Error);
  study.sweep = {{"voxel_m", {}}};
  EXPECT_THROW(check(study), Error);
  study.sweep = {{"voxel_m", {"0.05", "0.1"}}};
  EXPECT_NO_THROW(check(study));
  study.methods.clear();
  EXPECT_THROW(check(study), Error);
}

}  // namespace
}  // namespace mapscore::eval
