// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#include "core/fusion/fusion_rule.hpp"

#include "core/error.hpp"
#include "core/mapping/semantic_map.hpp"
#include "core/random_stream.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace mapscore {
namespace {

constexpr int kClasses = 6;

/// A rule as the suite below runs it.
template <class Rule>
Rule rule_of() {
  return {};
}
template <>
BlendRule rule_of<BlendRule>() {
  return {0.3};
}
template <>
BayesRule rule_of<BayesRule>() {
  return {{0.4, 0.1, 0.2, 0.05, 0.05, 0.2}, 0.05};
}
template <>
Top3Rule rule_of<Top3Rule>() {
  return {kClasses, 0.9, 0.05};
}

/// Hits of one voxel in one frame of N = 10 draws.
std::vector<VoxelHit> random_hits(RandomStream& stream) {
  std::vector<VoxelHit> hits;
  int left = 10;
  for (ClassId c = 0; c < kClasses && left > 0; ++c) {
    if (stream.uniform() < 0.6) continue;
    const int draws = 1 + static_cast<int>(stream.bits() % static_cast<std::uint64_t>(left));
    hits.push_back({{}, c, draws, draws * stream.uniform()});
    left -= draws;
  }
  if (hits.empty()) hits.push_back({{}, 2, 10, 10.0});
  return hits;
}

template <class Rule>
class EveryRule : public ::testing::Test {};
using Rules = ::testing::Types<BlendRule, MaxConfidenceRule, VoteRule, BayesRule, Top3Rule>;
TYPED_TEST_SUITE(EveryRule, Rules);

TYPED_TEST(EveryRule, StaysNormalisedOverAHundredThousandUpdates) {
  const auto rule = rule_of<TypeParam>();
  RandomStream stream(3, "normalised");
  ClassBeliefs beliefs;
  for (int update = 0; update < 100000; ++update) {
    fuse(rule, random_hits(stream), 10, beliefs);
    double sum = 0.0;
    int last = -1;
    for (const ClassProbability& entry : beliefs.entries()) {
      const double p = entry.probability / beliefs.divisor();
      ASSERT_TRUE(p >= 0.0 && p <= 1.0 + 1e-12) << update;
      ASSERT_GT(entry.class_id, last) << update;
      last = entry.class_id;
      sum += p;
    }
    ASSERT_LE(sum, 1.0 + 1e-12) << update;
    if constexpr (!std::is_same_v<TypeParam, BlendRule> &&
                  !std::is_same_v<TypeParam, MaxConfidenceRule>) {
      ASSERT_NEAR(sum, 1.0, 1e-12) << update;
    }
  }
}

TYPED_TEST(EveryRule, AVoxelAmongOthersInAMapBelievesWhatItWouldAlone) {
  constexpr int kVoxels = 30;
  const FusionRule rule = rule_of<TypeParam>();
  RandomStream stream(5, "bits");
  SemanticMap map(0.05);
  std::vector<ClassBeliefs> alone(kVoxels);
  for (int frame = 0; frame < 40; ++frame) {
    std::vector<VoxelHit> of_frame;
    for (int i = 0; i < kVoxels; ++i) {
      if (stream.uniform() < 0.5) continue;
      std::vector<VoxelHit> hits = random_hits(stream);
      fuse(rule, hits, 10, alone[i]);
      for (VoxelHit& hit : hits) hit.key = {i, 0, 0};
      of_frame.insert(of_frame.end(), hits.begin(), hits.end());
    }
    map.fuse(of_frame, 10, rule);
  }
  ASSERT_EQ(map.voxels().size(), alone.size());
  for (const MapVoxel& voxel : map.voxels()) {
    const ClassProbability expected = alone[voxel.key.i].best();
    EXPECT_EQ(voxel.best_class, expected.class_id) << voxel.key.i;
    EXPECT_EQ(voxel.probability, expected.probability) << voxel.key.i;
  }
}

TYPED_TEST(EveryRule, AFirstFullHitGivesWhatTheRulesFormulaSays) {
  const FusionRule rule = rule_of<TypeParam>();
  // Blend: 1 - K. Bayes and top-3: a score of 1 less their doubt, 0.05. The others: all of it.
  double expected = 1.0;
  if constexpr (std::is_same_v<TypeParam, BlendRule>) expected = 0.7;
  if constexpr (std::is_same_v<TypeParam, BayesRule> || std::is_same_v<TypeParam, Top3Rule>)
    expected = 0.95;
  ClassBeliefs beliefs;
  fuse(rule, std::vector<VoxelHit>{{{}, 3, 10, 10.0}}, 10, beliefs);
  EXPECT_EQ(beliefs.best().class_id, 3);
  EXPECT_NEAR(beliefs.best().probability, expected, 1e-15);
  EXPECT_NEAR(first_full_hit(rule), expected, 1e-15);
}

TYPED_TEST(EveryRule, TheClassSeenMostOftenIsBelieved) {
  const FusionRule rule = rule_of<TypeParam>();
  ClassBeliefs beliefs;
  for (int frame = 0; frame < 9; ++frame)
    fuse(rule, std::vector<VoxelHit>{{{}, frame == 3 ? ClassId{1} : ClassId{4}, 10, 9.0}}, 10,
         beliefs);
  // Under max confidence all frames are equally sure, and the lower id stays.
  const ClassId expected = std::is_same_v<TypeParam, MaxConfidenceRule> ? 1 : 4;
  EXPECT_EQ(beliefs.best().class_id, expected);
}

TYPED_TEST(EveryRule, MergedHalvesAreTheWholeWhereTheRuleAllowsIt) {
  const FusionRule rule = rule_of<TypeParam>();
  RandomStream stream(7, "halves");
  for (int round = 0; round < 200; ++round) {
    ClassBeliefs whole, first, second;
    for (int frame = 0; frame < 12; ++frame) {
      const auto hits = random_hits(stream);
      fuse(rule, hits, 10, whole);
      fuse(rule, hits, 10, frame < 6 ? first : second);
    }
    if constexpr (std::is_same_v<TypeParam, BlendRule>) {
      ASSERT_THROW((void)merged(rule, first, second), Error);
    } else if constexpr (std::is_same_v<TypeParam, Top3Rule>) {
      double sum = 0.0;
      const ClassBeliefs both = merged(rule, first, second);
      for (const ClassProbability& entry : both.entries()) sum += entry.probability;
      ASSERT_NEAR(sum, 1.0, 1e-12) << "not the whole, but a distribution";
    } else {
      const ClassBeliefs both = merged(rule, first, second);
      ASSERT_EQ(both.entries().size(), whole.entries().size());
      for (const ClassProbability& entry : whole.entries())
        ASSERT_NEAR(both.weight(entry.class_id), entry.probability, 1e-9 * entry.probability);
      ASSERT_EQ(merged(rule, {}, whole), whole);
      ASSERT_EQ(merged(rule, whole, {}), whole);
    }
  }
}

TYPED_TEST(EveryRule, AnInnerNodeOfOneChildOrOfEqualsBelievesItsBestClass) {
  const FusionRule rule = rule_of<TypeParam>();
  ClassBeliefs child;
  fuse(rule, std::vector<VoxelHit>{{{}, 1, 3, 3.0}, {{}, 5, 7, 6.0}}, 10, child);
  const std::array<const ClassBeliefs*, 8> one{nullptr, nullptr, &child};
  EXPECT_EQ(combined(rule, one), child);
  std::array<const ClassBeliefs*, 8> eight;
  eight.fill(&child);
  EXPECT_EQ(combined(rule, eight).best().class_id, child.best().class_id);
  EXPECT_TRUE(combined(rule, {}).empty());
}

// --- by hand -------------------------------------------------------------------------------------

TEST(FusionByHand, MaxConfidenceKeepsTheSurestFrame) {
  ClassBeliefs beliefs;
  fuse(MaxConfidenceRule{}, std::vector<VoxelHit>{{{}, 1, 2, 1.0}, {{}, 2, 2, 1.8}}, 4, beliefs);
  EXPECT_EQ(beliefs.best(), (ClassProbability{2, 0.45}));
  fuse(MaxConfidenceRule{}, std::vector<VoxelHit>{{{}, 3, 4, 1.6}}, 4, beliefs);
  EXPECT_EQ(beliefs.best(), (ClassProbability{2, 0.45})) << "0.4 is less";
  fuse(MaxConfidenceRule{}, std::vector<VoxelHit>{{{}, 1, 3, 3.0}}, 4, beliefs);
  EXPECT_EQ(beliefs.best(), (ClassProbability{1, 0.75}));
}

TEST(FusionByHand, VoteCountsDraws) {
  ClassBeliefs beliefs;
  fuse(VoteRule{}, std::vector<VoxelHit>{{{}, 1, 3, 0.3}, {{}, 2, 1, 1.0}}, 4, beliefs);
  EXPECT_EQ(beliefs.best(), (ClassProbability{1, 0.75}));
  fuse(VoteRule{}, std::vector<VoxelHit>{{{}, 2, 4, 4.0}}, 4, beliefs);
  EXPECT_EQ(beliefs.best(), (ClassProbability{2, 5.0 / 8.0}));
}

TEST(FusionByHand, OneVoteIsCertain) {
  ClassBeliefs beliefs;
  fuse(VoteRule{}, std::vector<VoxelHit>{{{}, 1, 1, 0.2}}, 30, beliefs);
  EXPECT_EQ(beliefs.best(), (ClassProbability{1, 1.0}));
}

TEST(FusionByHand, BayesMultipliesAndDividesByThePrior) {
  const BayesRule rule{{0.5, 0.2, 0.3}, 0.05};
  ClassBeliefs beliefs;
  fuse(rule, std::vector<VoxelHit>{{{}, 1, 1, 0.7}}, 1, beliefs);
  // p(c | z): 0.7, and 0.3 over classes 0 and 2 as 5 to 3.
  EXPECT_NEAR(beliefs.weight(1), 0.7, 1e-15);
  EXPECT_NEAR(beliefs.weight(kOtherClasses), 0.3, 1e-15);
  fuse(rule, std::vector<VoxelHit>{{{}, 2, 1, 1.0}}, 1, beliefs);
  // Second frame: class 2 0.95 (doubt), classes 0 and 1 share 0.05 as 5 to 2.
  const double w0 = 0.3 * 5 / 8 * (0.05 * 5 / 7) / 0.5, w1 = 0.7 * (0.05 * 2 / 7) / 0.2,
               w2 = 0.3 * 3 / 8 * 0.95 / 0.3, sum = w0 + w1 + w2;
  EXPECT_NEAR(beliefs.weight(1), w1 / sum, 1e-14);
  EXPECT_NEAR(beliefs.weight(2), w2 / sum, 1e-14);
  EXPECT_NEAR(beliefs.weight(kOtherClasses), w0 / sum, 1e-14);
}

TEST(FusionByHand, DrawsThatMissedSayThePriorUnderBayes) {
  const BayesRule rule{{0.5, 0.2, 0.3}, 0.05};
  ClassBeliefs beliefs;
  fuse(rule, std::vector<VoxelHit>{{{}, 1, 1, 0.9}}, 4, beliefs);
  EXPECT_NEAR(beliefs.weight(1), (0.9 + 3 * 0.2) / 4, 1e-15);
  EXPECT_NEAR(beliefs.weight(kOtherClasses), (0.1 + 3 * 0.8) / 4, 1e-15);
}

TEST(FusionByHand, BayesKeepsOthersExactlyAsIfAllClassesWereNamed) {
  const auto rule = rule_of<BayesRule>();
  RandomStream stream(9, "others");
  ClassBeliefs beliefs;
  std::array<double, kClasses> full;
  std::copy(rule.priors.begin(), rule.priors.end(), full.begin());
  for (int frame = 0; frame < 6; ++frame) {
    const auto c = static_cast<ClassId>(1 + stream.bits() % 3);  // 0, 4 and 5 are never seen
    const double s = 0.1 + 0.8 * stream.uniform();
    fuse(rule, std::vector<VoxelHit>{{{}, c, 1, s}}, 1, beliefs);
    double sum = 0.0;
    for (std::size_t k = 0; k < kClasses; ++k)
      sum += full[k] *= k == c ? s / rule.priors[k] : (1 - s) / (1 - rule.priors[c]);
    for (double& p : full) p /= sum;
  }
  for (ClassId c = 1; c <= 3; ++c)
    if (beliefs.weight(c) > 0.0) {
      EXPECT_NEAR(beliefs.weight(c), full[c], 1e-12);
    }
  double unseen = 0.0;
  for (ClassId c = 0; c < kClasses; ++c)
    if (beliefs.weight(c) == 0.0) unseen += full[c];
  EXPECT_NEAR(beliefs.weight(kOtherClasses), unseen, 1e-12);
}

TEST(FusionByHand, Top3SplitsMissingClassesOffTheRest) {
  const Top3Rule rule{5, 0.9, 0.05};
  ClassBeliefs beliefs;
  fuse(rule, std::vector<VoxelHit>{{{}, 1, 1, 0.8}}, 1, beliefs);
  EXPECT_NEAR(beliefs.weight(1), 0.8, 1e-15);
  EXPECT_NEAR(beliefs.weight(kOtherClasses), 0.2, 1e-15);
  fuse(rule, std::vector<VoxelHit>{{{}, 2, 1, 0.6}}, 1, beliefs);
  // {1: 0.8, 2: 0.9 * 0.2, rest 0.1 * 0.2} times {1: 0.9 * 0.4, 2: 0.6, rest 0.1 * 0.4}
  const double w1 = 0.8 * 0.36, w2 = 0.18 * 0.6, rest = 0.02 * 0.04, sum = w1 + w2 + rest;
  EXPECT_NEAR(beliefs.weight(1), w1 / sum, 1e-14);
  EXPECT_NEAR(beliefs.weight(2), w2 / sum, 1e-14);
  EXPECT_NEAR(beliefs.weight(kOtherClasses), rest / sum, 1e-14);
}

TEST(FusionByHand, Top3NeverNamesMoreThanThree) {
  const auto rule = rule_of<Top3Rule>();
  RandomStream stream(2, "three");
  ClassBeliefs beliefs;
  for (int frame = 0; frame < 500; ++frame) {
    fuse(rule, random_hits(stream), 10, beliefs);
    ASSERT_LE(beliefs.entries().size(), 4u);
  }
}

TEST(FusionByHand, ABlendDecaysWhatWasThere) {
  ClassBeliefs beliefs({{1, 0.5}, {2, 1.5e-6}});
  decay(BlendRule{0.5}, beliefs);
  EXPECT_EQ(beliefs, ClassBeliefs({{1, 0.25}})) << "what falls below 1e-6 is forgotten";
}

// --- bad input -----------------------------------------------------------------------------------

TEST(FusionInput, RulesOutOfRangeAreRefused) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  for (const double K : {-0.1, 1.1, nan}) EXPECT_THROW(check(BlendRule{K}), Error) << K;
  EXPECT_NO_THROW(check(BlendRule{0.0}));
  EXPECT_THROW(check(BlendRule{1.0}), Error) << "it would never map anything";
  EXPECT_THROW(check(BayesRule{{1.0}}), Error);
  EXPECT_THROW(check(BayesRule{{0.5, 0.4}}), Error);
  EXPECT_THROW(check(BayesRule{{1.5, -0.5}}), Error);
  EXPECT_THROW(check(BayesRule{{0.5, 0.5}, 0.0}), Error);
  EXPECT_THROW(check(BayesRule{{0.5, 0.5}, 0.5}), Error);
  EXPECT_THROW(check(Top3Rule{1}), Error);
  for (const double lambda : {0.0, 1.0, nan}) EXPECT_THROW(check(Top3Rule{3, lambda}), Error);
  EXPECT_THROW((void)uniform_priors(1), Error);
}

