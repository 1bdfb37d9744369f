// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#include "eval/report/figures/figures.hpp"

#include "core/error.hpp"
#include "eval/report/figures/gnuplot.hpp"
#include "tests/eval/report/figures/figure_files.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <opencv2/imgcodecs.hpp>

#include <cstdlib>
#include <filesystem>
#include <fstream>
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
using testing::kDraws;
using testing::kShift;
using testing::kTurn;
using testing::one_axis;
using testing::synthetic_study;
using testing::synthetic_summary;
using testing::text_of;

constexpr std::size_t kSheets = 15;  // files that a study of one axis gets

// Erosion at 20 mm (cell 1): cups 0.06 + 0.02 = 0.08 false at seed 0 and 0.09 at seed 1, chairs
// 0.04 more: of 200 predicted 20 and 22 are false, so precision is 0.9, 0.89, and 0.895 pooled. Its
// ceilings: 16 and 4 of 200.
TEST_F(FiguresTest, DataHoldPooledValueSpreadAndCeilings) {
  const StudySummary summary = one_axis();
  const FigureSheet sheet = accuracy_figure(summary, StudyLayout(summary));
  EXPECT_EQ(sheet.name, "accuracy_by_dose");
  EXPECT_THAT(block(sheet.data, "# erosion; pooled precision"),
              ElementsAre("0 0.915 0.91 0.92 0.92 0.98", "20 0.895 0.89 0.9 0.92 0.98"));
  // 180 + 160 of 400 visible voxels are found.
  EXPECT_THAT(block(sheet.data, "# direct; pooled recall"),
              ElementsAre("0 0.85 0.85 0.85 0.85 0.85", "20 0.85 0.85 0.85 0.85 0.85"));
}

TEST_F(FiguresTest, DistanceScoresHaveNoRowWhereTheyWereNotScored) {
  const StudySummary summary = one_axis();
  const FigureSheet sheet = accuracy_figure(summary, StudyLayout(summary));
  EXPECT_EQ(sheet.panels.size(), 3u);
  EXPECT_THAT(sheet.data, Not(HasSubstr("2cm")));
}

TEST_F(FiguresTest, UndefinedFiguresAreMissing) {
  StudySummary summary = one_axis();
  for (ResultLine& line : summary.trials) {
    line.pooled = Counts(4);
    for (TrialResult& result : line.results) result.counts = Counts(4);
  }
  const FigureSheet sheet = accuracy_figure(summary, StudyLayout(summary));
  EXPECT_EQ(block(sheet.data, "# direct; pooled precision").front(), "0 - - - 0.96 0.98");
}

// Direct at 20 mm, one seed: cups 4 of 100 false (2 near, 1 leak, 1 floating), chairs 8 (4, 2, 2);
// cups miss 20 of 200 (10, 5, 5), chairs 40 (20, 10, 10).
TEST_F(FiguresTest, CausesAreSharesOfThePredictedAndOfTheVisible) {
  const StudySummary summary = one_axis(1);
  const FigureSheet sheet = causes_figure(summary, StudyLayout(summary));
  EXPECT_EQ(block(sheet.data, "# direct; false / predicted").back(), "\"20\" 0.03 0.015 0.015");
  EXPECT_EQ(block(sheet.data, "# direct; missed / visible").back(), "\"20\" 0.075 0.0375 0.0375");
}

TEST_F(FiguresTest, SecondAxisMakesColumnsAndThirdMakesCurves) {
  const StudySummary summary =
      synthetic_summary(synthetic_study({"direct"}, {kShift, kTurn, kDraws}, 1));
  const FigureSheet sheet = accuracy_figure(summary, StudyLayout(summary));
  EXPECT_EQ(sheet.columns, 3);
  EXPECT_EQ(sheet.panels.size(), 9u);
  EXPECT_EQ(blocks(sheet.data), 18);
  // Cells count draws fastest: 20 mm, 0.5 deg, N = 10 is cell (1 * 3 + 1) * 2 + 1 = 9; cups 0.02 +
  // 0.18 = 0.2 false, chairs 0.24: precision 0.78.
  EXPECT_THAT(
      block(sheet.data, "# direct, N = 10; pooled precision; misregistration angle = 0.5 deg")
          .back(),
      ::testing::StartsWith("20 0.78 "));
}

