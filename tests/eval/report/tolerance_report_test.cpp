// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#include "eval/report/tolerance_report.hpp"

#include "eval/report/tables/table_formats.hpp"

#include <gtest/gtest.h>

namespace mapscore::eval {
namespace {

ToleranceRow row_of(ToleranceVerdict verdict, std::optional<double> dose, std::optional<double> low,
                    std::optional<double> high) {
  constexpr const char* kPath = "faults.misregistration.magnitude_m";
  ToleranceRow row{
      kPath, figure_axis(field_of(Study{}, kPath), {"1"}), std::nullopt, "direct", "pooled", {}, {},
      {}};
  row.search = {0.0, 0.04, 0.8, 42};
  row.tolerance.verdict = verdict;
  row.tolerance.dose = dose;
  row.tolerance.low = low;
  row.tolerance.high = high;
  row.tolerance.trials = 42;
  return row;
}

TEST(ToleranceReport, SaysDosesInTheUnitOfFigures) {
  using enum ToleranceVerdict;
  EXPECT_EQ(text_of(row_of(found, 0.00712, 0.00641, 0.00789)), "7.12 mm [6.41, 7.89]");
  EXPECT_EQ(text_of(row_of(found, 0.02, std::nullopt, 0.021)), "20 mm [open, 21]");
  EXPECT_EQ(text_of(row_of(open, std::nullopt, 0.018, std::nullopt)), "- [18, open]");
  EXPECT_EQ(text_of(row_of(above, std::nullopt, 0.04, std::nullopt)), "> 40 mm");
  EXPECT_EQ(text_of(row_of(below, std::nullopt, std::nullopt, 0.0)), "< 0 mm");
  EXPECT_EQ(text_of(row_of(found, 1.2341, 0.9994, 12.0)), "1234 mm [999, 12000]");
  ToleranceRow far = row_of(above, std::nullopt, 1.0, std::nullopt);
  far.search.high = 1.0;
  EXPECT_EQ(text_of(far), "> 1000 mm");
  EXPECT_EQ(text_of(row_of(not_monotone, std::nullopt, 0.01, 0.02)), "-");
}

TEST(ToleranceReport, ForProgramsHasPathUnitAndNineDigits) {
  ToleranceAim aim;
  aim.target = 0.8;
  Study study;
  study.name = "demo";
  const std::vector<ToleranceRow> rows{
      row_of(ToleranceVerdict::found, 0.0071234, 0.0064, std::nullopt)};
  EXPECT_EQ(
      to_csv(tolerance_table(study, aim, "direct", rows, Reader::program)),
      "fault,method,group,path,unit,dose,low,high,reference,difference,difference_low,"
      "difference_high,verdict,trials,undefined\n"
      "misregistration,direct,pooled,faults.misregistration.magnitude_m,mm,7.1234,6.4,-,,-,-,-,"
      "found,42,0\n");
  EXPECT_EQ(aim.text(), "f1 >= 0.8");
  aim.target.reset();
  EXPECT_EQ(aim.text(), "f1 loses at most 0.05 against the least dose");
}

TEST(ToleranceReport, ComparesWithTheReferenceOfTheSameFaultAndGroup) {
  using enum ToleranceVerdict;
  Study study;
  study.name = "demo";
  ToleranceRow first = row_of(found, 0.004, 0.003, 0.006),
               second = row_of(found, 0.01, 0.008, 0.012);
  ToleranceRow third = row_of(above, std::nullopt, 0.04, std::nullopt), other = second;
  second.method = "erosion";
  third.method = "growing";
  other.method = "erosion";
  other.group = "chair";
  // Without curves nothing is known of the seeds' share: 6 - sqrt(2^2 + 2^2), 6 + sqrt(2^2 + 1^2).
  EXPECT_EQ(difference_text(second, first), "+6 mm [3.17, 8.24]");
  EXPECT_EQ(difference_text(first, second), "-6 mm [-8.24, -3.17]");
  EXPECT_EQ(difference_text(third, first), "- [34, open]");
  EXPECT_EQ(difference_text(third, third), "-");
  const Table table =
      tolerance_table(study, {}, "direct", {first, second, third, other}, Reader::terminal);
  EXPECT_EQ(table.columns[4], "less direct");
  EXPECT_EQ(table.rows[0][4], "");
  EXPECT_EQ(table.rows[1][4], "+6 mm [3.17, 8.24]");
  EXPECT_EQ(table.rows[3][4], "");  // no reference for chairs
}

TEST(ToleranceReport, ForPapersHasAColumnAMethod) {
  using enum ToleranceVerdict;
  ToleranceRow first = row_of(found, 0.004, 0.003, 0.006), second = row_of(above, {}, 0.04, {});
  second.method = "erosion";
  ToleranceRow third = first, fourth = second;
  third.group = fourth.group = "chair";
  const Table one = tolerance_matrix({}, {}, {first, second});
  EXPECT_EQ(one.columns, (std::vector<std::string>{"fault", "direct", "erosion"}));
  EXPECT_EQ(one.rows,
            (std::vector<std::vector<std::string>>{{"misregistration", "4 mm [3, 6]", "> 40 mm"}}));
  const Table two = tolerance_matrix({}, {}, {first, second, third, fourth});
  EXPECT_EQ(two.columns, (std::vector<std::string>{"fault", "group", "direct", "erosion"}));
  ASSERT_EQ(two.rows.size(), 2u);
  EXPECT_EQ(two.rows[1][1], "chair");
}

TEST(ToleranceReport, SaysTheDoseOfTheSecondFault) {
  constexpr const char* kPath = "faults.pose.sigma_xy_m";
  ToleranceRow row = row_of(ToleranceVerdict::above, std::nullopt, 0.04, std::nullopt);
  row.second = SecondFault{kPath, "0.02", figure_axis(field_of(Study{}, kPath), {"0.02"})};
  const Table table = tolerance_table({}, {}, "direct", {row}, Reader::terminal);
  EXPECT_EQ(table.columns[1], "at");
  EXPECT_EQ(table.rows[0][1], row.second->axis.text(0));
}

}  // namespace
}  // namespace mapscore::eval
