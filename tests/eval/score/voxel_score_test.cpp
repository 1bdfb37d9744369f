// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#include "eval/score/voxel_score.hpp"

#include "core/error.hpp"
#include "eval/score/metrics.hpp"
#include "eval/score/voxel_window.hpp"
#include "tests/eval/score/score_cases.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace mapscore::eval {
namespace {

using ::testing::HasSubstr;
using testing::kChair;
using testing::kCup;
using testing::map_of;
using testing::random_case;
using testing::RandomCase;
using testing::surface_of;
using ::testing::ThrowsMessage;
using testing::visible_of;

TEST(VoxelScore, CountsOneRowByHand) {
  // Cup on the x axis at 0..4, of which 0..3 are visible; a chair at 10 and 11; a wall at 20.
  const SurfaceTruth surface = surface_of({{{0, 0, 0}, kCup},
                                           {{1, 0, 0}, kCup},
                                           {{2, 0, 0}, kCup},
                                           {{3, 0, 0}, kCup},
                                           {{4, 0, 0}, kCup},
                                           {{10, 0, 0}, kChair},
                                           {{11, 0, 0}, kChair},
                                           {{20, 0, 0}, kBackground}});
  const VisibleTruth visible = visible_of({{{0, 0, 0}, kCup},
                                           {{1, 0, 0}, kCup},
                                           {{2, 0, 0}, kCup},
                                           {{3, 0, 0}, kCup},
                                           {{10, 0, 0}, kChair}});
  const MapSnapshot map(
      {{{0, 0, 0}, kCup, 1.0, true},     // found
       {{1, 0, 0}, kChair, 1.0, true},   // cup mislabelled; chair leaks onto the cup
       {{2, 0, 0}, kCup, 0.1, true},     // unlabelled: below the threshold
       {{4, 0, 0}, kCup, 0.5, true},     // true, never visible
       {{5, 1, 1}, kCup, 1.0, true},     // near
       {{10, 0, 0}, kCup, 1.0, true},    // leaks onto the chair, which it mislabels
       {{20, 0, 0}, kCup, 1.0, true},    // leaks onto background
       {{30, 0, 0}, kCup, 1.0, true}});  // floating; cup at 3 is unmapped

  const Counts counts = score_voxels(map, 0.25, surface, visible, 3, {{1, 2}, {}});

  ClassCounts cup;
  cup.predicted = 6;
  cup.true_predicted = 2;
  cup.visible = 4;
  cup.found = 1;
  cup.false_near = 1;
  cup.false_leak = 2;
  cup.false_floating = 1;
  cup.missed_mislabelled = 1;
  cup.missed_unlabelled = 1;
  cup.missed_unmapped = 1;
  // Within 1: the near voxel too; cups 1 (beside 0) and 3 (beside 4). Within 2: cup 2 as well.
  cup.at_tolerance = {{1, 3, 3}, {2, 3, 4}};
  EXPECT_EQ(counts[kCup], cup);

  ClassCounts chair;
  chair.predicted = 1;
  chair.visible = 1;
  chair.false_leak = 1;
  chair.missed_mislabelled = 1;
  chair.at_tolerance = {{1, 0, 0}, {2, 0, 0}};
  EXPECT_EQ(counts[kChair], chair);
  EXPECT_EQ(counts[kBackground].predicted + counts[kBackground].visible, 0);
}

TEST(VoxelScore, NearComesBeforeLeakAndLeakBeforeFloating) {
  const SurfaceTruth surface =
      surface_of({{{0, 0, 0}, kCup}, {{1, 1, 1}, kBackground}, {{2, 2, 2}, kChair}});
  const MapSnapshot map = map_of({{{1, 1, 1}, kCup}, {{2, 2, 2}, kCup}, {{2, 2, 3}, kCup}});
  const ClassCounts cup = score_voxels(map, 0.5, surface, visible_of({}), 3, {{}, {}})[kCup];
  EXPECT_EQ(cup.false_near, 1);
  EXPECT_EQ(cup.false_leak, 1);
  EXPECT_EQ(cup.false_floating, 1);
}

TEST(VoxelScore, AVoxelOfTwoClassesIsTrueForBoth) {
  const SurfaceTruth surface = surface_of({{{0, 0, 0}, kCup}, {{0, 0, 0}, kChair}});
  for (const ClassId c : {kCup, kChair}) {
    const Counts counts = score_voxels(map_of({{{0, 0, 0}, c}}), 0.5, surface, visible_of({}), 3);
    EXPECT_EQ(counts[c].true_predicted, 1);
  }
}

TEST(VoxelScore, FreeAndBackgroundVoxelsAreUnlabelledAndNoPrediction) {
  const SurfaceTruth surface = surface_of({{{0, 0, 0}, kCup}, {{1, 0, 0}, kCup}});
  const MapSnapshot map({{{0, 0, 0}, kCup, 1.0, false}, {{1, 0, 0}, kBackground, 1.0, true}});
  const Counts counts =
      score_voxels(map, 0.5, surface, visible_of({{{0, 0, 0}, kCup}, {{1, 0, 0}, kCup}}), 3);
  EXPECT_EQ(counts[kCup].missed_unlabelled, 2);
  EXPECT_EQ(counts[kCup].predicted, 0);
  EXPECT_EQ(counts[kBackground].predicted, 0);
}

TEST(VoxelScore, ToleranceIsPerAxisAndOfTheSameClass) {
  const SurfaceTruth surface = surface_of({{{0, 0, 0}, kCup}, {{9, 0, 0}, kChair}});
  const VisibleTruth visible = visible_of({{{0, 0, 0}, kCup}, {{9, 0, 0}, kChair}});
  const MapSnapshot map = map_of({{{2, -2, 2}, kCup}, {{8, 0, 0}, kCup}});
  const Counts counts = score_voxels(map, 0.5, surface, visible, 3, {{1, 2, 3}, {}});
  EXPECT_EQ(counts[kCup].at_tolerance,
            std::vector<ToleranceCounts>({{1, 0, 0}, {2, 1, 1}, {3, 1, 1}}));
  EXPECT_EQ(counts[kChair].at_tolerance,
            std::vector<ToleranceCounts>({{1, 0, 0}, {2, 0, 0}, {3, 0, 0}}));
}

TEST(VoxelScore, VoxelsOfOneToThreeSamplesLeaveTheCountsAtFour) {
  // Voxel i has samples[i] samples; the even ones are found. Without samples: a whole surface.
  const std::vector<std::uint32_t> samples{0, 1, 2, 3, 4, 5, 6, 4};
  std::vector<VisibleVoxel> seen;
  std::map<VoxelKey, ClassId> found;
  for (int i = 0; i < static_cast<int>(samples.size()); ++i) {
    seen.push_back({{i, 0, 0}, kCup, samples[static_cast<std::size_t>(i)]});
    if (i % 2 == 0) found[{i, 0, 0}] = kCup;
  }
  const ClassCounts cup = score_voxels(map_of(found), 0.5, surface_of({}),
                                       VisibleTruth(seen, testing::kEdge_m), 3)[kCup];
  EXPECT_EQ(cup.visible, 8);
  EXPECT_EQ(cup.found, 4);
  EXPECT_EQ(cup.visible_4, 5);
  EXPECT_EQ(cup.found_4, 3);
}

TEST(VoxelScore, TruthAgainstItselfIsPerfect) {
  for (std::uint64_t seed = 0; seed < 20; ++seed) {
    const RandomCase made = random_case(seed);
    std::set<std::pair<VoxelKey, ClassId>> surface;
    for (const auto& [key, owner] : made.owners) surface.insert({key, owner});
    const Counts counts = score_voxels(map_of(made.owners), 0.5, surface_of(surface),
                                       visible_of(made.owners), RandomCase::kClasses);
    for (ClassId c = 1; c < RandomCase::kClasses; ++c) {
      ASSERT_GT(counts[c].visible, 0);
      for (const char* figure :
           {"precision", "recall", "f1", "iou", "precision_t1", "recall_t1", "f1_t1"})
        EXPECT_EQ(value_of(metrics_of(counts[c]), figure), 1.0) << figure;
    }
  }
}

TEST(VoxelScore, SwappingTruthAndMapSwapsPrecisionAndRecall) {
  const auto against = [](const std::map<VoxelKey, ClassId>& map,
                          const std::map<VoxelKey, ClassId>& truth) {
    std::set<std::pair<VoxelKey, ClassId>> surface;
    for (const auto& [key, owner] : truth) surface.insert({key, owner});
    return score_voxels(map_of(map), 0.5, surface_of(surface), visible_of(truth),
                        RandomCase::kClasses);
  };
  for (std::uint64_t seed = 0; seed < 20; ++seed) {
    const auto a = random_case(2 * seed).owners, b = random_case(2 * seed + 1).owners;
    const Counts forth = against(a, b), back = against(b, a);
    for (ClassId c = 1; c < RandomCase::kClasses; ++c) {
      EXPECT_EQ(precision(forth[c]), recall(back[c]));
      EXPECT_EQ(recall(forth[c]), precision(back[c]));
      EXPECT_EQ(iou(forth[c]), iou(back[c]));
    }
  }
}

TEST(VoxelScore, PropertiesHoldOnRandomWorlds) {
  for (std::uint64_t seed = 0; seed < 200; ++seed) {
    const RandomCase made = random_case(seed);
    const Counts counts =
        score_voxels(MapSnapshot(made.map), 0.25, surface_of(made.surface), visible_of(made.owners),
                     RandomCase::kClasses, {{1, 2, 3}, {}});
    for (const ClassCounts& c : counts) {
      EXPECT_EQ(c.false_near + c.false_leak + c.false_floating, c.predicted - c.true_predicted);
      EXPECT_EQ(c.missed_mislabelled + c.missed_unlabelled + c.missed_unmapped,
                c.visible - c.found);
      EXPECT_EQ(c.at_tolerance[0].true_predicted, c.true_predicted + c.false_near);
      std::int64_t true_before = c.true_predicted, found_before = c.found;
      for (const ToleranceCounts& at : c.at_tolerance) {
        EXPECT_GE(at.true_predicted, true_before);
        EXPECT_GE(at.found, found_before);
        true_before = at.true_predicted;
        found_before = at.found;
      }
      for (const Metric& metric : metrics_of(c)) {
        const double value = metric.value.value_or(0.0);
        EXPECT_TRUE(value >= 0.0 && value <= 1.0) << metric.name;
      }
    }
  }
}

TEST(VoxelScore, ShellsCoverEveryNeighbourOnce) {
  for (const int t : {1, 2, 3}) {
    std::set<VoxelKey> seen;
    int visits = 0;
    EXPECT_FALSE(any_in_shell({5, -5, 0}, t, [&](const VoxelKey& key) {
      seen.insert(key);
      ++visits;
      const int largest = std::max({std::abs(key.i - 5), std::abs(key.j + 5), std::abs(key.k)});
      EXPECT_EQ(largest, t);
      return false;
    }));
    const int outer = 2 * t + 1, inner = 2 * t - 1;
    EXPECT_EQ(visits, outer * outer * outer - inner * inner * inner);
    EXPECT_EQ(static_cast<int>(seen.size()), visits);
  }
}

TEST(VoxelScore, RefusesUnusableInput) {
  const SurfaceTruth surface = surface_of({{{0, 0, 0}, kCup}});
  const VisibleTruth visible = visible_of({{{0, 0, 0}, kCup}});
  const auto score = [&](const MapSnapshot& map, const VisibleTruth& seen, ScoreOptions options) {
    static_cast<void>(score_voxels(map, 0.5, surface, seen, 3, options));
  };
  const MapSnapshot good = map_of({{{0, 0, 0}, kCup}});
  EXPECT_THAT(
      [&] {
        score(map_of({{{0, 0, 0}, 9}}), visible, {});
      },
      ThrowsMessage<Error>(HasSubstr("class 9")));
  EXPECT_THAT([&] { score(good, VisibleTruth({}, 0.1), {}); },
              ThrowsMessage<Error>(HasSubstr("voxel_m")));
  EXPECT_THAT(
      [&] {
        score(good, visible, {{2, 1}, {}});
      },
      ThrowsMessage<Error>(HasSubstr("tolerances")));
  EXPECT_THAT(
      [&] {
        score(good, visible, {{0}, {}});
      },
      ThrowsMessage<Error>(HasSubstr("tolerances")));
  EXPECT_THAT(
      [&] {
        score(good, visible, {{1}, {0.02, 0.01}});
      },
      ThrowsMessage<Error>(HasSubstr("distances_m")));
}

}  // namespace
}  // namespace mapscore::eval
