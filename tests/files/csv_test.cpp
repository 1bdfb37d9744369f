// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#include "files/csv.hpp"

#include <gmock/gmock.h>

namespace mapscore {
namespace {

using ::testing::ElementsAre;
using ::testing::Optional;

TEST(Csv, QuotesOnlyWhatNeedsIt) {
  EXPECT_EQ(csv_line({"0.05", "", "x"}), "0.05,,x\n");
  EXPECT_EQ(csv_line({"", "[0, 1]"}), ",\"[0, 1]\"\n");
  EXPECT_EQ(csv_line({"a \"b\""}), "\"a \"\"b\"\"\"\n");
  EXPECT_EQ(csv_line({" blanks "}), "\" blanks \"\n");
  EXPECT_EQ(csv_line({}), "\n");
}

TEST(Csv, TakesLinesApart) {
  EXPECT_THAT(csv_cells("a,b", 9), Optional(ElementsAre("a", "b")));
  EXPECT_THAT(csv_cells("", 9), Optional(ElementsAre("")));
  EXPECT_THAT(csv_cells(",b,", 9), Optional(ElementsAre("", "b", "")));
  EXPECT_THAT(csv_cells(" a , \"[0, 1]\" ,x", 9), Optional(ElementsAre("a", "[0, 1]", "x")));
  EXPECT_EQ(csv_cells("\"open", 9), std::nullopt);
  EXPECT_EQ(csv_cells("\"a\"b", 9), std::nullopt);
  EXPECT_THAT(csv_cells(",,,,,,", 2), Optional(::testing::SizeIs(3)));
}

TEST(Csv, LeavesNothingThatASpreadsheetRuns) {
  for (const char* formula : {"=1+1", "=cmd|' /C calc'!A0", "+SUM(A1)", "-2+cmd()", "@x"})
    EXPECT_EQ(csv_line({formula}).front(), '\'') << formula;
  for (const char* plain : {"-", "-0.5", "+3", "-1e-9", "-0.2..0.1", "cup", "a=b"})
    EXPECT_EQ(csv_line({plain}), std::string(plain) + '\n');
}

TEST(Csv, EveryTextIsReadBackAsItWas) {
  for (const std::string odd :
       {"a, \"b\"\r\nc", "=1", "'=1", "''", "'", "-x", " x ", "\"", ",", ""}) {
    const std::string line = csv_line({odd, odd});
    EXPECT_THAT(csv_cells(line.substr(0, line.size() - 1), 9), Optional(ElementsAre(odd, odd)))
        << odd;
  }
}

}  // namespace
}  // namespace mapscore
