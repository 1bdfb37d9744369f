// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#include "eval/report/tables/table_formats.hpp"
#include "tests/eval/report/synthetic_summary.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace mapscore::eval {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::Not;
using ::testing::SizeIs;
using testing::summary_of;

TEST(ScoreTable, HasARowForEveryMethodAtEveryCell) {
  const Table table = score_table(summary_of(2), "cup");
  EXPECT_THAT(table.columns, ElementsAre("magnitude_m", "method", "precision", "recall", "F1",
                                         "IoU", "AP", "F1 best", "threshold", "F1 low", "F1 high",
                                         "registration F1", "lattice precision", "lattice recall"));
  ASSERT_THAT(table.rows, SizeIs(4));
  // Cups at cell 1 of direct: 100 predicted a seed, 4 and 5 false; 200 visible a seed, 20 missed.
  // P = 191/200, R = 0.9, F = 2PR/(P+R), IoU = 360/(400 + 9); at dose zero P = 0.98, lattice P = 1.
  // F of the seeds: P = 0.96 and 0.95. At 0.9 all is right: AP = R. Two seeds choose no threshold.
  EXPECT_THAT(table.rows[2],
              ElementsAre("0.01", "direct", "0.955", "0.900", "0.927", "0.880", "0.900", "-", "-",
                          "0.924", "0.929", "0.938", "1.000", "0.900"));
}

TEST(ScoreTable, AProgramGetsNineDigitsAndWhatTheSpreadIs) {
  const Table table = score_table(summary_of(2), "cup", Reader::program);
  EXPECT_EQ(table.columns.back(), "F1 spread");
  EXPECT_EQ(table.rows[2].back(), "range");
  EXPECT_EQ(table.rows[2][6], "0.9");          // AP
  EXPECT_EQ(table.rows[2][4], "0.926684636");  // 2 P R / (P + R), P = 0.955, R = 0.9
  EXPECT_EQ(score_table(summary_of(10), "cup", Reader::program).rows[2].back(), "95% interval");
}

TEST(ScoreTable, APaperGetsTitlesAndUnits) {
  StudySummary summary = summary_of(2);
  summary.study.methods[1].title = "Erosion, 5 px";
  const Table table = score_table(summary, "cup", Reader::paper);
  EXPECT_EQ(table.columns.front(), "misregistration (mm)");
  EXPECT_THAT(table.rows[3], ::testing::Contains("Erosion, 5 px"));
  EXPECT_EQ(table.rows[3].front(), "10");
  EXPECT_EQ(score_table(summary, "cup").rows[3][1], "erosion");
}

TEST(ScoreTable, SaysWhatItStandsOn) {
  const auto caption = [](int seeds) {
    std::string text;
    for (const std::string& line : score_table(summary_of(seeds), "pooled").caption)
      text += line + '\n';
    return text;
  };
  EXPECT_THAT(caption(2), HasSubstr("detected: cup, chair\n"));
  EXPECT_THAT(caption(2), HasSubstr("voxels of 5 cm; 2 seeds; each map scored"));
  EXPECT_THAT(caption(2), HasSubstr("least and greatest of the seeds (fewer than 10)"));
  EXPECT_THAT(caption(2), HasSubstr("F1 best, threshold: need 3 seeds"));
  EXPECT_THAT(caption(10), HasSubstr("95 % interval"));
  EXPECT_THAT(caption(10), HasSubstr("best on the other 9; threshold: best on all 10 seeds"));
}

TEST(ScoreTable, SaysWhereNothingIsVisible) {
  StudySummary summary = summary_of(1);
  const std::string note = "no truth voxel of a detected class was visible";
  EXPECT_THAT(summary.lattice_note(), Not(HasSubstr(note)));
  for (ResultLine& line : summary.lattice_ceilings)
    for (ClassCounts& counts : line.pooled) counts.visible = 0;
  EXPECT_THAT(score_table(summary, "pooled").caption, ::testing::Contains(HasSubstr(note)));
}

Table small_table() {
  return {{"a caption"}, {"dose", "method", "F1"}, {{"0", "direct", "0.500"}, {"0.01", "x", "-"}}};
}

TEST(Table, AsTextIsAlignedWithoutTrailingBlanks) {
  EXPECT_EQ(to_text(small_table()),
            "# a caption\n"
            "dose  method  F1\n"
            "0     direct  0.500\n"
            "0.01  x       -\n");
}

