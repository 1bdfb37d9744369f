// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#include "eval/report/regression.hpp"

#include "eval/report/regression_report.hpp"
#include "tests/eval/report/synthetic_summary.hpp"
#include "tests/support/expect_error.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <random>

namespace mapscore::eval {
namespace {

using mapscore::testing::expect_error;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::Not;

const std::vector<std::string> kMetrics{"precision", "recall", "f1", "iou"};

Judgement judged(const Baseline& before, const Baseline& after, double allowed = 0.002) {
  return judge(before, after, kMetrics, {allowed, {}});
}

/// Noise of one seed, class and method: shares of false and missed voxels.
struct Noise {
  double sd_of_seed = 0.0;    ///< drawn from `seed` alone, the same for every core
  double sd_of_change = 0.0;  ///< drawn anew at each call
};

/// Direct and erosion at two doses with 10 seeds. Of erosion's chairs a share `unmapped` of the
/// visible voxels is lost at the second dose.
StudySummary noisy_summary(std::uint64_t seed, const Noise& noise, double unmapped,
                           std::mt19937_64& random) {
  StudySummary summary = testing::summary_of(10);
  summary.study.seed = seed;
  std::mt19937_64 of_seed(seed);
  std::normal_distribution<double> normal;
  for (auto* lines : {&summary.trials, &summary.registration_ceilings})
    for (ResultLine& line : *lines) {
      line.pooled.clear();
      for (TrialResult& result : line.results) {
        for (const ClassId c : {1, 2}) {
          ClassCounts& counts = result.counts[c];
          const auto share = [&](double mean) {
            return mean + noise.sd_of_seed * normal(of_seed) + noise.sd_of_change * normal(random);
          };
          counts.visible = 4000;
          counts.predicted = 4000;
          counts.missed_unlabelled = std::llround(4000 * share(0.1));
          counts.missed_unmapped = 0;
          counts.false_near = std::llround(4000 * share(0.1));
          if (line.role == Role::trial && line.method == "erosion" && c == 2 &&
              line.cell.index == 1)
            counts.missed_unmapped = std::llround(4000 * unmapped);
          counts.missed_mislabelled = counts.false_leak = counts.false_floating = 0;
          counts.true_predicted = counts.predicted - counts.false_near;
          counts.found = counts.visible - counts.missed_unlabelled - counts.missed_unmapped;
        }
        pool_into(line.pooled, result.counts);
      }
    }
  return summary;
}

/// A share of the visible voxels that costs 2 points of F1 where precision and recall are .9.
constexpr double kTwoPoints = 0.0391;

TEST(Regression, EqualResultsHoldAndNothingChanged) {
  const Baseline baseline = baseline_of(testing::summary_of(3));
  const Judgement judgement = judged(baseline, baseline, 0.0);
  EXPECT_FALSE(judgement.fell());
  EXPECT_TRUE(judgement.compared());
  EXPECT_EQ(judgement.changed, 0u);
  EXPECT_EQ(judgement.trials, baseline.lines.size() * 3);
  EXPECT_EQ(judgement.count(Standing::held), judgement.figures.size());
}

TEST(Regression, RepeatsWithOtherSeedsHold) {
  std::mt19937_64 random(7);
  const Noise noise{0.004, 0.0};
  const Baseline before = baseline_of(noisy_summary(1, noise, 0.0, random));
  for (std::uint64_t seed = 2; seed < 22; ++seed) {
    const Judgement judgement =
        judged(before, baseline_of(noisy_summary(seed, noise, 0.0, random)));
    EXPECT_FALSE(judgement.same_seeds);
    EXPECT_TRUE(judgement.compared());
    EXPECT_FALSE(judgement.fell()) << seed << regression_report(judgement, "", "text");
  }
}

/// How many of 20 losses of 2 points in chairs are caught, and named first among F1.
int caught(bool other_seeds, const Noise& noise) {
  std::mt19937_64 random(11);
  int caught = 0;
  for (std::uint64_t trial = 1; trial <= 20; ++trial) {
    const Baseline before = baseline_of(noisy_summary(trial, noise, 0.0, random));
    const Judgement judgement = judged(
        before,
        baseline_of(noisy_summary(other_seeds ? 100 + trial : trial, noise, kTwoPoints, random)));
    const auto worst = std::ranges::find(judgement.figures, "f1", &JudgedFigure::metric);
    EXPECT_NE(worst, judgement.figures.end());
    caught += worst->verdict == Standing::worse && worst->method == "erosion" &&
                      worst->group == "chair" && worst->cell.index == 1 && !worst->grown.empty() &&
                      worst->grown.front().first == "unmapped"
                  ? 1
                  : 0;
  }
  return caught;
}

TEST(Regression, CatchesTwoPointsOfF1InOneClassOnTheSameSeeds) {
  EXPECT_GE(caught(false, {0.03, 0.0}), 20);  // however much seeds differ
  EXPECT_GE(caught(false, {0.03, 0.01}), 19);
}

TEST(Regression, CatchesTwoPointsOfF1InOneClassOnOtherSeeds) {
  EXPECT_GE(caught(true, {0.004, 0.0}), 19);
}

TEST(Regression, FewOtherSeedsAreNotJudged) {
  StudySummary before = testing::summary_of(9), after = testing::summary_of(9);
  after.study.seed = before.study.seed + 1;
  const Judgement judgement = judged(baseline_of(before), baseline_of(after));
  EXPECT_FALSE(judgement.compared());
  EXPECT_FALSE(judgement.fell());
  EXPECT_EQ(judgement.count(Standing::not_judged), judgement.figures.size());
}

TEST(Regression, OnTheSameSeedsAFigureFallsByMoreThanIsAllowed) {
  const Baseline before = baseline_of(testing::summary_of(2));
  Baseline after = before;
  // 1 of 200 predicted cups of direct at dose 0, both seeds together.
  ResultLine& line = after.lines[0];
  --line.results[0].counts[1].true_predicted;
  ++line.results[0].counts[1].false_leak;
  line.pooled.clear();
  for (const TrialResult& result : line.results) pool_into(line.pooled, result.counts);
  EXPECT_TRUE(judged(before, after, 0.0049).fell());
  EXPECT_FALSE(judged(before, after, 0.0051).fell());
  const Judgement judgement = judge(before, after, {"precision"}, {0.002, {{{"cup", ""}, 0.006}}});
  EXPECT_EQ(judgement.changed, 1u);
  EXPECT_EQ(judgement.count(Standing::worse), 2u);  // pooled and macro, by 0.0025
  EXPECT_THAT(judgement.figures[0].grown,
              ElementsAre(std::pair<std::string, std::int64_t>("leak", 1)));
  const Judgement back = judged(after, before, 0.0049);
  EXPECT_FALSE(back.fell());
  EXPECT_GT(back.count(Standing::better), 0u);
}

TEST(Regression, WhatIsGoneIsAsBadAsWorse) {
  const Baseline before = baseline_of(testing::summary_of(2));
  Baseline after = before;
  std::erase_if(after.lines, [](const ResultLine& line) { return line.method == "erosion"; });
  const Judgement judgement = judged(before, after);
  EXPECT_TRUE(judgement.fell());
  EXPECT_TRUE(judgement.compared());
  EXPECT_EQ(judgement.figures[0].verdict, Standing::missing);
  EXPECT_EQ(judgement.figures[0].method, "erosion");
  EXPECT_FALSE(judged(after, before).fell()) << "what is new falls nowhere";
  after.lines.clear();
  EXPECT_FALSE(judged(before, after).compared());
}

/// A class that only one seed of the baseline saw predicted: other seeds may not see it at all.
TEST(Regression, WhatSomeSeedsOfTheBaselineLackIsNotMissedOnOthers) {
  StudySummary summary = testing::summary_of(10);
  const auto without_chairs = [](ResultLine& line, std::size_t from) {
    line.pooled.clear();
    for (std::size_t n = 0; n < line.results.size(); ++n) {
      if (n >= from) line.results[n].counts[2] = ClassCounts{};
      pool_into(line.pooled, line.results[n].counts);
    }
  };
  for (ResultLine& line : summary.trials) without_chairs(line, 1);
  const Baseline before = baseline_of(summary);
  for (ResultLine& line : summary.trials) without_chairs(line, 0);
  Baseline after = baseline_of(summary);
  EXPECT_GT(judged(before, after).count(Standing::missing), 0u);  // the same seeds
  after.study.seed = before.study.seed + 1;
  EXPECT_EQ(judged(before, after).count(Standing::missing), 0u);
}

TEST(Regression, SeedsPairByTheirIndex) {
  const Baseline before = baseline_of(testing::summary_of(3));
  Baseline after = before;
  for (ResultLine& line : after.lines) {
    std::ranges::reverse(line.seeds);
    std::ranges::reverse(line.results);
  }
  const Judgement judgement = judged(before, after, 0.0);
  EXPECT_EQ(judgement.changed, 0u);
  for (const JudgedFigure& figure : judgement.figures) {
    EXPECT_EQ(figure.difference.low, 0.0);
    EXPECT_EQ(figure.difference.high, 0.0);
  }
}

TEST(Regression, FewerSeedsAreTold) {
  const Judgement judgement =
      judged(baseline_of(testing::summary_of(3)), baseline_of(testing::summary_of(2)));
  EXPECT_FALSE(judgement.fell());
  EXPECT_THAT(regression_report(judgement, "", "text"), HasSubstr("; 2 of the baseline's 3 seeds"));
}

TEST(Regression, WhatIsNotJudgedDoesNotHold) {
  Judgement judgement;
  judgement.same_seeds = false;
  judgement.figures.resize(3);
  judgement.figures[2].verdict = Standing::not_judged;
  EXPECT_THAT(regression_report(judgement, "x", "text"),
              HasSubstr("2 of 3 figures hold, 1 not judged"));
}

TEST(Regression, OtherSettingsDoNotCompare) {
  const Baseline before = baseline_of(testing::summary_of(2));
  const auto expect_not_comparable = [&](const std::string& why, auto change) {
    Baseline after = before;
    change(after);
    expect_error("not comparable: " + why, [&] { (void)judged(before, after); });
  };
  expect_not_comparable("scoring version 3 -> 4", [](Baseline& b) { b.scoring_version = 4; });
  expect_not_comparable("voxel_m 0.05 -> 0.1", [](Baseline& b) { b.study.voxel_m = 0.1; });
  expect_not_comparable("methods.erosion.segmentation direct -> erosion",
                        [](Baseline& b) { b.study.methods.at(1).segmentation = Erosion{7}; });
  expect_not_comparable("recording recordin -> other",
                        [](Baseline& b) { b.recording_hash = "other"; });
  expect_not_comparable("classes chair cup -> chair cup tv", [](Baseline& b) {
    b.table.classes.push_back({3, "tv", {}, true});
  });
  expect_not_comparable("classes chair cup -> chair",
                        [](Baseline& b) { b.table.classes.at(1).detect = false; });
  expect_not_comparable("cameras.width_px 640 -> 320, recording", [](Baseline& b) {
    b.study.cameras.width_px = 320;
    b.recording_hash = "other";
  });
  Baseline elsewhere = before;
  elsewhere.study.cameras.width_px = 320;
  EXPECT_FALSE(judged(before, elsewhere).fell()) << "the same recording stands for its cameras";
  elsewhere = before;
  elsewhere.recording_hash = "other";
  elsewhere.study.name = "renamed";
  elsewhere.study.methods.at(1).title = "Erosion";
  elsewhere.study.class_titles["cup"] = "mug";
  elsewhere.study.seeds = 5;
  EXPECT_FALSE(judge(before, elsewhere, kMetrics, {}, true).same_recording);
}

TEST(Regression, LessIsBetterOfDistances) {
  for (const char* metric :
       {"f1", "precision", "recall_2cm", "f_2cm", "ap", "ap_mean", "nees_share"})
    EXPECT_TRUE(higher_is_better(metric)) << metric;
  for (const char* metric : {"accuracy_mean_m", "completeness_p95_m", "brier", "ece", "ate_m",
                             "ate_deg", "rpe_percent", "rpe_deg_per_m", "nees_mean"})
    EXPECT_FALSE(higher_is_better(metric)) << metric;
  JudgedFigure figure;
  figure.metric = "accuracy_mean_m";
  figure.before = 0.01;
  figure.after = 0.03;
  EXPECT_DOUBLE_EQ(figure.gain().value(), -0.02);
}

TEST(Tolerances, TheMostSpecialOneHolds) {
  const Tolerances allowed = parse_tolerances({"0.01", "f1=0.02", "chair/=0.03", "chair/f1=0.04"});
  EXPECT_EQ(allowed.of("cup", "iou"), 0.01);
  EXPECT_EQ(allowed.of("cup", "f1"), 0.02);
  EXPECT_EQ(allowed.of("chair", "iou"), 0.03);
  EXPECT_EQ(allowed.of("chair", "f1"), 0.04);
  for (const char* bad : {"nan", "f1=", "=0.1", "f1=2", "-0.1", "x"})
    expect_error("--allow", [&] { (void)parse_tolerances({bad}); });
  expect_error("--allow f1: stands there twice", [] {
    (void)parse_tolerances({"f1=0.1", "f1=0.2"});
  });
}

TEST(Tolerances, AClassMayHoldSlashesAndEqualsSigns) {
  const Tolerances allowed =
      parse_tolerances({"lamp/desk/f1=0.02", "lamp/desk/=0.03", "a=b/f1=0.04", "a/b=1/=0.05"});
  EXPECT_EQ(allowed.of("lamp/desk", "f1"), 0.02);
  EXPECT_EQ(allowed.of("lamp/desk", "iou"), 0.03);
  EXPECT_EQ(allowed.of("a=b", "f1"), 0.04);
  EXPECT_EQ(allowed.of("a/b=1", "f1"), 0.05);
}

class RegressionReport : public ::testing::Test {
 protected:
  RegressionReport() {
    std::mt19937_64 random(3);
    const Noise none{0.01, 0.0};
    judgement_ = judged(baseline_of(noisy_summary(1, none, 0.0, random)),
                        baseline_of(noisy_summary(1, none, kTwoPoints, random)));
  }
  [[nodiscard]] std::string report(const char* format) const {
    return regression_report(judgement_, "results/x", format);
  }
  Judgement judgement_;
};

TEST_F(RegressionReport, NamesMethodMetricClassCellAndCause) {
  const std::string text = report("text");
  EXPECT_THAT(text, HasSubstr("worse    erosion  recall  chair   1 of 2  magnitude_m=0.01"));
  EXPECT_THAT(text, HasSubstr("unmapped +1560"));
  EXPECT_THAT(text, HasSubstr("figures got worse"));
  EXPECT_THAT(text, HasSubstr("changed: 10 of "));
  EXPECT_THAT(text, Not(HasSubstr("direct")));
}

TEST_F(RegressionReport, ALongOneBeginsWithTheClasses) {
  const std::string text = report("text");
  EXPECT_TRUE(text.starts_with("class   figures worse  cells worse  worst change  metric")) << text;
  // Recall, F1 and IoU of erosion at one of two doses.
  EXPECT_THAT(text,
              ::testing::ContainsRegex("\nchair +3 of [0-9]+ +1 of 2 +-0.0[0-9]+ +(iou|recall) "
                                       "+erosion +magnitude_m=0.01\n"));
  EXPECT_THAT(text, Not(HasSubstr("\ncup ")));
  std::erase_if(judgement_.figures, [](const JudgedFigure& f) { return f.group != "chair"; });
  EXPECT_TRUE(report("text").starts_with("verdict")) << "a handful of rows";
}

TEST_F(RegressionReport, NamesTheFramesThatLostMost) {
  EXPECT_EQ(judgement_.worst()->method, "erosion");
  judgement_.trace = {"erosion", judgement_.worst()->cell, "chair", {{7, {100, 5}, {80, 9}}}};
  for (const char* format : {"text", "markdown", "github", "junit"})
    EXPECT_THAT(report(format),
                ::testing::ContainsRegex("chair of erosion, first seed, at magnitude_m=0.01.*"
                                         "frame 7 found 100 -(>|&gt;) 80, false 5 -(>|&gt;) 9"))
        << format;
  judgement_.trace->losses.clear();
  EXPECT_THAT(report("text"), HasSubstr("no frame by itself lost voxels"));
}

TEST_F(RegressionReport, SpeaksToCi) {
  EXPECT_THAT(report("github"),
              HasSubstr("::error title=mapscore check::recall of erosion, chair"));
  EXPECT_THAT(report("junit"),
              HasSubstr("<testcase classname=\"erosion\" name=\"f1 chair\" time=\"0\"><failure"));
  EXPECT_THAT(report("junit"),
              HasSubstr("<testcase classname=\"direct\" name=\"f1 chair\" time=\"0\"/>"));
  EXPECT_THAT(report("markdown"), HasSubstr("| worse | erosion | recall | chair |"));
  EXPECT_THAT(report("csv"), HasSubstr("trial,erosion,magnitude_m=0.01,chair,f1,"));
  EXPECT_THAT(report("json"), HasSubstr("\"verdict\": \"worse\""));
  expect_error("no format", [&] { (void)report("xml"); });
}

}  // namespace
}  // namespace mapscore::eval
