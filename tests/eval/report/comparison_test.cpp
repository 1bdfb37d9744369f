// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#include "eval/report/comparison.hpp"

#include "eval/report/tables/table_formats.hpp"
#include "tests/eval/report/pictures/swept_plate.hpp"
#include "tests/eval/report/synthetic_summary.hpp"
#include "tests/support/expect_error.hpp"

#include <gmock/gmock.h>

namespace mapscore::eval {
namespace {

using mapscore::testing::expect_error;
using ::testing::AllOf;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::Not;
using ::testing::SizeIs;
using testing::summary_of;

std::string caption_of(const Table& table) {
  std::string text;
  for (const std::string& line : table.caption) text += line + '\n';
  return text;
}

TEST(Comparison, HasARowForEachCellAndMetric) {
  // Cups: 100 predicted, of which 2 (1 + 2 m + cell) + seed are false, so direct's precision is
  // 0.04 above erosion's at each seed; recall is the same.
  const auto rows =
      compare_methods(summary_of(10), {"direct", "erosion", "cup", {"precision", "recall"}});
  ASSERT_THAT(rows, SizeIs(4));
  EXPECT_EQ(rows[2].cell.index, 1);
  EXPECT_EQ(rows[2].metric, "precision");
  const PairedComparison& precision = rows[2].paired;
  EXPECT_EQ(precision.difference.kind, SpreadKind::interval);
  EXPECT_EQ(precision.difference.seeds, 10);
  EXPECT_NEAR(*precision.mean_a, 0.96 - 0.045, 1e-12);
  EXPECT_NEAR(*precision.mean_b, 0.92 - 0.045, 1e-12);
  EXPECT_NEAR(*precision.difference.mean, 0.04, 1e-12);
  EXPECT_NEAR(*precision.difference.low, 0.04, 1e-12);
  EXPECT_NEAR(*precision.difference.high, 0.04, 1e-12);
  EXPECT_EQ(precision.p, 2.0 / 1024.0);
  EXPECT_DOUBLE_EQ(*rows[2].p_holm, 2 * 2.0 / 1024.0);  // of the two rows that have a p
  EXPECT_EQ(rows[3].metric, "recall");
  EXPECT_EQ(rows[3].paired.difference.mean, 0.0);
  EXPECT_EQ(rows[3].paired.p, std::nullopt);  // all seeds have one value
  EXPECT_EQ(rows[3].p_holm, std::nullopt);
}

TEST(Comparison, PairsBySeedAndNotByPosition) {
  StudySummary summary = summary_of(10);
  ResultLine& erosion = summary.trials.at(1);
  ASSERT_EQ(erosion.method, "erosion");
  std::reverse(erosion.seeds.begin(), erosion.seeds.end());
  std::reverse(erosion.results.begin(), erosion.results.end());
  erosion.seeds.pop_back();  // seed 0
  erosion.results.pop_back();
  const auto rows = compare_methods(summary, {"direct", "erosion", "cup", {"precision"}});
  EXPECT_EQ(rows[0].paired.difference.seeds, 9);
  EXPECT_EQ(rows[0].paired.difference.undefined, 1);
  EXPECT_NEAR(*rows[0].paired.difference.low, 0.04, 1e-12);
  EXPECT_NEAR(*rows[0].paired.difference.high, 0.04, 1e-12);
}

TEST(ComparisonTable, ShowsBothMeansTheIntervalAndP) {
  const Table table =
      comparison_table(summary_of(10), {"erosion", "direct", "cup", {"precision", "recall"}});
  EXPECT_THAT(table.columns,
              ElementsAre("magnitude_m", "metric", "mean erosion", "mean direct", "difference",
                          "low", "high", "spread", "p", "p (Holm)", "pairs"));
  ASSERT_THAT(table.rows, SizeIs(4));
  EXPECT_THAT(table.rows[0], ElementsAre("0", "precision", "0.8950", "0.9350", "-0.0400", "-0.0400",
                                         "-0.0400", "95% interval", "0.0020", "0.0039", "10"));
  EXPECT_THAT(table.rows[3], ElementsAre("0.01", "recall", "0.9000", "0.9000", "0.0000", "0.0000",
                                         "0.0000", "95% interval", "-", "-", "10"));
  EXPECT_THAT(caption_of(table),
              AllOf(HasSubstr("synthetic: erosion - direct, cup classes; detected: cup, chair\n"),
                    HasSubstr("10 seeds; each map scored; paired seed by seed"),
                    HasSubstr("95 % interval of the mean difference"),
                    HasSubstr("not corrected for 2 rows; p (Holm): corrected"),
                    HasSubstr("least p possible with 10 pairs: 0.0020; p (Holm): 0.0039")));
}

TEST(ComparisonTable, EndsWithASentenceForEachMetric) {
  const Table table = comparison_table(
      testing::synthetic_summary(testing::synthetic_study({"direct", "erosion"}, {}, 10)),
      {"erosion", "direct", "cup", {"precision", "recall"}});
  ASSERT_GE(table.caption.size(), 2u);
  EXPECT_EQ(table.caption[table.caption.size() - 2],
            "precision, cup: 0.9350 by direct, 0.8950 by erosion, a difference of -0.0400 (95 % "
            "interval -0.0400 to -0.0400; 10 paired seeds, p = 0.0020, 0.0020 by Holm over all "
            "rows)");
  EXPECT_EQ(table.caption.back(), "recall, cup: 0.9000 by direct and by erosion, over 10 seeds");
}

TEST(ComparisonTable, WithFewSeedsShowsTheRangeAndWhatPCanReach) {
  const Table table = comparison_table(summary_of(4), {"direct", "erosion"});
  ASSERT_THAT(table.rows, SizeIs(2));
  EXPECT_EQ(table.rows[0][1], "f1");
  EXPECT_EQ(table.rows[0][7], "range");
  EXPECT_EQ(table.rows[0][8], "0.1250");
  EXPECT_EQ(table.rows[0][9], "0.2500");
  EXPECT_EQ(table.rows[0][10], "4");
  EXPECT_THAT(caption_of(table),
              AllOf(HasSubstr("no interval (fewer than 10 seeds)"), Not(HasSubstr("95 %")),
                    HasSubstr("least p possible with 4 pairs: 0.1250; p (Holm): 0.2500")));
}

TEST(ComparisonTable, PrintsUndefinedFiguresAsDashes) {
  StudySummary summary = summary_of(2);
  for (ResultLine& line : summary.trials)
    for (TrialResult& result : line.results) result.counts.at(1) = ClassCounts{};
  const Table table = comparison_table(summary, {"direct", "erosion", "cup"});
  EXPECT_THAT(table.rows[0], ElementsAre("0", "f1", "-", "-", "-", "-", "-", "-", "-", "-", "0"));
  EXPECT_THAT(table.caption,
              ::testing::Contains(HasSubstr("p: none; no row has seeds that differ")));
}

TEST(ComparisonTable, HasNineDigitsForPrograms) {
  // Precisions of three seeds: 0.98, 0.97, 0.96 and 0.94, 0.93, and of the last seed 70 of 90.
  StudySummary summary = summary_of(3);
  ClassCounts& last = summary.trials.at(1).results.at(2).counts.at(1);
  last.predicted = 90;
  last.true_predicted = 70;
  const ComparisonQuestion question{"direct", "erosion", "cup", {"precision"}};
  const Table table = comparison_table(summary, question, Reader::program);
  EXPECT_THAT(table.rows[0], ElementsAre("0", "precision", "0.97", "0.882592593", "0.0874074074",
                                         "0.04", "0.182222222", "range", "0.25", "0.5", "3"));
  EXPECT_THAT(to_csv(table), HasSubstr("\n0,precision,0.97,0.882592593,0.0874074074,"));
  EXPECT_THAT(to_json(table), HasSubstr("\"difference\": 0.0874074074,"));
  EXPECT_EQ(comparison_table(summary, question).rows[0][4], "+0.0874");
  EXPECT_EQ(comparison_table(summary, question).columns, table.columns);
}

TEST(Comparison, ListsWhatThereIs) {
  const StudySummary summary = summary_of(2);
  const auto error = [&](const std::string& part, const ComparisonQuestion& question) {
    expect_error(part, [&] { (void)comparison_table(summary, question); });
  };
  error("no method 'guess' in this study; write one of direct, erosion", {"direct", "guess"});
  error("'direct' with itself; give two of: direct, erosion", {"direct", "direct"});
  error("no group 'wall' in this study; write one of pooled, macro, cup, chair",
        {"direct", "erosion", "wall"});
  error("no metric 'F1' in this study; did you mean 'f1'?",
        {"direct", "erosion", "pooled", {"F1"}});
  error("metric 'f1' is given twice", {"direct", "erosion", "pooled", {"f1", "iou", "f1"}});
  error("no metric; f1 is one", {"direct", "erosion", "pooled", {}});
}

TEST(Comparison, TakesEveryListedMetricInEveryGroup) {
  const StudySummary summary = summary_of(2);
  std::vector<std::string> metrics{kBestF1, kBestThreshold};
  for (const Metric& metric : metrics_of_group(summary.trials[0].pooled, summary.table, kPooled))
    if (metric.name != kBestF1 && metric.name != kBestThreshold) metrics.push_back(metric.name);
  for (const std::string& group : summary.groups()) {
    EXPECT_THAT(compare_methods(summary, {"direct", "erosion", group, metrics}),
                SizeIs(2 * metrics.size()))
        << group;
  }
}

using ComparisonOfAStore = testing::SweptPlate;

TEST_F(ComparisonOfAStore, StudyOfOneMethodHasNothingToCompare) {
  sweep();
  const StudySummary summary = summarise_store(results());
  const std::string method = summary.trials.at(0).method;
  expect_error("with itself", [&] { (void)compare_methods(summary, {method, method}); });
}

/// The results of summary_of(seeds) with one false voxel more in each seed's cups of erosion.
StudySummary changed_summary(int seeds) {
  StudySummary summary = testing::summary_of(seeds);
  summary.builds = {"other"};
  for (ResultLine& line : summary.trials) {
    if (line.method != "erosion") continue;
    line.pooled.clear();
    for (TrialResult& result : line.results) {
      --result.counts[1].true_predicted;
      pool_into(line.pooled, result.counts);
    }
  }
  return summary;
}

TEST(BeforeAfter, PairsTheSameMethodSeedBySeed) {
  const ComparisonQuestion question{"", "", "cup", {"precision"}};
  const std::vector<ComparisonRow> rows =
      compare_results(testing::summary_of(10), changed_summary(10), question);
  ASSERT_EQ(rows.size(), 4u);
  for (const ComparisonRow& row : rows) {
    EXPECT_EQ(row.paired.difference.seeds, 10);
    EXPECT_NEAR(row.paired.difference.mean.value(), row.method == "erosion" ? -0.01 : 0.0, 1e-12);
  }
  EXPECT_EQ(rows[0].method, "direct");
  EXPECT_EQ(rows[1].method, "direct");
  EXPECT_EQ(rows[2].method, "erosion");
  EXPECT_NEAR(rows[2].paired.p.value(), 2.0 / 1024.0, 1e-12);
  EXPECT_NEAR(rows[2].p_holm.value(), 4 * 2.0 / 1024.0, 1e-12);
}

TEST(BeforeAfter, SaysInASentenceWhatMovedMost) {
  const Table table = before_after_table(testing::summary_of(10), changed_summary(10),
                                         {"", "", "cup", {"precision"}});
  EXPECT_EQ(table.columns.front(), "method");
  ASSERT_GE(table.caption.size(), 2u);
  EXPECT_EQ(table.caption[table.caption.size() - 2], "build build -> other");
  EXPECT_THAT(table.caption.back(), ::testing::HasSubstr("precision of erosion, cup at "));
  EXPECT_THAT(
      table.caption.back(),
      ::testing::HasSubstr("a difference of -0.0100 (95 % interval -0.0100 to -0.0100; 10 paired "
                           "seeds, p = 0.0020, 0.0078 by Holm over all rows)"));
}

TEST(BeforeAfter, TellsWhichSettingsDiffer) {
  StudySummary after = changed_summary(3);
  after.study.voxel_m = 0.1;
  const Table table = before_after_table(testing::summary_of(3), after, ComparisonQuestion());
  EXPECT_THAT(table.caption, ::testing::Contains("settings: voxel_m 0.05 -> 0.1"));
}

TEST(BeforeAfter, TakesTwoRecordingsWhereItIsTold) {
  StudySummary after = changed_summary(10);
  after.recording_hash = "other";
  after.study.scene = "other.xml";
  ComparisonQuestion question{"", "", "cup", {"precision"}};
  question.any_recording = true;
  const Table table = before_after_table(testing::summary_of(10), after, question);
  EXPECT_THAT(table.caption, ::testing::IsSupersetOf({"recording recordin -> other",
                                                      "settings: scene room.xml -> other.xml"}));
  EXPECT_EQ(table.rows,
            before_after_table(testing::summary_of(10), changed_summary(10), question).rows);
}

TEST(BeforeAfter, RefusesWhatDoesNotPair) {
  const StudySummary before = testing::summary_of(3);
  const auto expect_refused = [&](const std::string& why, auto change) {
    StudySummary after = changed_summary(3);
    change(after);
    mapscore::testing::expect_error(
        why, [&] { (void)compare_results(before, after, ComparisonQuestion()); });
  };
  expect_refused("recording recordin -> other",
                 [](StudySummary& s) { s.recording_hash = "other"; });
  expect_refused("so no draws pair", [](StudySummary& s) { s.study.seed = 77; });
  expect_refused("results after: its trials were made by 2 builds",
                 [](StudySummary& s) { s.builds.insert("third"); });
  expect_refused("no method at the same doses", [](StudySummary& s) {
    for (ResultLine& line : s.trials) line.method += " renamed";
  });
}

}  // namespace
}  // namespace mapscore::eval
