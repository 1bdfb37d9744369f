// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#include "eval/report/tables/pivot_table.hpp"

#include "tests/eval/report/synthetic_summary.hpp"
#include "tests/support/expect_error.hpp"

namespace mapscore::eval {
namespace {

using mapscore::testing::expect_error;
using ::testing::Contains;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::SizeIs;
using testing::synthetic_study;
using testing::synthetic_summary;

const SweepAxis kShiftDoses{"faults.misregistration.magnitude_m", {"0", "0.01"}};
const SweepAxis kMountAngles{"faults.mount.angle_deg", {"0", "1", "2"}};

/// Cells: shift 0 with the three turns, then shift 0.01. Precision of cups: direct
/// 0.98 - 0.02 cell - 0.005, erosion 0.04 less; of chairs 0.04 less than of cups.
StudySummary two_axes() {
  StudySummary summary =
      synthetic_summary(synthetic_study({"direct", "erosion"}, {kShiftDoses, kMountAngles}, 2));
  summary.study.methods[0].title = "Direct";
  summary.study.class_titles["cup"] = "mug";
  return summary;
}

PivotQuestion asked(std::vector<std::string> rows, std::vector<std::string> columns) {
  PivotQuestion question;
  question.metrics = {"precision"};
  question.groups = {"cup"};
  question.rows = std::move(rows);
  question.columns = std::move(columns);
  return question;
}

TEST(PivotTable, HasADimensionOverTheRowsAndOneOverTheColumns) {
  const StudySummary at_zero = selected(two_axes(), {{"magnitude_m=0.000"}, {}});
  const Table table = pivot_table(at_zero, asked({"faults.mount.angle_deg"}, {"method"}));
  EXPECT_THAT(table.columns, ElementsAre("angle_deg", "direct", "erosion"));
  EXPECT_EQ(table.keys, 1u);
  EXPECT_THAT(table.rows,
              ElementsAre(ElementsAre("0", "0.975", "0.935"), ElementsAre("1", "0.955", "0.915"),
                          ElementsAre("2", "0.935", "0.895")));
  EXPECT_THAT(table.caption, Contains(HasSubstr("magnitude_m 0, class cup, metric precision")));
}

TEST(PivotTable, WhatHasNoPlaceStandsInTheRowsOrTheColumns) {
  const Table rows = pivot_table(two_axes(), asked({}, {"method"}));
  EXPECT_THAT(rows.columns, ElementsAre("magnitude_m", "angle_deg", "direct", "erosion"));
  EXPECT_THAT(rows.rows, SizeIs(6));
  EXPECT_THAT(rows.rows[5], ElementsAre("0.01", "2", "0.875", "0.835"));
  const Table columns = pivot_table(two_axes(), asked({"magnitude_m", "angle_deg"}, {}));
  EXPECT_EQ(columns.rows, rows.rows);
  const Table neither = pivot_table(two_axes(), asked({}, {}));
  EXPECT_THAT(neither.columns, ElementsAre("magnitude_m", "angle_deg", "method", "precision"));
  EXPECT_THAT(neither.rows[11], ElementsAre("0.01", "2", "erosion", "0.835"));
  const Table single = pivot_table(
      selected(two_axes(), {{"magnitude_m=0", "angle_deg=1"}, {"direct"}}), asked({}, {}));
  EXPECT_THAT(single.columns, ElementsAre("method", "precision"));
  EXPECT_THAT(single.rows, ElementsAre(ElementsAre("direct", "0.955")));
}

TEST(PivotTable, ClassesAndFiguresAreDimensionsToo) {
  PivotQuestion question = asked({"class"}, {"metric", "method"});
  question.metrics = {"precision", "recall"};
  question.groups.clear();
  const Table table =
      pivot_table(selected(two_axes(), {{"magnitude_m=0", "angle_deg=0"}, {}}), question);
  EXPECT_THAT(table.columns, ElementsAre("class", "precision, direct", "precision, erosion",
                                         "recall, direct", "recall, erosion"));
  EXPECT_THAT(table.rows, ElementsAre(ElementsAre("cup", "0.975", "0.935", "0.900", "0.900"),
                                      ElementsAre("chair", "0.935", "0.895", "0.800", "0.800"),
                                      ElementsAre("pooled", "0.955", "0.915", "0.850", "0.850")));
}

TEST(PivotTable, SpreadStandsInColumnsOfItsOwn) {
  const StudySummary one = selected(two_axes(), {{"magnitude_m=0", "angle_deg=0"}, {"direct"}});
  PivotQuestion question = asked({}, {});
  EXPECT_THAT(pivot_table(one, question).columns, ElementsAre("method", "precision"));
  question.spread = true;
  EXPECT_THAT(pivot_table(one, question).rows[0], ElementsAre("direct", "0.975", "0.970", "0.980"));
  question.spread = false;
  const Table table = pivot_table(one, question, Reader::program);
  EXPECT_THAT(table.columns,
              ElementsAre("method", "precision", "precision low", "precision high", "spread"));
  EXPECT_THAT(table.rows[0], ElementsAre("direct", "0.975", "0.97", "0.98", "range"));
}

TEST(PivotTable, APaperGetsTitlesAndUnits) {
  PivotQuestion question = asked({"class", "magnitude_m"}, {"angle_deg"});
  question.metrics = {"f1"};
  const Table table = pivot_table(selected(two_axes(), {{}, {"direct"}}), question, Reader::paper);
  EXPECT_THAT(table.columns,
              ElementsAre("class", "misregistration (mm)", "0 deg", "1 deg", "2 deg"));
  EXPECT_EQ(table.rows[1][0], "mug");
  EXPECT_EQ(table.rows[1][1], "10");
  EXPECT_THAT(table.caption, Contains(HasSubstr("method Direct, metric F1")));
  EXPECT_EQ(metric_text("f_2cm", Reader::paper), "F at 2 cm");
  EXPECT_EQ(metric_text("precision_10cm", Reader::paper), "precision at 10 cm");
  EXPECT_EQ(metric_text("false_near", Reader::paper), "false near");
  EXPECT_EQ(metric_text("f_2cm", Reader::program), "f_2cm");
}

TEST(PivotTable, OfAnUnfinishedSweepWhatIsNotThereIsUndefined) {
  StudySummary summary = two_axes();
  summary.trials.erase(summary.trials.begin());
  const Table table = pivot_table(summary, asked({}, {"method"}));
  EXPECT_THAT(table.rows[0], ElementsAre("0", "0", "-", "0.935"));
}

// Cups of direct at point c: 0.02 (1 + c) false, of erosion 0.04 more.
TEST(PivotTable, OfPointsOverRangesAllPathsAreOneDimension) {
  Study study = synthetic_study({"direct", "erosion"}, {kShiftDoses, kMountAngles}, 1);
  study.sampling = Sobol{3};  // at (0, 0), (0.005, 0.5) and (0.0075, 0.25)
  const StudySummary summary = synthetic_summary(std::move(study));
  const Table methods = pivot_table(summary, asked({}, {"method"}));
  EXPECT_THAT(methods.columns, ElementsAre("magnitude_m", "angle_deg", "direct", "erosion"));
  EXPECT_EQ(methods.keys, 2u);
  ASSERT_THAT(methods.rows, SizeIs(3));
  EXPECT_THAT(methods.rows[1], ElementsAre("0.005", "0.5", "0.960", "0.920"));
  const Table metric_alone = pivot_table(summary, asked({}, {}));
  EXPECT_THAT(metric_alone.columns, ElementsAre("magnitude_m", "angle_deg", "method", "precision"));
  EXPECT_THAT(metric_alone.rows, SizeIs(6));
  const Table points = pivot_table(selected(summary, {{"magnitude_m=0.005"}, {}}),
                                   asked({"method"}, {"point"}), Reader::paper);
  EXPECT_THAT(points.columns, ElementsAre("method", "5, 0.5"));
  EXPECT_THAT(points.caption, Contains("columns: misregistration (mm), mount error angle (deg)"));
  expect_error("point has 3 values and no place in the table; add it to --rows or --columns",
               [&] { (void)pivot_table(summary, asked({"method"}, {"metric"})); });
}

TEST(PivotTable, OfPointsOverRangesAPathHasNoPlace) {
  Study study = synthetic_study({"direct"}, {kShiftDoses}, 1);
  study.sampling = Sobol{3};  // at 0, 0.005 and 0.0075
  const StudySummary summary = synthetic_summary(std::move(study));
  EXPECT_THAT(selected(summary, {{"magnitude_m=0.0050"}, {}}).trials, SizeIs(1));
  expect_error("has no such value; there are: 0, 0.005, 0.0075", [&] {
    (void)selected(summary, {{"magnitude_m=0.01"}, {}});
  });
  expect_error("magnitude_m: points over ranges share no values; ask for `point`",
               [&] { (void)pivot_table(summary, asked({"magnitude_m"}, {"method"})); });
}

TEST(PivotTable, RefusesWhatIsNotThereWithTheNearest) {
  const auto refuse = [](const std::string& part, const Selection& selection,
                         const PivotQuestion& question) {
    expect_error(part, [&] { (void)pivot_table(selected(two_axes(), selection), question); });
  };
  refuse("must be path=value", {{"magnitude_m"}, {}}, asked({}, {}));
  refuse(
      "'faults.misregistration.magnitud_m' is not swept; did you mean "
      "'faults.misregistration.magnitude_m'?",
      {{"faults.misregistration.magnitud_m=0"}, {}}, asked({}, {}));
  refuse("has no such value; there are: 0, 0.01", {{"magnitude_m=0.02"}, {}}, asked({}, {}));
  refuse("write a number", {{"magnitude_m=wide"}, {}}, asked({}, {}));
  refuse("no method 'errosion' in this study; did you mean 'erosion'?", {{}, {"errosion"}},
         asked({}, {}));
  refuse("'methods': neither a swept path nor method, class or metric; did you mean 'method'?", {},
         asked({"methods"}, {}));
  refuse("method: has two places", {}, asked({"method"}, {"method"}));
  refuse(
      "faults.mount.angle_deg has 3 values and no place in the table; add it to --rows or "
      "--columns, or choose one by --where",
      {}, asked({"magnitude_m"}, {"method"}));
  refuse(
      "method has 2 values and no place in the table; add it to --rows or --columns, or choose "
      "one by --method",
      {}, asked({"magnitude_m"}, {"angle_deg"}));
  PivotQuestion unknown = asked({}, {});
  unknown.metrics = {"precisoin"};
  refuse("no metric 'precisoin' in this study; did you mean 'precision'?", {}, unknown);
  unknown.metrics = {"f1", "f1"};
  refuse("metric 'f1' is given twice", {}, unknown);
}

}  // namespace
}  // namespace mapscore::eval
