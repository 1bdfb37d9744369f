// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#include "eval/report/figures/figures.hpp"
#include "eval/report/figures/gnuplot.hpp"
#include "tests/eval/report/figures/figure_files.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <opencv2/imgcodecs.hpp>

#include <filesystem>
#include <string>
#include <vector>

namespace mapscore::eval {
namespace {

namespace fs = std::filesystem;
using testing::block;
using testing::blocks;
using ::testing::ElementsAre;
using testing::FiguresTest;
using ::testing::HasSubstr;
using testing::kCamera;
using testing::kShift;
using testing::one_axis;
using testing::synthetic_study;
using testing::synthetic_summary;

// Erosion with astra (cell 1): cups 0.08 false at seed 0 and 0.09 at seed 1, 0.085 pooled, chairs
// 0.04 more; three bars of a group of 0.8: the middle one stands in the middle of its class.
TEST_F(FiguresTest, ClassesOverANamedAxisAreGroupedBars) {
  const StudySummary summary =
      synthetic_summary(synthetic_study({"direct", "erosion"}, {kCamera}, 2));
  const auto sheet = class_bars_figure(summary);
  ASSERT_TRUE(sheet);
  EXPECT_EQ(sheet->name, "by_class_by_preset");
  EXPECT_EQ(sheet->columns, 3);         // a score each
  EXPECT_EQ(sheet->panels.size(), 6u);  // a row a method
  EXPECT_EQ(blocks(sheet->data), 18);
  EXPECT_THAT(block(sheet->data, "# erosion; precision; depth camera = astra"),
              ElementsAre("0.0000 \"cup\" 0.915 0.91 0.92 0.94 1",
                          "1.0000 \"chair\" 0.875 0.87 0.88 0.9 0.96"));
  EXPECT_THAT(
      block(sheet->data, "# direct; recall; depth camera = ideal"),
      ElementsAre("-0.2667 \"cup\" 0.9 0.9 0.9 0.9 0.9", "0.7333 \"chair\" 0.8 0.8 0.8 0.8 0.8"));
  EXPECT_EQ(sheet->panels[3].y_label, "erosion");
  EXPECT_THAT(sheet->legend, ::testing::Contains(::testing::Field(&FigureKey::title, "kinect v1")));
  EXPECT_FALSE(class_figure(summary, StudyLayout(summary))) << "would show the same once more";
}

// A named axis may be any; the others stand at their middle: 20 mm and astra are cell 1 * 3 + 1.
TEST_F(FiguresTest, GroupedBarsStandAtTheMiddleOfTheOtherAxes) {
  const StudySummary summary = synthetic_summary(synthetic_study({"direct"}, {kShift, kCamera}, 1));
  const auto sheet = class_bars_figure(summary);
  ASSERT_TRUE(sheet);
  EXPECT_THAT(block(sheet->data, "# direct; precision; depth camera = astra").front(),
              ::testing::StartsWith("0.0000 \"cup\" 0.9 "));
  EXPECT_THAT(sheet->caption, HasSubstr("Bars by depth camera; misregistration = 20 mm; direct."));
  EXPECT_TRUE(class_figure(summary, StudyLayout(summary))) << "over the shift";
}

TEST_F(FiguresTest, GroupedBarsNeedNamesAndTwoClasses) {
  EXPECT_FALSE(class_bars_figure(one_axis()));
  StudySummary alone = synthetic_summary(synthetic_study({"direct"}, {kCamera}, 1));
  alone.table.classes[2].detect = false;
  EXPECT_FALSE(class_bars_figure(alone));
}

TEST_F(FiguresTest, ABarThatIsUndefinedIsMissing) {
  StudySummary summary = synthetic_summary(synthetic_study({"direct"}, {kCamera}, 1));
  ResultLine& astra = summary.trials[1];
  for (Counts* counts : {&astra.pooled, &astra.results[0].counts})
    (*counts)[1].predicted = (*counts)[1].true_predicted = 0;
  EXPECT_EQ(
      block(class_bars_figure(summary)->data, "# direct; precision; depth camera = astra").front(),
      "0.0000 \"cup\" - - - 0.98 1");
}

TEST_F(FiguresTest, NoLineIsDrawnBetweenNames) {
  const StudySummary summary =
      synthetic_summary(synthetic_study({"direct", "erosion"}, {kCamera}, 2));
  const FigureSheet sheet = accuracy_figure(summary, StudyLayout(summary));
  EXPECT_EQ(sheet.name, "accuracy_by_preset");
  for (const std::string& text : sheet.panels[0].elements)
    EXPECT_THAT(text, Not(HasSubstr("linespoints")));
  for (const FigureKey& key : sheet.legend)
    EXPECT_THAT(key.plotting, Not(HasSubstr("linespoints")));
  // Beside each other: two curves share a width of 0.7.
  EXPECT_EQ(
      sheet.panels[0].elements.end()[-2],
      "data index 0 using ($1-0.1750):2 with points pt 7 ps 1.2 lw 0.5 lc rgb '#0072B2' notitle");
  EXPECT_EQ(
      sheet.panels[0].elements.back(),
      "data index 1 using ($1+0.1750):2 with points pt 5 ps 1.2 lw 0.5 lc rgb '#D55E00' notitle");
}

TEST_F(FiguresTest, AllNamesHaveAPanelOverTheThreshold) {
  const SweepAxis detect{"detect", {"all", "[cup]", "[chair]", "[wall]", "[cup, chair]"}};
  const StudySummary summary = synthetic_summary(synthetic_study({"direct"}, {detect}, 1));
  EXPECT_EQ(precision_recall_figure(summary, StudyLayout(summary)).panels.size(), 5u);
}

TEST_F(FiguresTest, DrawsAStudyOverNames) {
  const SweepAxis source{"localization.source", {"truth", "particle_filter", "odometry"}};
  const std::vector<fs::path> files =
      draw_figures(synthetic_summary(synthetic_study({"direct", "erosion"}, {source}, 3)), folder_);
  ASSERT_EQ(files.size(), 15u);
  EXPECT_EQ(files[6].filename(), "by_class_by_source.png");
  const cv::Mat image = cv::imread(files[6].string());
  EXPECT_GE(image.cols, 1000);
  EXPECT_GT(cv::countNonZero(image.reshape(1) != 255), 5000);
}

TEST(NameTics, AreBrokenOrTurnedWhereTheyHaveNoRoom) {
  const NameTics flat = name_tics({"truth", "particle filter"}, 1.0);
  EXPECT_THAT(flat.setting, HasSubstr("('truth' 0, 'particle filter' 1) norotate"));
  const NameTics broken = name_tics({"truth", "particle filter"}, 0.5);
  EXPECT_THAT(broken.setting, HasSubstr("'particle'.\"\\n\".'filter' 1) norotate"));
  EXPECT_GT(broken.height_in, flat.height_in);
  const NameTics turned = name_tics({"washing_machine", "tv"}, 0.3);
  EXPECT_THAT(turned.setting, HasSubstr("rotate by 35 right"));
  EXPECT_GT(turned.height_in, broken.height_in);
}

}  // namespace
}  // namespace mapscore::eval