TEST(Table, AsTextCountsLettersNotBytes) {
  EXPECT_EQ(to_text(Table{{}, {"pose \u03c3", "b"}, {{"123456", "c"}}}),
            "pose \u03c3  b\n123456  c\n");
}

TEST(Table, AsCsvHasNoCaption) {
  EXPECT_EQ(to_csv(small_table()), "dose,method,F1\n0,direct,0.500\n0.01,x,-\n");
}

TEST(Table, AsCsvQuotesWhatHoldsACommaAndKeepsEmptyCells) {
  Table table;
  table.columns = {"translation_m", "method", "F1"};
  table.rows = {{"[0, 0, 0]", "", "1"}, {"", "say \"x\"", "2"}};
  EXPECT_EQ(to_csv(table), "translation_m,method,F1\n\"[0, 0, 0]\",,1\n,\"say \"\"x\"\"\",2\n");
}

TEST(Table, AsJsonNamesEveryCellAndKeepsNumbersNumbers) {
  EXPECT_EQ(to_json({{"c"}, {"b", "a"}, {{"1", "x2"}}}),
            "{\n  \"caption\": [\n    \"c\"\n  ],\n  \"rows\": [\n    {\n      \"b\": 1,\n"
            "      \"a\": \"x2\"\n    }\n  ]\n}\n");
  // Of which nlohmann writes 17 digits.
  EXPECT_THAT(to_json({{}, {"a"}, {{"0.457180744"}, {"0.643908859"}}}),
              ::testing::AllOf(HasSubstr("\"a\": 0.457180744\n"), HasSubstr("0.643908859\n")));
  EXPECT_EQ(to_json(Table{}), "{\n  \"caption\": [],\n  \"rows\": []\n}\n");
  const std::string json = to_json(
      {{}, {"a", "b", "c", "d", "e", "f"}, {{"+0.0623", "-", "", "-1e-05", "nan", "[0, 1]"}}});
  for (const char* cell : {"\"a\": 0.0623,", "\"b\": null,", "\"c\": null,", "\"d\": -1e-05,",
                           "\"e\": \"nan\",", "\"f\": \"[0, 1]\""})
    EXPECT_NE(json.find(cell), std::string::npos) << cell << json;
}

/// No line is longer, every cell is there once, and each part tells which row is which.
TEST(Table, AsTextFitsTheTerminal) {
  Table table{{"one two three four five"}, {"dose", "method", "aaaa", "bbbb", "cccc"}, {}};
  table.keys = 2;
  table.rows = {{"0", "direct", "1", "2", "3"}, {"0.01", "x", "4", "5", "6"}};
  EXPECT_EQ(to_text(table, 24),
            "# one two three four\n#   five\n"
            "dose  method  aaaa  bbbb\n0     direct  1     2\n0.01  x       4     5\n"
            "\ndose  method  cccc\n0     direct  3\n0.01  x       6\n");
  EXPECT_EQ(to_text(table, 30), "# one two three four five\n" + to_text(table).substr(26));
  EXPECT_EQ(to_text(table, 0), to_text(table));
  EXPECT_THAT(to_text(table, 5), HasSubstr("\n\ndose  method  bbbb\n"))
      << "keys and one column in any case";
}

TEST(Table, MarkdownEscapesWhatItWouldRead) {
  const Table table{{"50 %"}, {"a|b", "c_d"}, {{"1 & 2", "x\\y"}}};
  EXPECT_EQ(to_markdown(table), "50 %  \n\n| a\\|b | c\\_d |\n| --- | --- |\n| 1 & 2 | x\\\\y |\n");
}

TEST(Table, TexIsPlainLatex) {
  const Table table{
      {"50 %"}, {"a|b", "c_d", "\u00d7"}, {{"1 & 2", "x\\y", "-0.5"}, {"<~^>", "-", "-"}}};
  EXPECT_EQ(to_tex(table),
            "% 50 %\n\\begin{tabular}{llr}\n\\toprule\na\\textbar{}b & c\\_d & $\\times$ \\\\\n"
            "\\midrule\n1 \\& 2 & x\\textbackslash{}y & $-$0.5 \\\\\n"
            "\\textless{}\\textasciitilde{}\\textasciicircum{}\\textgreater{} & -- & -- \\\\\n"
            "\\bottomrule\n\\end{tabular}\n");
}

}  // namespace
}  // namespace mapscore::eval