TEST_F(FiguresTest, WithoutASweepEveryMethodIsABar) {
  const StudySummary summary = synthetic_summary(synthetic_study({"direct", "erosion"}, {}, 1));
  const FigureSheet sheet = accuracy_figure(summary, StudyLayout(summary));
  EXPECT_EQ(sheet.name, "accuracy_by_method");
  EXPECT_THAT(block(sheet.data, "# erosion; pooled precision"),
              ElementsAre(::testing::StartsWith("1 0.92 ")));
}

TEST_F(FiguresTest, ClassesAreShownApart) {
  const StudySummary summary = one_axis(1);
  const auto sheet = class_figure(summary, StudyLayout(summary));
  ASSERT_TRUE(sheet);
  EXPECT_EQ(sheet->panels.size(), 2u);
  // Chairs at dose zero: precision 0.94, recall 0.8.
  EXPECT_THAT(block(sheet->data, "# direct; chair f1").front(),
              ::testing::StartsWith("0 0.864367816 "));
}

// Direct at 20 mm, one seed: of 2 * 100 predicted 4 + 8 are false; those at 0.5, the rest at 0.9.
TEST_F(FiguresTest, PrecisionAndRecallOverTheThreshold) {
  const StudySummary summary = one_axis(1);
  const FigureSheet sheet = precision_recall_figure(summary, StudyLayout(summary));
  EXPECT_EQ(sheet.panels.size(), 2u);
  EXPECT_EQ(sheet.panels[1].title, "misregistration = 20 mm");
  EXPECT_EQ(sheet.panels[1].elements.size(), 4u);  // two methods, a line and a mark each
  EXPECT_THAT(block(sheet.data, "# direct; misregistration = 20 mm; over the threshold"),
              ElementsAre("0.85 1 0.900", "0.85 0.94 0.500"));
  EXPECT_THAT(block(sheet.data, "# direct; misregistration = 20 mm; at the working threshold"),
              ElementsAre("0.85 0.94"));
}

TEST_F(FiguresTest, ReliabilityByBinsOfATenth) {
  const StudySummary summary = one_axis(1);
  const FigureSheet sheet = reliability_figure(summary, StudyLayout(summary));
  EXPECT_EQ(sheet.panels.size(), 4u);  // diagrams, and shares of voxels below
  EXPECT_EQ(blocks(sheet.data), 4);
  const auto bins = block(sheet.data, "# direct; misregistration = 20 mm; reliability");
  ASSERT_EQ(bins.size(), 10u);
  EXPECT_EQ(bins[5], "0.5 0.6 12 0.06 0.5 0");
  EXPECT_EQ(bins[8], "0.8 0.9 0 0 - -");
  EXPECT_EQ(bins[9], "0.9 1.0 188 0.94 0.9 1");
}

// The network of each trial is right in 3 of 4 pixels of which it says .95, of cups, chairs and
// background each.
TEST_F(FiguresTest, ReliabilityOfANetworksPixels) {
  StudySummary summary = one_axis(1);
  EXPECT_FALSE(pixel_reliability_figure(summary, StudyLayout(summary)));
  for (ResultLine& line : summary.trials)
    for (ClassCounts& counts : line.pooled) {
      counts.labels.emplace();
      counts.labels->pixels.add(0.95, true, 3);
      counts.labels->pixels.add(0.95, false, 1);
    }
  const auto sheet = pixel_reliability_figure(summary, StudyLayout(summary));
  ASSERT_TRUE(sheet);
  EXPECT_EQ(blocks(sheet->data), 2);  // one for all methods
  const auto bins = block(sheet->data, "# network; misregistration = 20 mm; reliability");
  ASSERT_EQ(bins.size(), 10u);
  EXPECT_EQ(bins[8], "0.8 0.9 0 0 - -");
  EXPECT_EQ(bins[9], "0.9 1.0 12 1 0.95 0.75");
}

