// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#include "eval/score/confusion.hpp"

#include "core/error.hpp"
#include "eval/score/metrics.hpp"
#include "eval/score/voxel_score.hpp"
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

constexpr double kConfusionThreshold = 0.25;

/// Rows of a matrix.
std::vector<std::vector<std::int64_t>> rows_of(const ConfusionMatrix& matrix) {
  std::vector<std::vector<std::int64_t>> rows(matrix.class_count());
  for (std::size_t row = 0; row < rows.size(); ++row)
    for (std::size_t column = 0; column < matrix.columns(); ++column)
      rows[row].push_back(matrix.at(row, column));
  return rows;
}

TEST(Confusion, CountsOneRowByHand) {
  // Cups at 0..3 are visible, at 4 not; chairs at 10 and 11, a wall at 20.
  const SurfaceTruth surface = surface_of({{{0, 0, 0}, kCup},
                                           {{1, 0, 0}, kCup},
                                           {{1, 0, 0}, kChair},
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
      {{{0, 0, 0}, kCup, 1.0, true},          // cup as cup
       {{1, 0, 0}, kChair, 1.0, true},        // cup as chair, though true for both
       {{2, 0, 0}, kCup, 0.1, true},          // cup unlabelled: below the threshold; 3 is unmapped
       {{4, 0, 0}, kCup, 1.0, true},          // true and in no V: nowhere
       {{10, 0, 0}, kBackground, 1.0, true},  // chair unlabelled
       {{11, 0, 0}, kCup, 1.0, true},         // a false cup in no V: from background
       {{20, 0, 0}, kChair, 1.0, true},       // a chair on the wall: from background
       {{30, 0, 0}, kChair, 1.0, true},       // a floating chair: from background
       {{31, 0, 0}, kChair, 1.0, false}});    // free: nothing predicted
  const ConfusionMatrix matrix = confusion_of(map, kConfusionThreshold, surface, visible, 3);
  const std::vector<std::vector<std::int64_t>> expected{
      {0, 1, 2, 0, 0}, {0, 1, 1, 1, 1}, {0, 0, 0, 1, 0}};
  EXPECT_EQ(rows_of(matrix), expected);
  EXPECT_EQ(matrix.trace(), 1);
  EXPECT_EQ(matrix.total(), 8);
  EXPECT_EQ(matrix.row_sum(kCup), 4);
  EXPECT_EQ(matrix.column_sum(kChair), 3);
  EXPECT_EQ(matrix.column_sum(3 + kUnlabelled), 2);
  EXPECT_EQ(matrix.column_sum(3 + kUnmapped), 1);
}

/// As it is defined, look-up by look-up.
ConfusionMatrix plain_confusion(const RandomCase& made) {
  ConfusionMatrix matrix(RandomCase::kClasses, kVoxelAnswers);
  const auto in_map = [&](const VoxelKey& key) -> const MapVoxel* {
    for (const MapVoxel& voxel : made.map)
      if (voxel.key == key) return &voxel;
    return nullptr;
  };
  for (const auto& [key, owner] : made.owners) {
    const MapVoxel* voxel = in_map(key);
    if (voxel == nullptr) {
      matrix.count(owner, RandomCase::kClasses + 1);
    } else if (!predicted(*voxel, kConfusionThreshold)) {
      matrix.count(owner, RandomCase::kClasses);
    } else {
      matrix.count(owner, voxel->best_class);
    }
  }
  for (const MapVoxel& voxel : made.map) {
    if (predicted(voxel, kConfusionThreshold) &&
        !made.surface.contains({voxel.key, voxel.best_class}) && !made.owners.contains(voxel.key))
      matrix.count(0, voxel.best_class);
  }
  return matrix;
}

TEST(Confusion, AgreesWithThePlainOneAndWithTheCounts) {
  for (std::uint64_t seed = 0; seed < 100; ++seed) {
    const RandomCase made = random_case(seed);
    const MapSnapshot map(made.map);
    const SurfaceTruth surface = surface_of(made.surface);
    const VisibleTruth visible = visible_of(made.owners);
    const ConfusionMatrix matrix =
        confusion_of(map, kConfusionThreshold, surface, visible, RandomCase::kClasses);
    ASSERT_EQ(matrix, plain_confusion(made)) << "seed " << seed;

    const Counts counts =
        score_voxels(map, kConfusionThreshold, surface, visible, RandomCase::kClasses);
    for (ClassId c = 1; c < RandomCase::kClasses; ++c) {
      EXPECT_EQ(matrix.row_sum(c), counts[c].visible);
      EXPECT_EQ(matrix.at(c, c), counts[c].found);
      EXPECT_EQ(matrix.at(c, RandomCase::kClasses + kUnlabelled), counts[c].missed_unlabelled);
      EXPECT_EQ(matrix.at(c, RandomCase::kClasses + kUnmapped), counts[c].missed_unmapped);
      EXPECT_EQ(ratio(matrix.at(c, c), matrix.row_sum(c)), recall(counts[c]));
    }
    EXPECT_EQ(matrix.column_sum(kBackground), 0);
  }
}

TEST(Confusion, PoolsByAddition) {
  ConfusionMatrix total;
  ConfusionMatrix a(2, kVoxelAnswers), b(2, kVoxelAnswers);
  a.count(0, 1, 3);
  a.count(1, 2);
  b.count(0, 1, 4);
  total += a;
  total += b;
  total += ConfusionMatrix();
  EXPECT_EQ(rows_of(total), (std::vector<std::vector<std::int64_t>>{{0, 7, 0, 0}, {0, 0, 1, 0}}));
  EXPECT_THAT([&] { total += ConfusionMatrix(2); }, ThrowsMessage<Error>(HasSubstr("do not add")));
}

TEST(Confusion, RefusesUnusableInput) {
  const SurfaceTruth surface = surface_of({{{0, 0, 0}, kCup}});
  const MapSnapshot stranger = map_of({{{0, 0, 0}, 9}});
  EXPECT_THAT([&] { (void)confusion_of(stranger, 0.5, surface, visible_of({}), 3); },
              ThrowsMessage<Error>(HasSubstr("class 9")));
  const MapSnapshot good = map_of({{{0, 0, 0}, kCup}});
  EXPECT_THAT([&] { (void)confusion_of(good, 0.5, surface, VisibleTruth({}, 0.1), 3); },
              ThrowsMessage<Error>(HasSubstr("voxel_m")));
  const VisibleTruth unknown = visible_of({{{0, 0, 0}, 7}});
  EXPECT_THAT([&] { (void)confusion_of(good, 0.5, surface, unknown, 3); },
              ThrowsMessage<Error>(HasSubstr("class 7")));
}

}  // namespace
}  // namespace mapscore::eval
