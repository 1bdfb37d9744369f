// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#include "eval/report/tables/accounting_counts.hpp"

#include "eval/report/tables/pivot_table.hpp"
#include "tests/eval/report/synthetic_summary.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace mapscore::eval {
namespace {

using ::testing::Contains;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using testing::summary_of;

/// Two seeds: of 10 frames 6 and 7 are mapped; of 50 images 2 are lost in the second seed.
StudySummary tracked_summary() {
  StudySummary summary = summary_of(2);
  std::vector<TrialResult>& results = summary.trials.front().results;
  results[0].accounting.frames = results[1].accounting.frames = 10;
  results[0].accounting.frames_left_out = 4;
  results[1].accounting.frames_left_out = 3;
  results[0].accounting.tracking = TrackingCounts{.images_started = 1, .images_tracked = 49};
  results[1].accounting.tracking =
      TrackingCounts{.images_started = 1, .images_tracked = 47, .images_lost = 2};
  return summary;
}

TEST(AccountingFigures, AreTheMeanOverTheSeedsAndTheirRange) {
  const StudySummary summary = tracked_summary();
  const Estimate mapped = accounting_estimate(summary.trials.front(), "frames_mapped");
  EXPECT_EQ(mapped.pooled, 6.5);
  EXPECT_EQ(mapped.over_seeds.low, 6.0);
  EXPECT_EQ(mapped.over_seeds.high, 7.0);
  EXPECT_EQ(accounting_estimate(summary.trials.front(), "images_lost").pooled, 1.0);
  EXPECT_FALSE(accounting_estimate(summary.trials.back(), "images_lost").pooled)
      << "its poses come from elsewhere";
  EXPECT_FALSE(accounting_figure({}, "no_such_count"));
}

TEST(AccountingFigures, StandInTablesBesideOtherFigures) {
  const Table table = pivot_table(
      tracked_summary(), {.metrics = {"frames_mapped", "images_lost", "f1"}}, Reader::terminal);
  EXPECT_THAT(table.columns, Contains("images_lost"));
  ASSERT_FALSE(table.rows.empty());
  EXPECT_THAT(table.rows.front(), Contains("6.5"));
  EXPECT_THAT(table.rows.front(), Contains("1"));
  EXPECT_THAT(table.rows.back(), Contains("-"));
}

TEST(AccountingFigures, GuessedPosesAreNotedBelowATable) {
  EXPECT_THAT(accounting_notes(summary_of(2)), IsEmpty());
  EXPECT_THAT(
      accounting_notes(tracked_summary()),
      ElementsAre(
          "note: the pose of 2 of 100 depth images is a guess (unsure, blind, lost, "
          "restarted or relocated), in 1 of the 2 trials whose poses come from them; --metric "
          "images_lost shows where"));
  StudySummary dark = tracked_summary();
  TrackingCounts& tracking = *dark.trials.front().results[0].accounting.tracking;
  tracking.images_unsure = 1;
  tracking.images_blind = 3;
  dark.trials.front().results[1].accounting.tracking->images_lost = 0;
  EXPECT_THAT(accounting_notes(dark),
              Contains(HasSubstr("--metric images_unsure,images_blind shows where")));
  EXPECT_THAT(pivot_table(tracked_summary(), {.metrics = {"f1"}}, Reader::terminal).caption,
              Contains(HasSubstr("note: the pose of 2 of 100")));
}

TEST(AccountingFigures, RefusedCalibrationsAreNotedBelowATable) {
  StudySummary summary = summary_of(2);
  TrialResult& refused = summary.trials.front().results[0];
  refused.accounting.calibration = {.calibrations = 1, .calibration_error_um = 500};
  EXPECT_THAT(accounting_notes(summary), IsEmpty());
  refused.accounting.calibration->calibrations_refused = 1;
  EXPECT_THAT(accounting_notes(summary),
              ElementsAre(HasSubstr("1 of 1 estimates of the calibration were refused")));
  EXPECT_EQ(accounting_figure(refused.accounting, "calibration_error_um"), 500.0);
  EXPECT_FALSE(accounting_figure({}, "calibrations"));
}

}  // namespace
}  // namespace mapscore::eval
