// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#include "eval/report/csv.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace mapscore::eval {
namespace {

using ::testing::ElementsAre;

TEST(CsvLine, QuotesOnlyWhatNeedsIt) {
  EXPECT_EQ(csv_line({"0.05", "", "x"}), "0.05,,x\n");
  EXPECT_EQ(csv_line({"", "[0, 1]"}), ",\"[0, 1]\"\n");
  EXPECT_EQ(csv_line({"a \"b\""}), "\"a \"\"b\"\"\"\n");
}

TEST(CsvLine, CellsAreTakenApart) {
  EXPECT_THAT(csv_cells("a,b"), ElementsAre("a", "b"));
  EXPECT_THAT(csv_cells(""), ElementsAre(""));
  EXPECT_THAT(csv_cells(",b,"), ElementsAre("", "b", ""));
  EXPECT_THAT(csv_cells("\"[0, 1]\",x"), ElementsAre("[0, 1]", "x"));
}

TEST(CsvLine, CellsComeBackAsTheyWere) {
  const std::string odd = "\"a\",b\"\",\"";
  const std::string line = csv_line({odd, odd});
  EXPECT_THAT(csv_cells(line.substr(0, line.size() - 1)), ElementsAre(odd, odd));
}

}  // namespace
}  // namespace mapscore::eval
