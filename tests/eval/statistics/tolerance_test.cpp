// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#include "eval/statistics/tolerance.hpp"

#include "core/error.hpp"
#include "tests/eval/statistics/known_curves.hpp"

#include <gtest/gtest.h>

namespace mapscore::eval {
namespace {

TEST(ToleranceCoverage, HoldsTheThresholdOfKnownCurves) {
  // Few repeats, so that it is quick; tolerance_bench has a thousand.
  constexpr int kRepeats = 100;
  double sum = 0.0;
  int cases = 0;
  for (const KnownCurve& curve : known_curves()) {
    for (const Noise noise : {Noise::normal, Noise::binomial, Noise::heavy, Noise::growing}) {
      const Coverage coverage = coverage_of(curve, noise, kRepeats);
      EXPECT_GE(coverage.share, 0.87)
          << curve.name << ", " << names_of(noise)[static_cast<std::size_t>(noise)];
      sum += coverage.share;
      ++cases;
    }
  }
  EXPECT_GE(sum / cases, 0.94);
}

TEST(ToleranceCoverage, AnIntervalThatIsShiftedDoesNotCover) {
  // The test above can fail: the same searches against another threshold.
  KnownCurve curve = known_curves()[2];
  ASSERT_STREQ(curve.name, "logistic");
  EXPECT_NEAR(curve.threshold(), 22.0, 0.002);
  int held = 0;
  for (int repeat = 0; repeat < 50; ++repeat) {
    const Tolerance of = searched(curve, Noise::normal, static_cast<std::uint64_t>(repeat));
    held += of.low && of.high && *of.low <= 23.0 && *of.high >= 23.0 ? 1 : 0;
  }
  EXPECT_LE(held, 2);
}

TEST(ToleranceDifference, HoldsThatOfTheThresholdsAndGainsBySharedSeeds) {
  const std::vector<KnownCurve> curves = known_curves();
  for (const auto& [a, b] : {std::pair{0, 1}, {2, 3}, {8, 2}}) {
    for (const double common : {0.0, 0.9}) {
      const PairCoverage coverage = coverage_of_pairs(curves[a], curves[b], common, 100);
      EXPECT_GE(coverage.share, 0.87) << curves[a].name << " - " << curves[b].name;
      EXPECT_LT(coverage.half_width, (common > 0.0 ? 0.92 : 1.01) * coverage.if_unpaired)
          << curves[a].name << " - " << curves[b].name;
    }
  }
}

TEST(ToleranceDifference, OfTheSameSearchIsNothing) {
  const Tolerance of = searched(known_curves()[2], Noise::normal, 0);
  const Crossing difference = difference_of(of, of);
  EXPECT_EQ(difference.dose, 0.0);
  // Equal residuals leave the skew of the interval alone.
  EXPECT_NEAR(difference.low.value(), 0.0, 0.1 * (*of.high - *of.low));
  EXPECT_NEAR(difference.high.value(), 0.0, 0.1 * (*of.high - *of.low));
}

TEST(ToleranceDifference, OfACurveThatIsNotMonotoneIsNone) {
  Tolerance of = searched(known_curves()[2], Noise::normal, 0);
  const Tolerance other = of;
  of.verdict = ToleranceVerdict::not_monotone;
  of.dose.reset();
  EXPECT_FALSE(difference_of(of, other).low || difference_of(other, of).high);
}

TEST(ToleranceVerdict, SaysWhatIsNoCrossing) {
  for (const KnownCurve& curve : known_curves()) {
    const std::string name = curve.name;
    for (std::uint64_t repeat = 0; repeat < 20; ++repeat) {
      const Tolerance of = searched(curve, Noise::normal, repeat);
      if (name == "flat, above") {
        EXPECT_EQ(of.verdict, ToleranceVerdict::above);
        EXPECT_EQ(of.low, 60.0);
        EXPECT_FALSE(of.high || of.dose);
      } else if (name == "flat, below") {
        EXPECT_EQ(of.verdict, ToleranceVerdict::below);
        EXPECT_EQ(of.high, 0.0);
        EXPECT_FALSE(of.low || of.dose);
      }
      if (of.dose) {
        EXPECT_TRUE(*of.dose >= 0.0 && *of.dose <= 60.0);
      }
    }
  }
}

TEST(ToleranceVerdict, WarnsOfACurveThatCrossesThrice) {
  const KnownCurve curve = known_curves().back();
  ASSERT_TRUE(curve.crosses_again);
  const Coverage coverage = coverage_of(curve, Noise::normal, 50);
  EXPECT_GE(coverage.not_monotone, 0.8);
  EXPECT_GT(coverage.trials, 42.0);
  EXPECT_LE(coverage.trials, 48.0);
}

TEST(ToleranceSearch, IsRepeatableAndAsksForAFreshTrialEachTime) {
  const ToleranceSearch search{0.0, 11.0, 0.5, 42};
  const std::vector<double> coarse = next_doses(search, {});
  ASSERT_EQ(coarse.size(), 12u);
  for (std::size_t n = 0; n < coarse.size(); ++n)
    EXPECT_DOUBLE_EQ(coarse[n], static_cast<double>(n));
  std::vector<DoseTrial> trials;
  for (const double dose : coarse) trials.push_back({dose, dose < 5.2 ? 1.0 - 0.01 * dose : 0.2});
  const std::vector<double> fine = next_doses(search, trials);
  ASSERT_EQ(fine.size(), 10u);
  EXPECT_EQ(fine, next_doses(search, trials));
  EXPECT_DOUBLE_EQ(fine.front(), 4.0);  // 1.5 gaps of 1 about 5.5
  EXPECT_DOUBLE_EQ(fine.back(), 7.0);
}

TEST(ToleranceSearch, FindsTheFirstStepOfAStaircaseWithoutNoise) {
  // A time offset acts in steps of the depth camera's frames.
  const ToleranceSearch search{0.0, 300.0, -0.05, 42};
  std::vector<DoseTrial> trials;
  for (;;) {
    const std::vector<double> doses = next_doses(search, trials);
    if (doses.empty()) break;
    for (const double dose : doses)
      trials.push_back({dose, -0.2 * std::sqrt(std::round(dose / 14.3))});
  }
  const Tolerance of = tolerance_of(search, trials);
  EXPECT_EQ(of.verdict, ToleranceVerdict::found);
  EXPECT_TRUE(of.step);
  EXPECT_LE(of.low.value(), 7.15);
  EXPECT_GE(of.high.value(), 7.15);
  EXPECT_LT(*of.high - *of.low, 5.0);
}

TEST(ToleranceSearch, ScoresThatAreUndefinedAreCountedAndEndTheSearch) {
  const ToleranceSearch search{0.0, 11.0, 0.5, 42};
  std::vector<DoseTrial> trials;
  for (const double dose : next_doses(search, {}))
    trials.push_back({dose, dose < 4.5 ? std::optional(0.9) : std::nullopt});
  EXPECT_TRUE(next_doses(search, trials).empty());
  const Tolerance of = tolerance_of(search, trials);
  EXPECT_EQ(of.verdict, ToleranceVerdict::undefined);
  EXPECT_EQ(of.undefined, 7);
  EXPECT_FALSE(of.dose || of.low || of.high);
}

TEST(ToleranceSearch, RefusesWhatMakesNoSense) {
  EXPECT_THROW(static_cast<void>(next_doses({1.0, 1.0, 0.5, 42}, {})), Error);
  EXPECT_THROW(static_cast<void>(next_doses({0.0, 1.0, 0.5, kLeastTrials - 1}, {})), Error);
  EXPECT_THROW(static_cast<void>(tolerance_of({0.0, 1.0, 0.5, 42}, {})), Error);
}

}  // namespace
}  // namespace mapscore::eval
