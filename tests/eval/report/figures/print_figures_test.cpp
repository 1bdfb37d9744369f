// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#include "core/error.hpp"
#include "eval/report/figures/figures.hpp"
#include "eval/report/figures/font.hpp"
#include "eval/report/figures/geometry.hpp"
#include "eval/report/figures/tolerance_figure.hpp"
#include "tests/eval/report/figures/figure_files.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <opencv2/imgcodecs.hpp>

#include <cmath>
#include <limits>
#include <regex>
#include <set>
#include <string>
#include <vector>

namespace mapscore::eval {
namespace {

namespace fs = std::filesystem;
using ::testing::ElementsAre;
using testing::FiguresTest;
using ::testing::HasSubstr;
using testing::kDraws;
using testing::kShift;
using testing::kTurn;
using ::testing::Not;
using testing::one_axis;
using testing::synthetic_study;
using testing::synthetic_summary;
using testing::text_of;

FigureStyle column_style() {
  FigureStyle style;
  style.width_mm = 85.0;
  return style;
}

/// A figure of each layout: over numbers, with two axes, over names, over methods.
std::vector<StudySummary> layouts() {
  return {one_axis(), synthetic_summary(synthetic_study({"direct", "erosion"}, {kShift, kTurn}, 2)),
          synthetic_summary(synthetic_study({"direct", "erosion"}, {testing::kCamera}, 2)),
          synthetic_summary(synthetic_study({"direct", "erosion"}, {}, 1))};
}

TEST_F(FiguresTest, InPrintEveryFigureIsAsWideAsAskedAndNoTextBelowSevenPoints) {
  const std::regex font("font '[^',]*,([0-9.]+)'");
  for (const StudySummary& summary : layouts()) {
    fs::remove_all(folder_);
    for (const fs::path& file : draw_figures(summary, folder_, column_style())) {
      SCOPED_TRACE(file.string());
      if (file.extension() == ".png") {
        EXPECT_NEAR(cv::imread(file.string()).cols, 85.0 / 25.4 * 300.0, 1.0);
      }
      const std::string script = text_of(fs::path(file).replace_extension(".gp"));
      std::sregex_iterator found(script.begin(), script.end(), font);
      EXPECT_NE(found, std::sregex_iterator());
      for (; found != std::sregex_iterator(); ++found) EXPECT_GE(std::stod((*found)[1]), 7.0);
    }
  }
}

TEST_F(FiguresTest, InPrintEveryPanelKeepsItsPlaceUnderItsTitleAndBesideItsAxis) {
  const StudySummary summary =
      synthetic_summary(synthetic_study({"direct", "erosion"}, {kShift, testing::kCamera}, 1));
  FigureStyle narrow;
  narrow.width_mm = 60.0;
  const FigureSheet sheet = accuracy_figure(summary, StudyLayout(summary, narrow));
  ASSERT_EQ(sheet.columns, 3);
  ASSERT_EQ(sheet.panels.size(), 9u);  // rows of precision, recall, F1
  const FigureSheet print = arranged(sheet);
  ASSERT_EQ(print.columns, 2);
  ASSERT_EQ(print.panels.size(), 12u);
  const auto shows = [&](std::size_t place, std::size_t source) {
    EXPECT_EQ(print.panels[place].elements, sheet.panels[source].elements) << place;
  };
  for (const std::size_t row : {0, 1, 2}) {
    shows(2 * row, 3 * row);
    shows(2 * row + 1, 3 * row + 1);
    shows(6 + 2 * row, 3 * row + 2);
    EXPECT_TRUE(print.panels[7 + 2 * row].elements.empty());
    EXPECT_EQ(print.panels[2 * row].y_label, sheet.panels[3 * row].y_label);
    EXPECT_EQ(print.panels[6 + 2 * row].y_label, sheet.panels[3 * row].y_label);
    EXPECT_TRUE(print.panels[6 + 2 * row].y_tic_labels);
    EXPECT_FALSE(print.panels[1 + 2 * row].y_tic_labels);
  }
  EXPECT_EQ(print.panels[6].title, "depth camera =\nkinect v1");
  for (std::size_t i = 0; i < print.panels.size(); ++i)
    EXPECT_EQ(print.panels[i].x_label, i == 5 || i == 10 ? "misregistratio\nn (mm)" : "") << i;
}

/// A broad line about a small filled mark cuts its corners in a PDF.
TEST_F(FiguresTest, MarksHaveThinLinesAndNumbersNoRoomForASign) {
  const std::regex mark("with points pt (?:[4-9]|1[0-5]) ps [0-9.]+ ([^,]*)");
  for (const StudySummary& summary : layouts()) {
    fs::remove_all(folder_);
    for (const fs::path& file : draw_figures(summary, folder_, column_style())) {
      const std::string script = text_of(fs::path(file).replace_extension(".gp"));
      EXPECT_THAT(script, HasSubstr("set format x '%g'")) << file;
      for (std::sregex_iterator at(script.begin(), script.end(), mark), end; at != end; ++at)
        EXPECT_THAT((*at)[1].str(), HasSubstr("lw 0.5 ")) << file;
    }
  }
}

/// Shares end at 1: only a label inside reaches above, and neither axis nor tics with it.
TEST_F(FiguresTest, TheAxisOfCausesEndsAtOne) {
  const std::regex range(
      "set yrange \\[0:([0-9.]+)\\]; set ytics 0,0.2,1(; set border 1; set arrow)?");
  for (StudySummary summary : layouts()) {
    for (ResultLine& line : summary.trials)
      for (ClassCounts& of_class : line.pooled) of_class = testing::synthetic_counts(1.0, 1.0);
    const bool labelled = summary.study.sweep.size() > 1;
    const FigureSheet sheet = causes_figure(summary, StudyLayout(summary, column_style()));
    for (const Panel& panel : sheet.panels) {
      std::smatch found;
      ASSERT_TRUE(std::regex_search(panel.settings.back(), found, range));
      EXPECT_EQ(std::stod(found[1]) > 1.0, labelled);
      EXPECT_EQ(found[2].length() > 0, labelled);
    }
  }
}

TEST_F(FiguresTest, WithoutAWidthNothingIsArranged) {
  const StudySummary summary = one_axis();
  const FigureSheet sheet = accuracy_figure(summary, StudyLayout(summary));
  EXPECT_EQ(arranged(sheet).panels.size(), sheet.panels.size());
  EXPECT_EQ(arranged(sheet).panel_width_in, sheet.panel_width_in);
  EXPECT_EQ(sheet.panel_width_in, 6.6 / 3);
}

TEST_F(FiguresTest, GreyFiguresHaveNoColour) {
  FigureStyle style;
  style.grey = true;
  const std::regex colour("#([0-9A-F]{2})([0-9A-F]{2})([0-9A-F]{2})");
  for (const StudySummary& summary : layouts()) {
    fs::remove_all(folder_);
    for (const fs::path& file : draw_figures(summary, folder_, style)) {
      SCOPED_TRACE(file.string());
      const std::string script = text_of(fs::path(file).replace_extension(".gp"));
      for (std::sregex_iterator at(script.begin(), script.end(), colour), end; at != end; ++at)
        EXPECT_TRUE((*at)[1] == (*at)[2] && (*at)[2] == (*at)[3]) << at->str();
      if (file.extension() != ".png") continue;
      cv::Mat channels[3];
      cv::split(cv::imread(file.string()), channels);
      EXPECT_EQ(cv::norm(channels[0], channels[2], cv::NORM_INF), 0.0);
      EXPECT_EQ(cv::norm(channels[0], channels[1], cv::NORM_INF), 0.0);
    }
  }
}

TEST_F(FiguresTest, WithoutColoursEightCurvesDifferInLineAndInMark) {
  FigureStyle style;
  style.grey = true;
  const SweepAxis draws{"fusion.blend.N", {"1", "10", "20", "30"}};
  const StudyLayout layout(
      synthetic_summary(synthetic_study({"direct", "erosion"}, {kShift, kTurn, draws}, 1)), style);
  ASSERT_EQ(layout.curves().size(), 8u);
  std::set<std::string> dashes, fills;
  std::set<int> marks;
  for (const Curve& curve : layout.curves()) {
    dashes.insert(curve.dash);
    marks.insert(curve.point);
    fills.insert(bar_fill(fills.size(), style));
  }
  EXPECT_EQ(dashes.size(), 8u);
  EXPECT_EQ(marks.size(), 8u);
  EXPECT_EQ(fills.size(), 8u);
}

TEST_F(FiguresTest, GreyIsTheLumaOfInksAlone) {
  EXPECT_EQ(greyed("lc rgb '#0072B2' pt 7"), "lc rgb '#575757' pt 7");  // 0.587*114 + 0.114*178
  EXPECT_EQ(greyed("title 'of #0072B2'"), "title 'of #0072B2'");
  EXPECT_EQ(greyed("rgb '#FFFFFF' rgb '#FF0000'"), "rgb '#FFFFFF' rgb '#4C4C4C'");
}

TEST_F(FiguresTest, TheCaptionCanBeLeftOut) {
  FigureStyle style;
  style.caption = false;
  const StudySummary summary = one_axis();
  static_cast<void>(draw_figures(summary, folder_ / "with"));
  static_cast<void>(draw_figures(summary, folder_ / "without", style));
  EXPECT_THAT(text_of(folder_ / "with/accuracy_by_dose.gp"), HasSubstr("Lattice ceiling: true"));
  EXPECT_THAT(text_of(folder_ / "without/accuracy_by_dose.gp"),
              Not(HasSubstr("Lattice ceiling: true")));
  EXPECT_LT(cv::imread(folder_ / "without/accuracy_by_dose.png").rows,
            cv::imread(folder_ / "with/accuracy_by_dose.png").rows);
}

TEST_F(FiguresTest, TheSvgHasItsWidthFontAndTextsAsTexts) {
  FigureStyle style = column_style();
  style.font = "Nimbus Sans";
  StudySummary summary = one_axis();
  summary.table.classes[1].name = "<script>x</script>&";
  static_cast<void>(draw_figures(summary, folder_, style));
  const std::string svg = text_of(folder_ / "by_class_by_dose.svg");
  EXPECT_THAT(svg, HasSubstr("width=\"321\""));  // 85 mm at 96 dots per inch
  EXPECT_THAT(svg, HasSubstr("font-family=\"Nimbus Sans\""));
  EXPECT_THAT(svg, HasSubstr("font-size=\"10.67\""));  // 8 pt
  EXPECT_THAT(svg, HasSubstr("&lt;script>x&lt;/script>&amp;"));
  EXPECT_THAT(svg, Not(HasSubstr("<script>")));
}

std::string refusal(const FigureStyle& style) {
  try {
    style.check();
  } catch (const Error& error) {
    return error.what();
  }
  return "";
}

TEST(FigureStyle, WidthsThatNoFigureFitsAreRefused) {
  for (const double width_mm :
       {0.0, -85.0, 59.0, 401.0, std::nan(""), std::numeric_limits<double>::infinity()}) {
    FigureStyle style;
    style.width_mm = width_mm;
    EXPECT_THAT(refusal(style), HasSubstr("must be from 60 to 400; a column is about 85"));
  }
  for (const double width_mm : {60.0, 85.0, 400.0}) {
    FigureStyle style;
    style.width_mm = width_mm;
    EXPECT_EQ(refusal(style), "");
  }
}

TEST(FigureStyle, AFontThatIsNotInstalledIsFoundOut) {
  EXPECT_EQ(substitute_font("DejaVu Sans"), std::nullopt);
  EXPECT_EQ(substitute_font("dejavu sans"), std::nullopt);
  EXPECT_TRUE(substitute_font("No-Such Font 7"));
}

ToleranceRow tolerance_row(const char* path, const char* method) {
  ToleranceRow made{path, figure_axis(field_of(Study{}, path), {"1"}), {}, method, "pooled", {}, {},
                    {}};
  made.search = {0.0, 0.04, 0.8, 42};
  made.trials = {{0.0, 0.9}, {0.04, 0.5}};
  made.tolerance.low = 0.01;
  made.tolerance.high = 0.02;
  return made;
}

TEST(ToleranceFigure, IsTitledByWhatTellsItsPanelsApart) {
  const auto titles = [](const std::vector<ToleranceRow>& rows) {
    std::vector<std::string> all;
    for (const Panel& panel : tolerance_figure({}, {}, rows).panels) all.push_back(panel.title);
    return all;
  };
  const ToleranceRow shift = tolerance_row("faults.misregistration.magnitude_m", "a");
  const ToleranceRow mount = tolerance_row("faults.mount.magnitude_m", "a");
  ToleranceRow chairs = shift;
  chairs.group = "chair";
  EXPECT_THAT(titles({shift}), ElementsAre(""));
  EXPECT_THAT(titles({shift, mount}), ElementsAre("misregistration", "mount error"));
  EXPECT_THAT(titles({shift, chairs}), ElementsAre("pooled", "chair"));
  EXPECT_THAT(
      titles({shift, chairs, mount}),
      ElementsAre("misregistration, pooled", "misregistration, chair", "mount error, pooled"));
}

TEST(ToleranceFigure, InGreyTheBandsOfMethodsDiffer) {
  FigureStyle style;
  style.grey = true;
  std::set<std::string> fills;
  for (std::size_t n = 0; n < 6; ++n) fills.insert(band_fill(n, grey_tone(n), style));
  EXPECT_EQ(fills.size(), 6u);
  const FigureSheet sheet = tolerance_figure({}, {},
                                             {tolerance_row("faults.mount.magnitude_m", "a"),
                                              tolerance_row("faults.mount.magnitude_m", "b")},
                                             style);
  ASSERT_EQ(sheet.panels.size(), 1u);
  for (const std::size_t n : {0, 1})
    EXPECT_THAT(sheet.panels[0].settings,
                ::testing::Contains(::testing::EndsWith(band_fill(n, "", style))));
}

TEST(ToleranceFigure, ABandThatIsOpenReachesToTheEndOfTheRange) {
  using enum ToleranceVerdict;
  ToleranceRow row = tolerance_row("faults.mount.magnitude_m", "a");
  const auto band = [&](ToleranceVerdict verdict, std::optional<double> low,
                        std::optional<double> high) -> std::string {
    row.tolerance.verdict = verdict;
    row.tolerance.low = low;
    row.tolerance.high = high;
    const FigureSheet sheet = tolerance_figure({}, {}, {row});
    for (const std::string& setting : sheet.panels[0].settings)
      if (setting.starts_with("set object")) return setting;
    return "";
  };
  EXPECT_THAT(band(found, 0.01, 0.02), HasSubstr("from first 10, graph 0 to first 20, graph 1"));
  EXPECT_THAT(band(found, std::nullopt, 0.02), HasSubstr("from first 0, graph 0 to first 20,"));
  EXPECT_THAT(band(open, 0.01, std::nullopt), HasSubstr("from first 10, graph 0 to first 40,"));
  EXPECT_EQ(band(above, 0.04, std::nullopt), "");
  EXPECT_EQ(band(not_monotone, 0.01, 0.02), "") << "no interval stands in the table either";
  EXPECT_THAT(tolerance_figure({}, {}, {row}).caption, HasSubstr("end of the range where it is"));
}

/// Each fault its own axis, named below its panel in print too.
TEST_F(FiguresTest, InPrintEachPanelOfATolerancesFigureKeepsItsAxis) {
  FigureStyle style = column_style();
  style.grey = true;
  std::vector<ToleranceRow> rows;
  for (const char* method : {"a", "b"})
    for (const char* path : {"faults.misregistration.magnitude_m", "faults.mount.magnitude_m",
                             "faults.time_offset_ms", "faults.misregistration.angle_deg"})
      rows.push_back(tolerance_row(path, method));
  const FigureSheet sheet = tolerance_figure({}, {}, rows, style);
  const FigureSheet print = arranged(sheet);
  ASSERT_EQ(print.columns, 2);
  ASSERT_EQ(print.panels.size(), 4u);
  EXPECT_EQ(print.panels[1].x_label, "mount error (mm)");
  EXPECT_EQ(print.panels[2].x_label, "time offset (ms)");
  for (const Panel& panel : print.panels) EXPECT_TRUE(panel.y_tic_labels) << "each its own scale";
  const auto files = draw(sheet, folder_);
  const std::string script = text_of(folder_ / "tolerance.gp");
  EXPECT_THAT(script, HasSubstr("unset object; unset arrow; unset title")) << "in the legend";
  EXPECT_THAT(script, HasSubstr("dt " + grey_dash(1)));
  EXPECT_THAT(script, Not(HasSubstr(palette_colour(1))));
  EXPECT_NEAR(cv::imread(files.front().string()).cols, 85.0 / 25.4 * 300.0, 1.0);
}

TEST(FigureStyle, NoFontRunsAnything) {
  for (const char* font : {"", " ", "-x", "a'", "a\"", "a,40", "a\nb", "a`b`", "a;b", "a{b}",
                           "a\\b", "$(a)", "a:b", "DejaVu Sans'; system('touch x'); '"}) {
    FigureStyle style;
    style.font = font;
    EXPECT_THAT(refusal(style), HasSubstr("must be a font's name")) << font;
    EXPECT_THAT(refusal(style), Not(HasSubstr("\n"))) << font;
  }
  for (const char* font : {"DejaVu Sans", "Nimbus Roman No9 L", "Noto_Sans-CJK.JP"}) {
    FigureStyle style;
    style.font = font;
    EXPECT_EQ(refusal(style), "") << font;
  }
}

}  // namespace
}  // namespace mapscore::eval
