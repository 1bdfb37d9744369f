// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#include "eval/score/map_snapshot.hpp"

#include "core/error.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

namespace mapscore::eval {
namespace {

using ::testing::HasSubstr;
using ::testing::ThrowsMessage;

TEST(Prediction, TakesOccupiedVoxelsWithAClassFromTheThresholdOn) {
  const MapSnapshot map({{{2, 0, 0}, 3, 0.25, true},
                         {{0, 0, 0}, 1, 0.9, true},
                         {{1, 0, 0}, 1, 0.2499, true},
                         {{3, 0, 0}, 1, 0.9, false},
                         {{4, 0, 0}, kBackground, 0.9, true}});
  const std::vector<PredictedVoxel> expected{{{0, 0, 0}, 1, 0.9}, {{2, 0, 0}, 3, 0.25}};
  EXPECT_EQ(prediction_of(map, 0.25), expected);
  const auto by_class = predicted_by_class(map, 0.25, 4);
  EXPECT_EQ(by_class[1], std::vector<VoxelKey>({{0, 0, 0}}));
  EXPECT_TRUE(by_class[2].empty());
  EXPECT_EQ(by_class[3], std::vector<VoxelKey>({{2, 0, 0}}));
}

TEST(Prediction, FindsEveryVoxelOfTheMapAndNoOther) {
  std::vector<MapVoxel> voxels;
  for (int n = 0; n < 1000; ++n)
    voxels.push_back({{n % 10 * 2, -n / 10, n % 7}, 1, n / 1000.0, true});
  const MapSnapshot map(voxels);
  for (const MapVoxel& voxel : voxels) {
    ASSERT_NE(map.find(voxel.key), nullptr);
    EXPECT_EQ(map.find(voxel.key)->probability, voxel.probability);
    EXPECT_EQ(map.find({voxel.key.i + 1, voxel.key.j, voxel.key.k}), nullptr);
  }
  EXPECT_EQ(MapSnapshot({}).find({0, 0, 0}), nullptr);
}

TEST(Prediction, RefusesWhatIsNoMap) {
  const auto snapshot = [](std::vector<MapVoxel> voxels) {
    return [voxels] { static_cast<void>(MapSnapshot(voxels)); };
  };
  EXPECT_THAT(snapshot({{{7, 8, 9}, 1, 1.0, true}, {{7, 8, 9}, 2, 1.0, true}}),
              ThrowsMessage<Error>(HasSubstr("7,8,9: appears twice")));
  EXPECT_THAT(snapshot({{{0, 0, 0}, 1, 1.5, true}}), ThrowsMessage<Error>(HasSubstr("1.5")));
  EXPECT_THAT(snapshot({{{0, 0, 0}, 1, std::nan(""), true}}),
              ThrowsMessage<Error>(HasSubstr("nan")));
  EXPECT_THAT(snapshot({{{0, -1000001, 0}, 1, 1.0, true}}),
              ThrowsMessage<Error>(HasSubstr("beyond")));
  EXPECT_THAT(snapshot({{{0, 0, INT32_MIN}, 1, 1.0, true}}),
              ThrowsMessage<Error>(HasSubstr("beyond")));
  const MapSnapshot map({{{0, 0, 0}, 5, 1.0, true}});
  EXPECT_THAT([&] { static_cast<void>(predicted_by_class(map, 0.5, 5)); },
              ThrowsMessage<Error>(HasSubstr("class 5")));
}

}  // namespace
}  // namespace mapscore::eval
