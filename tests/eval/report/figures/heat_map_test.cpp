// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#include "eval/report/figures/figures.hpp"
#include "eval/report/figures/iso_lines.hpp"
#include "tests/eval/report/figures/figure_files.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <set>
#include <string>
#include <vector>

namespace mapscore::eval {
namespace {

using testing::block;
using testing::FiguresTest;
using ::testing::HasSubstr;
using testing::kCamera;
using testing::kShift;
using testing::kTurn;
using testing::synthetic_study;
using testing::synthetic_summary;

/// Values of f at the lines of an uneven grid.
DoseGrid grid_of(auto f) {
  DoseGrid grid{{0, 1, 4, 10}, {0, 2, 3}, {}};
  for (const double x : grid.x)
    for (const double y : grid.y) grid.values.emplace_back(f(x, y));
  return grid;
}

double length_of(const std::vector<IsoSegment>& line) {
  double length = 0.0;
  for (const auto& [from, to] : line) length += std::hypot(to[0] - from[0], to[1] - from[1]);
  return length;
}

// A plane's line x / 10 + y / 3 = 1 runs from corner to corner, of length sqrt(109).
TEST(IsoLine, OfAPlaneIsStraightAndWhole) {
  const DoseGrid grid = grid_of([](double x, double y) { return 1 - 0.05 * x - y / 6; });
  const std::vector<IsoSegment> line = iso_line(grid, 0.5);
  for (const auto& [from, to] : line)
    for (const auto& end : {from, to}) EXPECT_NEAR(end[0] / 10 + end[1] / 3, 1.0, 1e-12);
  EXPECT_NEAR(length_of(line), std::sqrt(109.0), 1e-9);
  EXPECT_TRUE(iso_line(grid, 1.1).empty());
  EXPECT_TRUE(iso_line(grid, -0.1).empty());
}

// Around a peak in one point the line closes: every end is the end of two pieces.
TEST(IsoLine, AroundAPeakIsClosed) {
  const DoseGrid grid = grid_of([](double x, double y) { return x == 4 && y == 2 ? 1.0 : 0.0; });
  std::multiset<std::array<long, 2>> ends;
  const std::vector<IsoSegment> line = iso_line(grid, 0.5);
  EXPECT_FALSE(line.empty());
  for (const auto& [from, to] : line)
    for (const auto& end : {from, to})
      ends.insert({std::lround(end[0] * 1e9), std::lround(end[1] * 1e9)});
  for (const auto& end : ends) EXPECT_EQ(ends.count(end), 2u);
}

TEST(IsoLine, LeavesCellsOutThatHoldSomethingUndefined) {
  DoseGrid grid = grid_of([](double x, double) { return x; });
  grid.values[0].reset();  // of the cell from (0, 0) to (1, 2)
  EXPECT_NEAR(length_of(iso_line(grid, 0.5)), 1.0, 1e-12) << "of 3";
  EXPECT_FALSE(grid.between(0.5, 0.5));
  EXPECT_NEAR(grid.between(0.5, 2.5).value(), 0.5, 1e-12);
  EXPECT_NEAR(grid.between(10, 3).value(), 10.0, 1e-12) << "at the very corner";
}

TEST(DoseGrid, IsBilinearInBetween) {
  const DoseGrid grid = grid_of([](double x, double y) { return 1 + 2 * x + 3 * y + x * y; });
  for (const auto& [x, y] : {std::pair{0.0, 0.0}, {0.3, 1.7}, {3.9, 2.9}, {4.0, 2.0}, {7.0, 0.1}})
    EXPECT_NEAR(grid.between(x, y).value(), 1 + 2 * x + 3 * y + x * y, 1e-12);
}

// Erosion at 20 mm and 0.5 deg is cell 4: cups 0.06 + 0.08 false, chairs 0.04 more: P = 0.84,
// R = 0.85, F = 2 P R / (P + R).
TEST_F(FiguresTest, TwoDosesMakeAHeatMapOfEachMethod) {
  const StudySummary summary =
      synthetic_summary(synthetic_study({"direct", "erosion"}, {kShift, kTurn}, 1));
  const auto sheet = heat_map_figure(summary, StudyLayout(summary));
  ASSERT_TRUE(sheet);
  ASSERT_EQ(sheet->panels.size(), 2u);
  EXPECT_EQ(sheet->panels[0].y_label, "misregistration angle (deg)");
  EXPECT_EQ(sheet->panels[1].x_label, "misregistration (mm)");
  const auto measured = block(sheet->data, "# erosion; measured");
  ASSERT_EQ(measured.size(), 6u);
  EXPECT_EQ(measured[4], "20 0.5 0.844970414");
  // F1 of all: 0.902 (direct, no dose) to 0.835: lines of 0.82 to 0.92, by 0.02.
  EXPECT_EQ(sheet->legend.front().title, "F1 = 0.82");
  EXPECT_EQ(sheet->legend.back().title, "F1 = 0.92");
  for (const std::string& line : block(sheet->data, "# direct; lines of equal f1")) {
    const std::string level = line.substr(line.rfind(' ') + 1);
    EXPECT_TRUE(level == "0.86" || level == "0.88" || level == "0.9") << line;
  }
}

TEST_F(FiguresTest, WithoutTwoDosesThereIsNoHeatMap) {
  for (const std::vector<SweepAxis>& sweep : std::vector<std::vector<SweepAxis>>{
           {}, {kShift}, {kShift, kCamera}, {kCamera, kShift}, {kShift, {kTurn.path, {"1"}}}}) {
    const StudySummary summary = synthetic_summary(synthetic_study({"direct"}, sweep, 1));
    EXPECT_FALSE(heat_map_figure(summary, StudyLayout(summary)));
  }
}

/// gnuplot draws it: falling doses, and a method whose figures are all undefined.
TEST_F(FiguresTest, AHeatMapOfNothingIsDrawnToo) {
  StudySummary summary = synthetic_summary(synthetic_study(
      {"direct", "erosion"}, {{kShift.path, {"0.02", "0"}}, {kTurn.path, {"2", "0"}}}, 1));
  for (ResultLine& line : summary.trials) {
    line.pooled = Counts(4);
    for (TrialResult& result : line.results) result.counts = Counts(4);
  }
  const auto sheet = heat_map_figure(summary, StudyLayout(summary));
  ASSERT_TRUE(sheet);
  EXPECT_EQ(block(sheet->data, "# direct; measured").front(), "0 0 -");
  EXPECT_EQ(draw(*sheet, folder_).size(), 3u);
}

// Of five angles three have room in a column, of which the causes show two; the heat map all.
TEST_F(FiguresTest, InPrintTheSecondAxisHasAsManyColumnsAsFit) {
  FigureStyle style;
  style.width_mm = 85.0;
  const SweepAxis turn{kTurn.path, {"0", "0.5", "1", "1.5", "2"}};
  const StudySummary summary =
      synthetic_summary(synthetic_study({"direct", "erosion"}, {kShift, turn}, 1));
  const StudyLayout layout(summary, style);
  ASSERT_EQ(layout.columns().size(), 3u);
  EXPECT_EQ(layout.columns()[1], "misregistration angle = 1 deg");
  EXPECT_EQ(layout.columns()[2], "misregistration angle = 2 deg");
  // Cell 1 * 5 + 4 = 9 of direct: cups 0.02 + 0.18 false, chairs 0.24.
  const FigureSheet sheet = accuracy_figure(summary, layout);
  EXPECT_THAT(block(sheet.data, "# direct; pooled precision; misregistration angle = 2 deg").back(),
              ::testing::StartsWith("20 0.78 "));
  EXPECT_THAT(sheet.caption, HasSubstr(" 3 of 5 values of misregistration angle."));
  const FigureSheet causes = causes_figure(summary, layout);
  EXPECT_EQ(causes.panels.size(), 8u);
  EXPECT_THAT(causes.caption, HasSubstr(" 2 of 5 values of misregistration angle."));
  const auto by_class = class_figure(summary, layout);
  ASSERT_TRUE(by_class);
  EXPECT_EQ(by_class->panels.size(), 2u);
  EXPECT_THAT(by_class->caption, HasSubstr(" At misregistration angle = 1 deg."));
  EXPECT_EQ(block(heat_map_figure(summary, layout)->data, "# direct; measured").size(), 10u);
  EXPECT_EQ(StudyLayout(summary).columns().size(), 5u);
}

TEST_F(FiguresTest, TitlesStandForNames) {
  StudySummary summary = testing::one_axis();
  summary.study.methods[1].title = "Erosion, 5 px";
  summary.study.class_titles["cup"] = "mug";
  const FigureSheet accuracy = accuracy_figure(summary, StudyLayout(summary));
  EXPECT_EQ(accuracy.legend[1].title, "Erosion, 5 px");
  EXPECT_THAT(accuracy.caption, HasSubstr("detected: mug, chair."));
  const auto by_class = class_figure(summary, StudyLayout(summary));
  EXPECT_EQ(by_class->panels[0].title, "mug");
  StudySummary bars = synthetic_summary(synthetic_study({"direct", "erosion"}, {}, 1));
  bars.study.methods[1].title = "Erosion, 5 px";
  const FigureSheet by_method = accuracy_figure(bars, StudyLayout(bars));
  EXPECT_THAT(block(by_method.data, "# Erosion, 5 px; pooled precision"),
              ::testing::ElementsAre(::testing::StartsWith("1 0.92 ")));
}

}  // namespace
}  // namespace mapscore::eval
