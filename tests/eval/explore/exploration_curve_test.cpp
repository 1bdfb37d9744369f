// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#include "eval/explore/exploration_curve.hpp"

#include "core/error.hpp"
#include "eval/explore/exploration_files.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace mapscore::eval {
namespace {

CoveragePoint at(double stamp_s, double driven_m, double coverage) {
  CoveragePoint point;
  point.stamp_s = stamp_s;
  point.driven_m = driven_m;
  point.coverage = coverage;
  return point;
}

/// Looks round for 4 s, drives 10 m in 20 s, stands to the end.
const ExplorationCurve kCurve{at(0, 0, 0.25), at(4, 0, 0.5), at(14, 5, 0.75), at(24, 10, 0.875),
                              at(30, 10, 1.0)};

TEST(ExplorationCurve, ReachesAShareAtTheFirstPointThatCoversIt) {
  EXPECT_EQ(reaches(kCurve, 0.5, CurveAxis::metres), 0.0);
  EXPECT_EQ(reaches(kCurve, 0.5, CurveAxis::seconds), 4.0);
  EXPECT_EQ(reaches(kCurve, 0.76, CurveAxis::metres), 10.0);
  EXPECT_EQ(reaches(kCurve, 0.76, CurveAxis::seconds), 24.0);
  EXPECT_EQ(reaches({at(0, 0, 0.25)}, 0.5, CurveAxis::metres), std::nullopt);
}

TEST(ExplorationCurve, CoverageIsThatOfTheLastPoint) {
  EXPECT_EQ(coverage_at(kCurve, 4.9, CurveAxis::metres), 0.5);
  EXPECT_EQ(coverage_at(kCurve, 5.0, CurveAxis::metres), 0.75);
  EXPECT_EQ(coverage_at(kCurve, 99.0, CurveAxis::metres), 1.0);
  EXPECT_EQ(coverage_at({at(2, 1, 0.5)}, 0.5, CurveAxis::metres), 0.0);
}

TEST(ExplorationCurve, AreaIsTheMeanCoverageUpToTheBudget) {
  // 5 m at .5, 5 m at .75, then 10 m at 1.
  EXPECT_DOUBLE_EQ(area_under(kCurve, 20.0, CurveAxis::metres), (2.5 + 3.75 + 10.0) / 20.0);
  EXPECT_DOUBLE_EQ(area_under(kCurve, 8.0, CurveAxis::metres), (2.5 + 0.75 * 3.0) / 8.0);
  // 4 s at .25, 10 at .5, 10 at .75, 6 at .875, 10 at 1.
  EXPECT_DOUBLE_EQ(area_under(kCurve, 40.0, CurveAxis::seconds),
                   (1.0 + 5.0 + 7.5 + 5.25 + 10.0) / 40.0);
  EXPECT_EQ(area_under({}, 10.0, CurveAxis::metres), 0.0);
}

TEST(ExplorationCurve, ItsFileReadsBackTheSame) {
  ExplorationCurve curve = kCurve;
  curve[2].map = MapState{0.5, 0.25, 1.0 / 3.0, 17.125};
  curve[2].views = 3;
  const ExplorationCurve read = curve_of_text(curve_text(curve), "curve.csv");
  ASSERT_EQ(read.size(), curve.size());
  EXPECT_EQ(curve_text(read), curve_text(curve));
  ASSERT_TRUE(read[2].map);
  EXPECT_EQ(read[2].map->f1, 1.0 / 3.0);
  EXPECT_FALSE(read[1].map);
}

TEST(ExplorationCurve, ADamagedFileIsRefusedByItsLine) {
  std::string text = curve_text(kCurve);
  text.insert(text.find("\n4,") + 1, "x");
  EXPECT_THAT([&] { (void)curve_of_text(text, "curve.csv"); },
              ::testing::ThrowsMessage<Error>(::testing::HasSubstr("curve.csv:3")));
  EXPECT_THROW((void)curve_of_text("stamp_s\n", "curve.csv"), Error);
}

}  // namespace
}  // namespace mapscore::eval
