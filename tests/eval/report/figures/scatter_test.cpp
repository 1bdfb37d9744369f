// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#include "eval/report/figures/scatter.hpp"

#include "eval/report/figures/figures.hpp"
#include "eval/report/figures/gnuplot.hpp"
#include "tests/eval/report/figures/figure_files.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <set>
#include <string>
#include <vector>

namespace mapscore::eval {
namespace {

using testing::block;
using ::testing::ElementsAre;
using testing::FiguresTest;
using ::testing::HasSubstr;
using testing::kCamera;
using testing::kShift;
using testing::synthetic_study;
using testing::synthetic_summary;

StudySummary over_ranges(int points) {
  Study study = synthetic_study({"direct", "erosion"}, {kShift, kCamera}, 1);
  study.sampling = Sobol{points};
  return synthetic_summary(std::move(study));
}

TEST(RunningMean, OfNeighboursAlongX) {
  EXPECT_THAT(running_mean({{4, 8}, {1, 0}, {2, 4}, {3, 2}}, 3),
              ElementsAre(std::pair(2.0, 2.0), std::pair(3.0, 14.0 / 3)));
  EXPECT_TRUE(running_mean({{1, 0}, {2, 4}}, 3).empty());
}

// Cell c of direct: a share of 0.02 (1 + c) of the cups is false, and 0.04 more of the chairs.
// Sobol's shares of 20 mm: 0, 1/2, 3/4, 1/4, 3/8; of three cameras: 0, 1/2, 1/4, 3/4, 3/8.
TEST_F(FiguresTest, PointsOverRangesAreAScatterAPath) {
  const FigureSheet sheet = scatter_figure(over_ranges(5));
  EXPECT_EQ(sheet.name, "accuracy_over_ranges");
  EXPECT_EQ(sheet.columns, 3);
  ASSERT_EQ(sheet.panels.size(), 6u);  // precision, recall and F1 over each of two paths
  EXPECT_EQ(sheet.panels[0].x_label, "misregistration (mm)");
  EXPECT_THAT(block(sheet.data, "# precision magnitude_m; direct"),
              ElementsAre("0 0.96", "10 0.94", "15 0.92", "5 0.9", "7.5 0.88"));
  EXPECT_THAT(block(sheet.data, "# precision magnitude_m; direct; mean"), ElementsAre("7.5 0.92"));
  EXPECT_THAT(block(sheet.data, "# precision preset; direct"),
              ElementsAre("0 0.96", "1 0.94", "0 0.92", "2 0.9", "1 0.88"));
  EXPECT_THAT(block(sheet.data, "# precision preset; direct; mean"),
              ElementsAre("0 0.94", "1 0.91", "2 0.9"));
  EXPECT_THAT(sheet.caption, HasSubstr("Mean: of 5 neighbours"));
}

TEST_F(FiguresTest, ScattersTellEightMethodsApartByTheirTitles) {
  Study study = synthetic_study({"a", "b", "c", "d", "e", "f", "g", "h"}, {kShift}, 1);
  study.sampling = Sobol{5};
  study.methods[7].title = "eighth";
  const FigureSheet sheet = scatter_figure(synthetic_summary(std::move(study)));
  ASSERT_EQ(sheet.legend.size(), 8u);
  EXPECT_EQ(sheet.legend[7].title, "eighth");
  std::set<std::string> marks;
  for (const auto& [entry, title] : sheet.legend)
    marks.insert(entry.substr(entry.find("pt "), entry.find(" ps") - entry.find("pt ")));
  EXPECT_EQ(marks.size(), 8u);
}

TEST_F(FiguresTest, PointsOverRangesFitIntoPrint) {
  FigureStyle style;
  style.width_mm = 180;
  EXPECT_EQ(scatter_figure(over_ranges(5), style).columns, 3);
  style.width_mm = 85;
  const FigureSheet narrow = scatter_figure(over_ranges(5), style);
  EXPECT_EQ(narrow.columns, 1);
  ASSERT_EQ(narrow.panels.size(), 2u);
  EXPECT_EQ(narrow.panels[0].title, "F1");
}

TEST_F(FiguresTest, PointsOverRangesHaveThisFigureAlone) {
  const auto pictures = draw_figures(over_ranges(8), folder_);
  ASSERT_EQ(pictures.size(), 3u);
  for (const auto& picture : pictures) {
    EXPECT_EQ(picture.stem(), "accuracy_over_ranges");
    EXPECT_GT(std::filesystem::file_size(picture), 5000u);
  }
}

}  // namespace
}  // namespace mapscore::eval