class Refused : public ::testing::Test {
 protected:
  void SetUp() override { map_.fuse(good_, 2, VoteRule{}); }
  void expect_refused(std::vector<VoxelHit> hits, int draws, const FusionRule& rule,
                      std::size_t classes = kOtherClasses) {
    hits.insert(hits.begin(), {{-9, 0, 0}, 0, 1, 1.0});
    EXPECT_THROW(map_.fuse(hits, draws, rule, classes), Error);
    EXPECT_EQ(map_.voxels().size(), 1u) << "the map must stay as it was";
    EXPECT_EQ(map_.voxels().front().best_class, 1);
    EXPECT_EQ(map_.hits_beyond_span(), 0u);
  }
  std::vector<VoxelHit> good_{{{0, 0, 0}, 1, 2, 2.0}};
  SemanticMap map_{0.05};
};

TEST_F(Refused, HitsAndRulesThatDoNotFitLeaveTheMapAsItWas) {
  expect_refused(good_, 0, VoteRule{});
  expect_refused(good_, 1, VoteRule{});
  expect_refused(good_, 2, BlendRule{2.0});
  expect_refused(good_, 2, VoteRule{}, 1);
  expect_refused({{{0, 0, 0}, 7, 1, 1.0}}, 2, BayesRule{{0.5, 0.5}});
  expect_refused({{{0, 0, 0}, 7, 1, 1.0}}, 2, Top3Rule{7});
  expect_refused({{{0, 0, 0}, 1, 1, 1.5}}, 2, VoteRule{});
  expect_refused({{{0, 0, 0}, 1, 1, std::nan("")}}, 2, VoteRule{});
  expect_refused({{{0, 0, 0}, 1, 0, 0.0}}, 2, VoteRule{});
  expect_refused({{{0, 0, 0}, 2, 1, 1.0}, {{0, 0, 0}, 1, 1, 1.0}}, 2, VoteRule{});
  expect_refused({{{0, 0, 0}, 1, 2, 1.0}, {{0, 0, 0}, 2, 1, 1.0}}, 2, VoteRule{});
}

}  // namespace
}  // namespace mapscore
