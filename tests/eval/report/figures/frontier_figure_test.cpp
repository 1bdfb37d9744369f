// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#include "eval/report/figures/frontier_figure.hpp"

#include "eval/report/figures/font.hpp"
#include "eval/report/figures/geometry.hpp"
#include "files/text.hpp"
#include "tests/eval/report/figures/figure_files.hpp"

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>

namespace mapscore::eval {
namespace {

using ::testing::ElementsAre;
using testing::FiguresTest;
using ::testing::HasSubstr;
using ::testing::Not;
using testing::text_of;

constexpr const char* kFault = "faults.misregistration.magnitude_m";
constexpr const char* kSecond = "faults.pose.sigma_xy_m";

ToleranceRow frontier_row(const char* method, const char* second, ToleranceVerdict verdict,
                          std::optional<double> low = {}, std::optional<double> dose = {},
                          std::optional<double> high = {}) {
  ToleranceRow made{
      kFault, figure_axis(field_of(Study{}, kFault), {"1"}), {}, method, "pooled", {}, {}, {}};
  made.second = SecondFault{kSecond, second, figure_axis(field_of(Study{}, kSecond), {second})};
  made.search = {0.0, 0.04, 0.8, 42};
  made.tolerance.verdict = verdict;
  made.tolerance.low = low;
  made.tolerance.dose = dose;
  made.tolerance.high = high;
  return made;
}

std::vector<ToleranceRow> frontier_rows() {
  using enum ToleranceVerdict;
  return {frontier_row("a", "0", found, 0.01, 0.011, 0.012),
          frontier_row("b", "0", found, 0.02, 0.021, 0.022),
          frontier_row("a", "0.1", found, 0.004, 0.006, 0.008),
          frontier_row("b", "0.1", found, {}, 0.007, 0.009),
          frontier_row("a", "0.2", open),
          frontier_row("b", "0.2", not_monotone, 0.001, {}, 0.002)};
}

FigureStyle print_style() {
  FigureStyle style;
  style.width_mm = 85.0;
  style.grey = true;
  return style;
}

TEST(FrontierFigure, MovesOnlyMethodsThatWouldCoverEachOtherAndByAMillimetre) {
  const FigureSheet sheet = frontier_figure({}, {}, frontier_rows(), print_style());
  const auto lines = [&](const std::string& method) {
    return testing::block(sheet.data, "# misregistration (mm); pooled; " + method + "; tolerances");
  };
  const double aside = 0.5 / 25.4 / sheet.panel_width_in * 1.1 * 200.0;
  EXPECT_EQ(arranged(sheet).panel_width_in, sheet.panel_width_in);
  EXPECT_THAT(lines("a"),
              ElementsAre("0 11 10 12 0", fmt::format("100 6 4 8 {:.9g}", -aside), "200 - 0 40 0"));
  EXPECT_THAT(lines("b"),
              ElementsAre("0 21 20 22 0", fmt::format("100 7 0 9 {:.9g}", aside), "200 - - - 0"));
}

TEST(FrontierFigure, SaysWhatStandsWithoutAMark) {
  const std::string caption = frontier_figure({}, {}, frontier_rows()).caption;
  EXPECT_THAT(caption, HasSubstr("Bar without a mark: "));
  EXPECT_THAT(caption, HasSubstr("Neither bar nor mark: "));
  EXPECT_THAT(caption, HasSubstr("side by side, within 1 mm"));
  std::vector<ToleranceRow> apart = frontier_rows();
  apart.resize(2);
  const std::string plain = frontier_figure({}, {}, apart).caption;
  for (const char* words : {"without a mark", "Neither", "side by side"})
    EXPECT_THAT(plain, Not(HasSubstr(words)));
}

TEST(FigureLegend, IsShortenedInTheMiddleAndNeverWithinALetter) {
  EXPECT_EQ(shortened("erosion, 5 px", 2.0, 8.0), "erosion, 5 px");
  const std::string cut = shortened("the first of many words and the last one", 1.0, 8.0);
  EXPECT_THAT(cut, ::testing::StartsWith("the fi"));
  EXPECT_THAT(cut, HasSubstr("\u2026"));
  EXPECT_THAT(cut, ::testing::EndsWith("one"));
  std::string cyrillic;
  for (int n = 0; n < 60; ++n) cyrillic += "\u0442";
  EXPECT_EQ(unfit_as_name(shortened(cyrillic, 2.0, 8.0)), std::nullopt);
}

/// Nothing dark within a letter of the picture's sides.
TEST_F(FiguresTest, InPrintALongMethodTitleEndsBeforeTheEdge) {
  std::vector<ToleranceRow> rows = frontier_rows();
  Study study;
  study.methods.resize(2);
  study.methods[0].name = "a";
  study.methods[1].name = "b";
  study.methods[0].title = "plain $\\alpha$ masks & 50% more words than fit into one column";
  study.methods[1].title = "MASKS OF WHOLE WALLS AND MANY MORE WORDS IN CAPITALS";
  const auto files = draw(frontier_figure(study, {}, rows, print_style()), folder_);
  const cv::Mat1b picture = cv::imread(files.front().string(), cv::IMREAD_GRAYSCALE);
  EXPECT_EQ(cv::countNonZero(picture.colRange(picture.cols - 12, picture.cols) < 128), 0);
  EXPECT_EQ(cv::countNonZero(picture.colRange(0, 12) < 128), 0);
}

TEST_F(FiguresTest, LettersThatNoFontHasLeaveThePictureClean) {
  Study study;
  study.methods.resize(2);
  study.methods[0].name = "a";
  study.methods[1].name = "b";
  const auto dark = [&] {
    const auto files = draw(frontier_figure(study, {}, frontier_rows()), folder_);
    const cv::Mat1b picture = cv::imread(files.front().string(), cv::IMREAD_GRAYSCALE);
    return static_cast<double>(cv::countNonZero(picture < 128)) /
           static_cast<double>(picture.total());
  };
  study.methods[0].title = "\u0442\u0432";
  const double plain = dark();
  EXPECT_THAT(text_of(folder_ / "frontier.gp"), Not(HasSubstr("?: letters")));
  study.methods[0].title = "\u0442\u0432 \U0001F4FA \u2600\uFE0F \U00020000 \uE000";
  EXPECT_LT(dark(), plain + 0.01);
  const std::string script = text_of(folder_ / "frontier.gp");
  EXPECT_THAT(script, HasSubstr("'\u0442\u0432 ? "));
  EXPECT_THAT(script, HasSubstr("?: letters"));
}

TEST(FigureFont, KeepsWhatItDraws) {
  EXPECT_EQ(drawable("a\u00e9\u0442\u03b1\u2026?"), "a\u00e9\u0442\u03b1\u2026?");
  EXPECT_EQ(drawable("x\U0001F4FAy\uFE0F"), "x?y");
}

}  // namespace
}  // namespace mapscore::eval