TEST_F(FiguresTest, OfManyDosesTheLeastMiddleAndGreatestAreShownAtTheMiddleOfTheSecondAxis) {
  const SweepAxis shift{"faults.misregistration.magnitude_m",
                        {"0", "0.01", "0.02", "0.03", "0.04"}};
  const StudySummary summary = synthetic_summary(synthetic_study({"direct"}, {shift, kTurn}, 1));
  const FigureSheet sheet = precision_recall_figure(summary, StudyLayout(summary));
  ASSERT_EQ(sheet.panels.size(), 3u);
  EXPECT_EQ(sheet.panels[1].title, "misregistration = 20 mm");
  EXPECT_THAT(sheet.caption, HasSubstr(" At misregistration angle = 0.5 deg."));
  // Cell 2 * 3 + 1 = 7: cups 0.02 + 0.14 = 0.16 false, chairs 0.2.
  EXPECT_THAT(block(sheet.data, "# direct; misregistration = 20 mm; at the working threshold"),
              ElementsAre("0.85 0.82"));
}

TEST_F(FiguresTest, WithoutASweepAllMethodsShareAPanelOverTheThreshold) {
  const StudySummary summary = synthetic_summary(synthetic_study({"direct", "erosion"}, {}, 1));
  const FigureSheet sheet = precision_recall_figure(summary, StudyLayout(summary));
  ASSERT_EQ(sheet.panels.size(), 1u);
  EXPECT_EQ(sheet.panels[0].elements.size(), 4u);
  // Erosion: cups 0.06 false, chairs 0.1.
  EXPECT_THAT(block(sheet.data, "# erosion; at the working threshold"), ElementsAre("0.85 0.92"));
}

TEST_F(FiguresTest, DrawsPngPdfAndSvgWithScriptAndDataBeside) {
  const std::vector<fs::path> files = draw_figures(one_axis(), folder_);
  ASSERT_EQ(files.size(), kSheets);
  for (const fs::path& file : files) {
    SCOPED_TRACE(file.string());
    const std::string bytes = text_of(file);
    if (file.extension() == ".pdf") {
      EXPECT_EQ(bytes.substr(0, 5), "%PDF-");
      EXPECT_GT(bytes.size(), 5000u);
    } else if (file.extension() == ".svg") {
      EXPECT_THAT(bytes, HasSubstr("<svg"));
      EXPECT_THAT(bytes, ::testing::EndsWith("</svg>\n\n"));
    } else {
      const cv::Mat image = cv::imread(file.string());
      EXPECT_GE(image.cols, 1000);
      EXPECT_GE(image.rows, 350);
      EXPECT_GT(cv::countNonZero(image.reshape(1) != 255), 5000);
    }
    EXPECT_TRUE(fs::exists(fs::path(file).replace_extension(".gp")));
    EXPECT_TRUE(fs::exists(fs::path(file).replace_extension(".dat")));
  }
  for (const auto& entry : fs::directory_iterator(folder_))
    EXPECT_NE(entry.path().extension(), ".partial");
}

TEST_F(FiguresTest, SameStudySameDataAndScript) {
  const StudySummary summary = one_axis();
  for (const char* run : {"a", "b"}) static_cast<void>(draw_figures(summary, folder_ / run));
  for (const char* file : {"accuracy_by_dose.gp", "accuracy_by_dose.dat", "accuracy_by_dose.png",
                           "accuracy_by_dose.svg"})
    EXPECT_EQ(text_of(folder_ / "a" / file), text_of(folder_ / "b" / file)) << file;
}

