// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#include "core/error.hpp"
#include "sim/faults/label_noise.hpp"
#include "tests/sim/faults/depth_planes.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>

namespace mapscore::sim {
namespace {

using mapscore::testing::Moments;

/// Classes 1, 3 and 4 are detected; a thousand detections of each.
ClassTable three_classes() {
  ClassTable table;
  for (const ClassId id : {1, 2, 3, 4}) table.classes.push_back({id, "class", {}, id != 2});
  return table;
}

std::vector<Detection> detections() {
  std::vector<Detection> result;
  for (int i = 0; i < 3000; ++i) {
    Detection detection;
    detection.class_id = std::array<ClassId, 3>{1, 3, 4}[static_cast<std::size_t>(i % 3)];
    detection.instance = static_cast<InstanceId>(i + 1);
    result.push_back(detection);
  }
  return result;
}

/// Shares of the class that is named (column) by true class (row), over the detected classes.
std::array<std::array<double, 3>, 3> shares(const LabelDose& dose, int frames) {
  constexpr std::array<std::size_t, 5> kPlace{9, 0, 9, 1, 2};
  std::array<std::array<double, 3>, 3> result{};
  const std::vector<Detection> truth = detections();
  for (int frame = 0; frame < frames; ++frame) {
    std::vector<Detection> named = truth;
    corrupt_verdicts(named, three_classes(), dose, 3, frame);
    for (std::size_t i = 0; i < named.size(); ++i)
      result.at(kPlace.at(truth[i].class_id)).at(kPlace.at(named[i].class_id)) +=
          1.0 / (1000.0 * frames);
  }
  return result;
}

TEST(Verdicts, ConfusionFollowsItsMatrix) {
  const LabelDose dose{.confusion_matrix = {{0.8, 0.15, 0.05}, {0, 1, 0}, {0.3, 0.1, 0.6}}};
  const auto found = shares(dose, 1000);
  for (std::size_t i = 0; i < 3; ++i)
    for (std::size_t j = 0; j < 3; ++j)
      EXPECT_NEAR(found[i][j], dose.confusion_matrix[i][j], 0.02 * dose.confusion_matrix[i][j]);
}

TEST(Verdicts, ConfusionByARateIsEven) {
  for (const double rate : {0.1, 0.6, 1.0, 4.0}) {
    const auto found = shares({.confusion = rate}, 400);
    const double wrong = std::min(1.0, rate);
    for (std::size_t i = 0; i < 3; ++i)
      for (std::size_t j = 0; j < 3; ++j) {
        const double expected = i == j ? 1.0 - wrong : 0.5 * wrong;
        EXPECT_NEAR(found[i][j], expected, 0.02 * expected);
      }
  }
}

TEST(Verdicts, AGreaterDoseAddsErrorsToThoseOfALesser) {
  const std::vector<Detection> truth = detections();
  std::vector<Detection> few = truth, many = truth;
  corrupt_verdicts(few, three_classes(), {.confusion = 0.1}, 3, 0);
  corrupt_verdicts(many, three_classes(), {.confusion = 0.4}, 3, 0);
  int wrong = 0;
  for (std::size_t i = 0; i < truth.size(); ++i) {
    if (few[i].class_id == truth[i].class_id) continue;
    ++wrong;
    EXPECT_EQ(many[i].class_id, few[i].class_id);
  }
  EXPECT_GT(wrong, 200);
}

TEST(Verdicts, WithOneDetectedClassThereIsNoOther) {
  ClassTable table;
  table.classes.push_back({1, "person", {}, true});
  std::vector<Detection> one(1);
  one[0].class_id = 1;
  corrupt_verdicts(one, table, {.confusion = 1}, 1, 0);
  EXPECT_EQ(one[0].class_id, 1);
}

/// Scores of many verdicts, apart by whether the class is right.
struct Scores {
  Moments all, right, wrong;
  /// By tenth of the score: how many, how many right, and the sum.
  std::array<double, 10> count{}, hits{}, sums{};
};

Scores scores(const LabelDose& dose) {
  Scores found;
  const std::vector<Detection> truth = detections();
  for (int frame = 0; frame < 100; ++frame) {
    std::vector<Detection> named = truth;
    corrupt_verdicts(named, three_classes(), dose, 3, frame);
    for (std::size_t i = 0; i < named.size(); ++i) {
      const bool right = named[i].class_id == truth[i].class_id;
      const auto tenth = std::min<std::size_t>(9, static_cast<std::size_t>(named[i].score * 10));
      found.all.add(named[i].score);
      (right ? found.right : found.wrong).add(named[i].score);
      found.count.at(tenth) += 1;
      found.hits.at(tenth) += right;
      found.sums.at(tenth) += named[i].score;
    }
  }
  return found;
}

TEST(Verdicts, ScoresTellTheShareOfRightClasses) {
  const double m = 0.7, c = 10;
  const Scores found = scores({.confusion = 0.3, .scores = 1});
  EXPECT_NEAR(found.all.mean(), m, 0.02 * m);
  EXPECT_NEAR(found.all.sd(), std::sqrt(m * (1 - m) / (c + 1)), 0.02 * 0.14);
  EXPECT_NEAR(found.right.mean(), (c * m + 1) / (c + 1), 0.02 * 0.73);
  EXPECT_NEAR(found.wrong.mean(), c * m / (c + 1), 0.02 * 0.64);
  for (std::size_t tenth = 3; tenth < 10; ++tenth)
    EXPECT_NEAR(found.hits.at(tenth) / found.count.at(tenth),
                0.05 + 0.1 * static_cast<double>(tenth), 0.025);
}

TEST(Verdicts, ScoresTakeAMeanOfTheirOwn) {
  struct Case {
    double mean, confusion, concentration;
  };
  for (const auto& [mean, confusion, concentration] : std::vector<Case>{{0.9, 0, 4},
                                                                        {0.8, 0, 5},
                                                                        {0.8, 0.3, 5},
                                                                        {0.3, 0.3, 10},
                                                                        {0.99, 0.5, 10},
                                                                        {0.05, 0.1, 0.5},
                                                                        {0.6, 0.4, 10},
                                                                        {0.5, 0.95, 200},
                                                                        {0.4, 1, 2}}) {
    SCOPED_TRACE(::testing::Message() << mean << ' ' << confusion << ' ' << concentration);
    const Scores found = scores({.confusion = confusion,
                                 .scores = 1,
                                 .score_mean = mean,
                                 .score_concentration = concentration});
    const double sd = std::sqrt(mean * (1 - mean) / (concentration + 1));  // of Beta(a, b)
    EXPECT_NEAR(found.all.mean(), mean, 4.5 * sd / std::sqrt(found.all.count()));
    EXPECT_NEAR(found.all.sd(), sd, 0.02 * sd);
    const double right = 1 - confusion;
    for (std::size_t tenth = 0; tenth < 10; ++tenth) {  // what docs/methods.md says of a score
      if (found.count.at(tenth) < 1000) continue;
      const double score = found.sums.at(tenth) / found.count.at(tenth);
      const double share =
          mean > right ? right / mean * score : 1 - (1 - right) / (1 - mean) * (1 - score);
      EXPECT_NEAR(found.hits.at(tenth) / found.count.at(tenth), share,
                  4.5 * 0.5 / std::sqrt(found.count.at(tenth)));
    }
  }
}

TEST(Verdicts, ScoresOfClassesThatAreRightUnequallyOftenHaveOneMean) {
  const Scores found = scores({.scores = 1,
                               .confusion_matrix = {{0.9, 0.1, 0}, {0, 1, 0}, {0.5, 0.3, 0.2}},
                               .score_mean = 0.75});
  EXPECT_NEAR(found.all.mean(), 0.75, 4.5 * std::sqrt(0.75 * 0.25 / 11 / found.all.count()));
}

TEST(Verdicts, TheChanceOfARightClassIsTheMeanThatIsNotGiven) {
  std::vector<Detection> given = detections(), left_out = detections();
  corrupt_verdicts(given, three_classes(), {.confusion = 0.3, .scores = 1, .score_mean = 1 - 0.3},
                   3, 0);
  corrupt_verdicts(left_out, three_classes(), {.confusion = 0.3, .scores = 1}, 3, 0);
  for (std::size_t i = 0; i < given.size(); ++i) EXPECT_EQ(given[i].score, left_out[i].score);
}

TEST(Verdicts, MeansOfNoneAndAllAreThatScore) {
  for (const double confusion : {0.0, 0.3, 1.0})
    for (const double mean : {0.0, 1.0}) {
      const Scores found = scores({.confusion = confusion, .scores = 1, .score_mean = mean});
      EXPECT_EQ(found.all.mean(), mean) << confusion;
    }
}

TEST(Verdicts, TheDoseOfScoresIsHowFarTheyFall) {
  const Scores whole = scores({.scores = 1, .score_mean = 0.8});
  const Scores half = scores({.scores = 0.5, .score_mean = 0.8});
  EXPECT_NEAR(1 - half.all.mean(), 0.5 * (1 - whole.all.mean()), 1e-9);
  EXPECT_EQ(scores({.score_mean = 0.8}).all.mean(), 1.0);
}

TEST(Verdicts, ScoresAndClassesShareNoDraws) {
  std::vector<Detection> with = detections(), without = detections();
  corrupt_verdicts(with, three_classes(), {.confusion = 0.3, .scores = 1}, 3, 0);
  corrupt_verdicts(without, three_classes(), {.confusion = 0.3}, 3, 0);
  for (std::size_t i = 0; i < with.size(); ++i) EXPECT_EQ(with[i].class_id, without[i].class_id);
}

TEST(Verdicts, TheMatrixFitsTheDetectedClasses) {
  std::vector<Detection> some = detections();
  EXPECT_THROW(
      corrupt_verdicts(some, three_classes(), {.confusion_matrix = {{1, 0}, {0, 1}}}, 1, 0), Error);
}

}  // namespace
}  // namespace mapscore::sim
