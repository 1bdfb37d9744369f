// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#include "eval/score/instances/instance_pieces.hpp"

#include "tests/eval/score/instances/instance_cases.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>

namespace mapscore::eval {
namespace {

using testing::instance_case;
using testing::InstanceCase;
using testing::kChair;
using testing::kCup;
using testing::map_of;

constexpr std::uint32_t kNone = PredictedInstances::kNone;

TEST(InstancePieces, ConnectAcrossCornersAndWithinOneClass) {
  const MapSnapshot map = map_of({{{0, 0, 0}, kCup},
                                  {{1, 1, 1}, kCup},    // corner to corner
                                  {{2, 0, 2}, kCup},    // and on
                                  {{2, 1, 2}, kChair},  // touches, but is a chair
                                  {{4, 0, 2}, kCup},    // two voxels away
                                  {{-5, -1, -1}, kCup}});
  const PredictedInstances pieces = pieces_of(map, 0.5);
  EXPECT_EQ(pieces.instances, (std::vector<PredictedInstance>{{kCup, 1, 1000, {-5, -1, -1}},
                                                              {kCup, 3, 1000, {0, 0, 0}},
                                                              {kChair, 1, 1000, {2, 1, 2}},
                                                              {kCup, 1, 1000, {4, 0, 2}}}));
  EXPECT_EQ(pieces.members, (std::vector<std::uint32_t>{0, 1, 1, 1, 2, 3}));
}

TEST(InstancePieces, OnlyThePredictionIsPutTogether) {
  const MapSnapshot map({{{0, 0, 0}, kCup, 0.7, true},
                         {{0, 0, 1}, kCup, 0.1, true},  // below the threshold
                         {{0, 0, 2}, kCup, 0.8, true},
                         {{0, 0, 3}, kCup, 0.8, false},  // free
                         {{0, 0, 4}, kCup, 0.9999, true}});
  const PredictedInstances pieces = pieces_of(map, 0.25);
  EXPECT_EQ(pieces.instances,
            (std::vector<PredictedInstance>{
                {kCup, 1, 700, {0, 0, 0}}, {kCup, 1, 800, {0, 0, 2}}, {kCup, 1, 999, {0, 0, 4}}}));
}

TEST(InstancePieces, TheScoreIsTheMeanRoundedDown) {
  const MapSnapshot map(
      {{{0, 0, 0}, kCup, 0.3, true}, {{0, 0, 1}, kCup, 0.3, true}, {{0, 0, 2}, kCup, 0.5, true}});
  EXPECT_EQ(pieces_of(map, 0.25).instances.front().score, 366);
  // 0.3 thrice is 0.3, whatever doubles make of the sum.
  const MapSnapshot even(
      {{{0, 0, 0}, kCup, 0.3, true}, {{0, 0, 1}, kCup, 0.3, true}, {{0, 0, 2}, kCup, 0.3, true}});
  EXPECT_EQ(pieces_of(even, 0.25).instances.front().score, 300);
}

/// Every voxel takes the least label of its neighbourhood until nothing changes.
std::vector<std::size_t> plain_labels(const std::vector<PredictedVoxel>& voxels) {
  std::vector<std::size_t> labels(voxels.size());
  for (std::size_t n = 0; n < labels.size(); ++n) labels[n] = n;
  for (bool changed = true; changed;) {
    changed = false;
    for (std::size_t a = 0; a < voxels.size(); ++a)
      for (std::size_t b = 0; b < voxels.size(); ++b) {
        const VoxelKey &p = voxels[a].key, &q = voxels[b].key;
        const bool touch = std::abs(p.i - q.i) <= 1 && std::abs(p.j - q.j) <= 1 &&
                           std::abs(p.k - q.k) <= 1 && voxels[a].class_id == voxels[b].class_id;
        if (!touch || labels[b] >= labels[a]) continue;
        labels[a] = labels[b];
        changed = true;
      }
  }
  return labels;
}

TEST(InstancePieces, AgreeWithThePlainOnes) {
  for (std::uint64_t seed = 0; seed < 60; ++seed) {
    const auto made = testing::random_case(seed);
    const MapSnapshot map(made.map);
    const auto voxels = prediction_of(map, 0.4);
    const std::vector<std::size_t> labels = plain_labels(voxels);
    const PredictedInstances pieces = pieces_of(map, 0.4);
    ASSERT_EQ(pieces.voxels.size(), voxels.size());
    std::size_t before = 0;
    for (std::size_t n = 0; n < voxels.size(); ++n) {
      const PredictedInstance& piece = pieces.instances.at(pieces.members[n]);
      ASSERT_EQ(piece.least, voxels[labels[n]].key) << "seed " << seed;
      ASSERT_EQ(piece.class_id, voxels[n].class_id);
      if (labels[n] != n) continue;
      EXPECT_EQ(pieces.members[n], before++);  // numbered by least keys
      EXPECT_EQ(piece.voxels, std::count(labels.begin(), labels.end(), n));
    }
    EXPECT_EQ(pieces.instances.size(), before);
  }
}

TEST(InstancePieces, NumbersOfTheFileGoBeforePieces) {
  const MapSnapshot map = map_of({{{0, 0, 0}, kChair},
                                  {{0, 0, 1}, kCup},
                                  {{0, 0, 9}, kCup},    // far away, still object 7
                                  {{0, 0, 10}, kCup},   // number 0: no object
                                  {{0, 0, 11}, kCup},   // not numbered: no object
                                  {{5, 0, 0}, kChair},  // object 3: one of each, the lower class
                                  {{5, 0, 1}, kCup}});
  const std::vector<NumberedVoxel> numbers{{{5, 0, 0}, 3}, {{5, 0, 1}, 3}, {{0, 0, 0}, 7},
                                           {{0, 0, 1}, 7}, {{0, 0, 9}, 7}, {{0, 0, 10}, 0},
                                           {{8, 8, 8}, 12}};  // not in the map
  const PredictedInstances objects = objects_of(map, 0.5, numbers);
  EXPECT_EQ(objects.instances, (std::vector<PredictedInstance>{{kCup, 3, 1000, {0, 0, 0}},
                                                               {kCup, 2, 1000, {5, 0, 0}}}));
  EXPECT_EQ(objects.members, (std::vector<std::uint32_t>{0, 0, 0, kNone, kNone, 1, 1}));
}

TEST(InstancePieces, PiecesNumberedByTheFileAreThePieces) {
  for (std::uint64_t seed = 0; seed < 20; ++seed) {
    const InstanceCase made = instance_case(seed);
    const MapSnapshot map(made.map);
    const PredictedInstances pieces = pieces_of(map, 0.2);
    std::vector<NumberedVoxel> numbers;
    for (std::size_t n = pieces.voxels.size(); n-- > 0;)
      numbers.push_back({pieces.voxels[n], 90000 - pieces.members[n]});
    const PredictedInstances objects = objects_of(map, 0.2, numbers);
    EXPECT_EQ(objects.instances, pieces.instances);
    EXPECT_EQ(objects.members, pieces.members);
  }
}

}  // namespace
}  // namespace mapscore::eval