TEST_F(FiguresTest, NamesWithQuotesAreDrawn) {
  StudySummary summary = one_axis(1);
  summary.study.name = R"(a "study"\n of 'quotes')";
  EXPECT_EQ(draw_figures(summary, folder_).size(), kSheets);
}

TEST_F(FiguresTest, NoNameRunsAnything) {
  const std::string marker = (folder_ / "ran").string();
  fs::create_directories(folder_);
  StudySummary summary = one_axis(1);
  summary.study.name = "`touch " + marker + "` $(touch " + marker + ") @x %s";
  summary.table.classes[1].name = "`touch " + marker + "` 100%";
  summary.table.classes[2].name = "'.system('touch " + marker + "').'' it's ''";
  EXPECT_EQ(draw_figures(summary, folder_).size(), kSheets);
  for (const auto& entry : fs::directory_iterator(folder_))
    if (entry.path().extension() == ".gp") run_gnuplot(folder_, entry.path().filename().string());
  EXPECT_FALSE(fs::exists(marker));
}

TEST_F(FiguresTest, MethodsThatMapNothingAreDrawnAndNamed) {
  for (const StudySummary& like :
       {one_axis(1), synthetic_summary(synthetic_study({"direct", "erosion"}, {}, 1)),
        synthetic_summary(synthetic_study({"direct"}, {kShift, kTurn}, 1))}) {
    StudySummary summary = like;
    Counts nothing(4);
    nothing[1].visible = nothing[2].visible = 200;
    for (ResultLine& line : summary.trials) {
      if (line.method != "direct") continue;
      line.pooled = nothing;
      for (TrialResult& result : line.results) result.counts = nothing;
    }
    EXPECT_GE(draw_figures(summary, folder_).size(), 12u);
    const FigureSheet sheet = accuracy_figure(summary, StudyLayout(summary));
    EXPECT_THAT(sheet.caption, HasSubstr(" direct maps nothing."));
  }
}

TEST_F(FiguresTest, WhereNothingIsVisibleNoMethodIsBlamed) {
  StudySummary summary = one_axis(1);
  for (auto* lines : {&summary.trials, &summary.registration_ceilings, &summary.lattice_ceilings})
    for (ResultLine& line : *lines) {
      line.pooled = Counts(4);
      for (TrialResult& result : line.results) result.counts = Counts(4);
    }
  const std::string caption = accuracy_figure(summary, StudyLayout(summary)).caption;
  EXPECT_THAT(caption, HasSubstr("Note: no truth voxel of a detected class was visible"));
  EXPECT_THAT(caption, Not(HasSubstr("maps nothing")));
  EXPECT_FALSE(draw_figures(summary, folder_).empty());
}

TEST_F(FiguresTest, ALowLatticeCeilingIsSaidBelow) {
  StudySummary summary = one_axis(1);
  EXPECT_THAT(accuracy_figure(summary, StudyLayout(summary)).caption,
              HasSubstr("Note: the lattice ceiling falls to a precision of 0.980"));
  for (ResultLine& line : summary.lattice_ceilings) {
    line.pooled[1] = testing::synthetic_counts(0.0, 0.0);
    line.pooled[2] = testing::synthetic_counts(0.02, 0.02);
  }
  EXPECT_THAT(accuracy_figure(summary, StudyLayout(summary)).caption,
              ::testing::Not(HasSubstr("Note:")));
}

TEST_F(FiguresTest, APictureThatIsCutShortIsRefusedAndNothingLeft) {
  fs::create_directories(folder_);
  const StudySummary summary = one_axis(1);
  FigureSheet sheet = accuracy_figure(summary, StudyLayout(summary));
  sheet.panels.front().settings.push_back("set output '/dev/null'; set multiplot");
  EXPECT_THROW(static_cast<void>(draw(sheet, folder_)), Error);
  EXPECT_TRUE(fs::is_empty(folder_));
}

