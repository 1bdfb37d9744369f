// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#include "eval/report/summary.hpp"

#include "tests/eval/report/pictures/swept_plate.hpp"
#include "tests/eval/report/synthetic_summary.hpp"
#include "tests/support/expect_error.hpp"

#include <gmock/gmock.h>

namespace mapscore::eval {
namespace {

using mapscore::testing::expect_error;
using ::testing::ElementsAre;
using ::testing::SizeIs;

using Summary = testing::SweptPlate;

TEST_F(Summary, HasALineForEachMethodAndCellBesideItsCeilings) {
  sweep();
  const StudySummary summary = summarise_store(results());
  EXPECT_THAT(summary.groups(), ElementsAre("pooled", "macro", "plate"));
  ASSERT_THAT(summary.trials, SizeIs(2));
  ASSERT_THAT(summary.registration_ceilings, SizeIs(2));
  ASSERT_THAT(summary.lattice_ceilings, SizeIs(2));
  EXPECT_EQ(loaded(summary.trials[1]).pooled.at(1).true_predicted, 12);
  EXPECT_EQ(loaded(summary.registration_ceilings[1]).pooled.at(1).true_predicted, 16);
  EXPECT_EQ(loaded(summary.lattice_ceilings[1]).pooled.at(1).found, 16);
  EXPECT_EQ(summary.lattice_ceilings[1].role, Role::lattice_ceiling);
}

TEST_F(Summary, EstimatesAreOfThePooledCounts) {
  sweep();
  const StudySummary summary = summarise_store(store_file());
  const ResultLine& shifted = summary.trials.at(1);
  for (const char* group : {"pooled", "macro", "plate"}) {
    EXPECT_EQ(estimate(shifted, summary.table, group, "precision").pooled, 0.75);
    EXPECT_EQ(estimate(shifted, summary.table, group, "recall").pooled, 0.75);
    EXPECT_EQ(estimate(shifted, summary.table, group, "iou").pooled, 12.0 / 20.0);
  }
  expect_error("guess", [&] { (void)estimate(shifted, summary.table, "plate", "guess"); });
  expect_error("'cup'", [&] { (void)estimate(shifted, summary.table, "cup", "f1"); });
}

TEST_F(Summary, IsRefusedWhileTrialsAreMissing) {
  expect_error("run `mapscore sweep` first", [&] { (void)summarise_store(results()); });
  sweep(1, 2);
  expect_error("2 of 3 trials are not there yet; run `mapscore sweep STUDY -o",
               [&] { (void)summarise_store(results()); });
  sweep(2, 2);
  EXPECT_THAT(summarise_store(results()).trials, SizeIs(2));
}

/// Figures formed while reading against those of the results themselves.
TEST_F(Summary, FiguresOfAStoredLineAreThoseOfItsResults) {
  sweep();
  const StudySummary summary = summarise_store(results());
  for (const auto* lines :
       {&summary.trials, &summary.registration_ceilings, &summary.lattice_ceilings})
    for (const ResultLine& line : *lines) {
      EXPECT_TRUE(line.results.empty()) << "they stay in the store";
      const ResultLine full = loaded(line);
      EXPECT_EQ(full.results.size(), line.seeds.size());
      EXPECT_EQ(pooled_counts(line, summary.table).predicted,
                pool_detected(full.pooled, summary.table).predicted);
      for (const std::string& group : summary.groups()) {
        const std::vector<Metric> metrics = metrics_of_group(full.pooled, summary.table, group);
        EXPECT_EQ(pooled_metrics(line, summary.table, group), metrics);
        std::vector<std::string> names{kBestF1, kBestThreshold};
        for (const Metric& metric : metrics) names.push_back(metric.name);
        for (const std::string& name : names) {
          const Estimate formed = estimate(line, summary.table, group, name);
          const Estimate plain = estimate(full, summary.table, group, name);
          EXPECT_EQ(formed.pooled, plain.pooled) << name;
          EXPECT_EQ(formed.by_seed, plain.by_seed) << name;
        }
      }
    }
}

TEST_F(Summary, FiguresOfAGroupThatWasNotAskedForAreFormedLater) {
  sweep();
  const StudySummary all = summarise_store(results());
  const StudySummary one = summarise_store(results(), {{"plate"}, false});
  EXPECT_EQ(estimate(one.trials[1], one.table, "macro", "f1").pooled,
            estimate(all.trials[1], all.table, "macro", "f1").pooled);
  EXPECT_EQ(one.lattice_note(), all.lattice_note());
  expect_error("'cup': not scored in this study; write one of pooled, macro, plate", [&] {
    (void)summarise_store(results(), {{"cup"}, false});
  });
}

TEST(Spread, IsCutOffAtWhatAMetricCanBe) {
  std::vector<std::optional<double>> values(9, 1.0);
  values.emplace_back(0.5);
  EXPECT_EQ(spread_of("f1", values).high, 1.0);
  EXPECT_GT(spread_of("accuracy_mean_m", values).high.value(), 1.0);
  for (auto& value : values) value = 1.0 - *value;
  EXPECT_EQ(spread_of("accuracy_mean_m", values).low, 0.0);
}

TEST_F(Summary, AnInterimOneHasTheLinesThatAreThereWithTheirCeilings) {
  sweep(1, 3);
  expect_error("no trial is there with both of its ceilings yet", [&] {
    (void)summarise_store(results(), {{}, true});
  });
  sweep(2, 3);
  const StudySummary interim = summarise_store(results(), {{}, true});
  EXPECT_EQ(interim.interim,
            "INTERIM: 2 of 3 trials and ceilings are there; figures will change; each has 1 of 1 "
            "seeds");
  ASSERT_THAT(interim.trials, SizeIs(1));
  EXPECT_THAT(interim.lattice_ceilings, SizeIs(1));
  sweep(3, 3);
  EXPECT_EQ(summarise_store(results(), {{}, true}).interim, "") << "it is complete";
}

TEST(Estimate, PoolsCountsAndNotRatios) {
  ResultLine line{Role::trial, "direct", {}, {0, 1}, {}, {}};
  for (const std::int64_t size : {10, 90}) {
    Counts counts(4);
    counts[1].predicted = size;
    counts[1].true_predicted = size == 10 ? 10 : 45;
    line.results.push_back({counts, {}});
    pool_into(line.pooled, counts);
  }
  const Estimate precision = estimate(line, testing::synthetic_table(), "cup", "precision");
  EXPECT_EQ(precision.pooled, 0.55);
  EXPECT_EQ(precision.over_seeds.mean, 0.75);
}

}  // namespace
}  // namespace mapscore::eval
