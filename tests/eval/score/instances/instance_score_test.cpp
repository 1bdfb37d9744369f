// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#include "eval/score/instances/instance_score.hpp"

#include "core/error.hpp"
#include "eval/score/instances/instance_match.hpp"
#include "tests/eval/score/instances/instance_cases.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>
#include <vector>

namespace mapscore::eval {
namespace {

using testing::cups_and_chairs;
using ::testing::HasSubstr;
using testing::kChair;
using testing::kCup;
using testing::surface_of;
using ::testing::ThrowsMessage;
using testing::visible_of;

constexpr ClassId kWall = 3;
constexpr InstanceId kCup1 = 1, kCup2 = 2, kChair1 = 3, kWall1 = 5;

/// A row of voxels along k.
struct Bar {
  int i, first, last;  ///< with `last`
  ClassId id;          ///< an instance in the truth, a class in the map
  double probability = 1.0;
};

/// Truth in which each bar is a surface; those that are seen are visible.
struct World {
  std::set<std::pair<VoxelKey, ClassId>> surface;
  std::map<VoxelKey, ClassId> owners;

  World& seen(const Bar& bar) {
    for (int k = bar.first; k <= bar.last; ++k) owners[{bar.i, 0, k}] = bar.id;
    return there(bar);
  }
  World& there(const Bar& bar) {
    for (int k = bar.first; k <= bar.last; ++k) surface.insert({{bar.i, 0, k}, bar.id});
    return *this;
  }
};

std::vector<InstanceCounts> score(const World& world, const std::vector<Bar>& map,
                                  const std::vector<NumberedVoxel>* numbers = nullptr) {
  std::vector<MapVoxel> voxels;
  for (const Bar& bar : map)
    for (int k = bar.first; k <= bar.last; ++k)
      voxels.push_back({{bar.i, 0, k}, bar.id, bar.probability, true});
  const MapSnapshot snapshot(voxels);
  const PredictedInstances predicted =
      numbers == nullptr ? pieces_of(snapshot, 0.25) : objects_of(snapshot, 0.25, *numbers);
  return score_instances(predicted, surface_of(world.surface), visible_of(world.owners),
                         cups_and_chairs());
}

double figure(const InstanceCounts& counts, const std::string& name) {
  return value_of(counts.metrics(), name).value_or(-1.0);
}

TEST(InstanceScore, OneObjectByHand) {
  // Ten voxels of cup seen, two more never; eight of the ten hit, one unseen, three false.
  const World world = World().seen({0, 0, 9, kCup1}).there({0, 10, 11, kCup1});
  const InstanceCounts cup = score(world, {{0, 2, 10, kCup, 0.5}, {1, 5, 7, kCup, 1.0}})[kCup];
  EXPECT_EQ(cup.true_positive, 1);
  EXPECT_EQ(cup.false_positive + cup.false_negative + cup.void_predicted, 0);
  EXPECT_EQ(cup.iou_sum_nano, 615384615);  // 8 / (10 + 3)
  ASSERT_EQ(cup.steps.size(), 1u);
  EXPECT_EQ(cup.steps[0].score, 625);  // (9 * 0.5 + 3) / 12
  EXPECT_EQ(cup.steps[0].true_predicted,
            (std::array<std::int64_t, 11>{1, 1, 1, 1, 0, 0, 0, 0, 0, 0, 0}));
  EXPECT_DOUBLE_EQ(figure(cup, "pq"), 0.615384615);
  EXPECT_DOUBLE_EQ(figure(cup, "sq"), 0.615384615);
  EXPECT_EQ(figure(cup, "rq"), 1.0);
  EXPECT_EQ(figure(cup, "ap_25"), 1.0);
  EXPECT_EQ(figure(cup, "ap_50"), 1.0);
  EXPECT_EQ(figure(cup, "ap_75"), 0.0);
  EXPECT_DOUBLE_EQ(figure(cup, "ap_mean"), 0.3);
}

TEST(InstanceScore, MergedObjectsFindTheLargerOnlyIfItIsMostOfTheWhole) {
  // One piece over two cups and the gap between them: IoU 8 / (8 + 4) and 3 / (3 + 9).
  const World world = World().seen({0, 0, 7, kCup1}).seen({0, 9, 11, kCup2});
  const InstanceCounts cup = score(world, {{0, 0, 11, kCup}})[kCup];
  EXPECT_EQ(cup.true_positive, 1);
  EXPECT_EQ(cup.false_positive, 0);
  EXPECT_EQ(cup.false_negative, 1);
  EXPECT_EQ(cup.iou_sum_nano, 666666667);
  EXPECT_DOUBLE_EQ(figure(cup, "pq"), 0.666666667 / 1.5);
  EXPECT_DOUBLE_EQ(figure(cup, "rq"), 1 / 1.5);
  EXPECT_EQ(figure(cup, "ap_25"), 0.5);  // it takes one instance, whatever the threshold
}

TEST(InstanceScore, ASplitObjectIsFoundOnceAtMost) {
  const World world = World().seen({0, 0, 9, kCup1});
  const InstanceCounts uneven = score(world, {{0, 0, 5, kCup, 0.5}, {0, 7, 9, kCup, 0.9}})[kCup];
  EXPECT_EQ(uneven.true_positive, 1);  // 6 / 10
  EXPECT_EQ(uneven.false_positive, 1);
  EXPECT_EQ(uneven.false_negative, 0);
  // The surer piece has 3 / 10: it takes the cup at 0.25 and is false at 0.5.
  EXPECT_EQ(figure(uneven, "ap_25"), 1.0);
  EXPECT_EQ(figure(uneven, "ap_50"), 0.5);
  const InstanceCounts even = score(world, {{0, 0, 4, kCup}, {0, 6, 9, kCup}})[kCup];
  EXPECT_EQ(even.true_positive, 0);  // 5 / 10 is not above a half ...
  EXPECT_EQ(even.false_negative, 1);
  EXPECT_EQ(figure(even, "pq"), 0.0);
  EXPECT_EQ(value_of(even.metrics(), "sq"), std::nullopt);
  EXPECT_EQ(figure(even, "ap_50"), 0.5);  // ... but at one; of equal scores all at once
}

TEST(InstanceScore, AWrongClassMatchesNothing) {
  const World world = World().seen({0, 0, 9, kCup1});
  const auto counts = score(world, {{0, 0, 9, kChair}});
  EXPECT_EQ(counts[kCup].false_negative, 1);
  EXPECT_EQ(counts[kCup].true_positive + counts[kCup].false_positive, 0);
  EXPECT_EQ(counts[kChair].false_positive, 1);
  EXPECT_EQ(counts[kChair].visible(), 0);
  EXPECT_EQ(value_of(counts[kChair].metrics(), "ap_50"), std::nullopt);
  EXPECT_EQ(figure(counts[kChair], "pq"), 0.0);
}

TEST(InstanceScore, WhatWasNeverSeenIsVoid) {
  const World world = World().seen({0, 0, 9, kCup1}).there({5, 0, 3, kCup2});
  const auto void_of = [&](const Bar& bar) {
    const InstanceCounts cup = score(world, {{0, 0, 9, kCup}, bar})[kCup];
    EXPECT_EQ(cup.true_positive, 1);
    EXPECT_EQ(cup.false_negative, 0);  // cup 2 has no visible voxel
    EXPECT_EQ(cup.void_predicted + cup.false_positive, 1);
    EXPECT_EQ(cup.steps.front().predicted, 2 - cup.void_predicted);
    return cup.void_predicted;
  };
  EXPECT_EQ(void_of({5, 2, 5, kCup}), 1);  // two of four on it
  EXPECT_EQ(void_of({5, 2, 6, kCup}), 0);  // two of five
}

TEST(InstanceScore, APredictionThatSharesAVisibleVoxelIsNeverVoid) {
  const World world = World().seen({0, 0, 0, kCup1}).there({0, 1, 9, kCup1});
  const InstanceCounts cup = score(world, {{0, 0, 9, kCup}})[kCup];
  EXPECT_EQ(cup.true_positive, 1);  // 1 / (1 + 0): nothing lies outside its surface
  EXPECT_EQ(cup.void_predicted, 0);
}

TEST(InstanceScore, ClassesThatAreNotDetectedAreLeftOutOnBothSides) {
  const World world = World().seen({0, 0, 9, kWall1});
  EXPECT_EQ(score(world, {{0, 0, 9, kWall}, {3, 0, 3, kWall}})[kWall], InstanceCounts{});
}

TEST(InstanceScore, NumbersJoinWhatLiesApart) {
  const World world = World().seen({0, 0, 9, kCup1});
  std::vector<NumberedVoxel> numbers;
  for (int k = 0; k <= 9; ++k) numbers.push_back({{0, 0, k}, 4});
  const InstanceCounts cup = score(world, {{0, 0, 3, kCup}, {0, 6, 9, kCup}}, &numbers)[kCup];
  EXPECT_EQ(cup.true_positive, 1);
  EXPECT_EQ(cup.iou_sum_nano, 800000000);
}

TEST(InstanceScore, TiesGoToTheLowerInstanceThenToTheLowerPrediction) {
  const std::vector<InstancePair> pairs{{0, 2, 6, 10}, {0, 7, 3, 5}, {1, 2, 9, 15}, {2, 2, 4, 10}};
  // 0.6 thrice: instance 2 before 7, prediction 0 before 1; then nothing is free for 7.
  EXPECT_EQ(match_by_iou(pairs), (std::vector<std::size_t>{0}));
  // Prediction 1 takes 2 first, so 0 takes 7; 2 finds nothing free.
  EXPECT_EQ(match_by_score(pairs, {1, 0, 2}, 25), (std::vector<bool>{true, true, false}));
  EXPECT_EQ(match_by_score(pairs, {0, 1, 2}, 25), (std::vector<bool>{true, false, false}));
  EXPECT_EQ(match_by_score(pairs, {1, 0, 2}, 60), (std::vector<bool>{true, true, false}));
  EXPECT_EQ(match_by_score(pairs, {1, 0, 2}, 65), (std::vector<bool>{false, false, false}));
}

TEST(InstanceScore, TheMacroMeanIsOverClassesWithVisibleInstances) {
  const World world = World().seen({0, 0, 9, kCup1}).seen({9, 0, 9, kChair1});
  const auto counts = score(world, {{0, 0, 7, kCup}});
  const auto macro = macro_instance_metrics(counts, cups_and_chairs());
  EXPECT_DOUBLE_EQ(*value_of(macro, "pq"), 0.4);
  EXPECT_DOUBLE_EQ(*value_of(macro, "sq"), 0.8);  // undefined for the chair
  EXPECT_DOUBLE_EQ(*value_of(macro, "ap_75"), 0.5);
  EXPECT_TRUE(macro_instance_metrics(score(World(), {}), cups_and_chairs()).empty());
  EXPECT_THAT([&] { (void)macro_instance_metrics({}, cups_and_chairs()); },
              ThrowsMessage<Error>(HasSubstr("differ in size")));
}

TEST(InstanceScore, RefusesUnusableInput) {
  const auto score_with = [&](ClassId map_class, InstanceId instance, double edge_m) {
    const MapSnapshot one({{{0, 0, 0}, map_class, 1.0, true}});
    (void)score_instances(pieces_of(one, 0.5), surface_of({{{0, 0, 0}, instance}}),
                          VisibleTruth({}, edge_m), cups_and_chairs());
  };
  EXPECT_THAT([&] { score_with(9, 1, testing::kEdge_m); },
              ThrowsMessage<Error>(HasSubstr("class 9")));
  EXPECT_THAT([&] { score_with(1, 6, testing::kEdge_m); },
              ThrowsMessage<Error>(HasSubstr("instance 6")));
  EXPECT_THAT([&] { score_with(1, 1, 0.1); }, ThrowsMessage<Error>(HasSubstr("voxel_m")));
}

}  // namespace
}  // namespace mapscore::eval