TEST_F(FiguresTest, AFailingScriptSaysWhy) {
  fs::create_directories(folder_);
  std::ofstream(folder_ / "wrong.gp") << "plot nonsense(\n";
  try {
    run_gnuplot(folder_, "wrong.gp");
    FAIL() << "no error";
  } catch (const Error& error) {
    EXPECT_THAT(error.what(), HasSubstr("wrong.gp: gnuplot failed: "));
    EXPECT_THAT(error.what(), Not(HasSubstr("\n")));
  }
}

TEST_F(FiguresTest, AMissingGnuplotSaysHowToMendIt) {
  fs::create_directories(folder_);
  const std::string path = std::getenv("PATH");
  setenv("PATH", folder_.c_str(), 1);
  std::string what;
  try {
    run_gnuplot(folder_, "any.gp");
  } catch (const Error& error) {
    what = error.what();
  }
  setenv("PATH", path.c_str(), 1);
  EXPECT_EQ(what, "gnuplot: not found; install gnuplot-nox");
}

TEST_F(FiguresTest, TheTableHasPooledAndMacroScores) {
  const std::string text = text_of(write_table(one_axis(), folder_));
  EXPECT_THAT(text, HasSubstr("# synthetic: pooled classes; detected: cup, chair"));
  EXPECT_THAT(text, HasSubstr("# synthetic: macro classes; detected: cup, chair"));
}

TEST(FigureAxis, KnownLeavesAreShownInTheUnitsOfPeople) {
  const FigureAxis axis = figure_axis(Study{}, kShift);
  EXPECT_EQ(axis.title(), "misregistration (mm)");
  EXPECT_EQ(axis.text(1), "misregistration = 20 mm");
  EXPECT_THAT(axis.at, ElementsAre(0.0, 20.0));
}

TEST(FigureAxis, OtherLeavesGoByTheirLastPart) {
  Study study;
  study.methods = {{"erosion", Erosion{}}};
  const FigureAxis axis =
      figure_axis(study, {"methods.erosion.segmentation.erosion.radius_px", {"2", "5"}});
  EXPECT_EQ(axis.title(), "radius_px");
  EXPECT_TRUE(axis.numeric);
}

TEST(FigureAxis, NamesAreWrittenAsPeopleDo) {
  const FigureAxis axis =
      figure_axis(Study{}, {"localization.source", {"truth", "particle_filter"}});
  EXPECT_EQ(axis.text(1), "pose source = particle filter");
  EXPECT_EQ(axis.key, "source");
}

TEST(FigureAxis, FilesGoByTheirNamesWhereTheseTellThemApart) {
  const std::string path = "perception.network.model";
  Study study;
  study.perception = NetworkPerception{};
  study.sweep = {{path, {"../a/fcn_13_0.onnx", "../a/rgb_d_13_0.onnx"}}};
  EXPECT_THAT(figure_axis(study, study.sweep[0]).values, ElementsAre("fcn", "rgb d"));
  EXPECT_THAT(figure_axis(study, {path, {"../a/fcn_13_0.onnx"}}).values, ElementsAre("fcn"));
  EXPECT_THAT(figure_axis(Study(study), {"faults.labels.preset", {"x_0", "y_0"}}).values,
              ElementsAre("x 0", "y 0"));
  study.sweep = {{path, {"a/fcn_0.onnx"}}};
  EXPECT_THAT(figure_axis(study, study.sweep[0]).values, ElementsAre("fcn 0"));
  study.sweep = {{path, {"a/fcn.onnx", "b/fcn.onnx"}}};
  EXPECT_THAT(figure_axis(study, {path, {"b/fcn.onnx"}}).values, ElementsAre("b/fcn.onnx"));
}

TEST(FigureAxis, TextsStandSideBySide) {
  const FigureAxis axis = figure_axis(Study{}, {"detect", {"all", "[cup]"}});
  EXPECT_FALSE(axis.numeric);
  EXPECT_THAT(axis.at, ElementsAre(0.0, 1.0));
}

}  // namespace
}  // namespace mapscore::eval
