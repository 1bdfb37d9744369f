// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#include "eval/score/occupancy_score.hpp"

#include "core/random_stream.hpp"
#include "tests/eval/score/score_cases.hpp"

#include <gtest/gtest.h>

#include <algorithm>

namespace mapscore::eval {
namespace {

using testing::kCup;
using testing::random_case;
using testing::RandomCase;
using testing::surface_of;

MapVoxel occupied(int k) {
  return {{0, 0, k}, kCup, 0.9, true};
}
MapVoxel free(int k) {
  return {{0, 0, k}, kBackground, 0.0, false};
}

TEST(OccupancyScore, CountsOneRowByHand) {
  // Occupied 0..3, free 10..14; 20 and 21 on a surface that nobody saw, 30 unknown.
  OccupancyTruth truth;
  for (int k = 0; k <= 3; ++k) truth.occupied.push_back({0, 0, k});
  for (int k = 10; k <= 14; ++k) truth.free.push_back({0, 0, k});
  const SurfaceTruth surface = surface_of(
      {{{0, 0, 1}, kCup}, {{0, 0, 20}, kCup}, {{0, 0, 20}, kBackground}, {{0, 0, 21}, kCup}});
  const MapSnapshot map({occupied(0), free(1), free(2),               // 3 is unmapped
                         free(10), free(11), occupied(12), free(13),  // 14 is unmapped
                         free(20), occupied(21), free(30)});
  const OccupancyCounts counts = score_occupancy(map, truth, surface);
  EXPECT_EQ(counts.occupied, (OccupancyCounts::Row{1, 2, 1}));
  EXPECT_EQ(counts.free, (OccupancyCounts::Row{1, 3, 1}));
  EXPECT_EQ(counts.free_on_surface, 1);
  const std::vector<Metric> expected{{"occupied_recall", 0.25},
                                     {"free_recall", 0.6},
                                     {"free_precision", 0.5},  // 3 of 3 + 2 + 1
                                     {"unknown_share", 2.0 / 9.0}};
  EXPECT_EQ(occupancy_metrics(counts), expected);
}

TEST(OccupancyScore, NothingKnownIsUndefined) {
  const OccupancyCounts counts = score_occupancy(MapSnapshot({free(30)}), {}, surface_of({}));
  for (const Metric& metric : occupancy_metrics(counts)) EXPECT_EQ(metric.value, std::nullopt);
  EXPECT_TRUE(carves(MapSnapshot({occupied(1), free(30)})));
  EXPECT_FALSE(carves(MapSnapshot({occupied(1)})));
}

TEST(OccupancyScore, AgreesWithThePlainOne) {
  for (std::uint64_t seed = 0; seed < 100; ++seed) {
    const RandomCase made = random_case(seed);
    RandomStream random(seed, "occupancy");
    OccupancyTruth truth;
    for (int n = 0; n < 8 * 8 * 8; ++n) {
      const VoxelKey key{n / 64 - 4, n / 8 % 8 - 4, n % 8 - 4};
      const double draw = random.uniform();
      if (draw < 0.3) truth.occupied.push_back(key);
      const bool on_surface = std::any_of(made.surface.begin(), made.surface.end(),
                                          [&](const auto& row) { return row.first == key; });
      if (draw > 0.6 && !on_surface) truth.free.push_back(key);
    }
    OccupancyCounts plain;
    const auto among = [](const std::vector<VoxelKey>& keys, const VoxelKey& key) {
      return std::find(keys.begin(), keys.end(), key) != keys.end();
    };
    for (const MapVoxel& voxel : made.map) {
      const bool is_occupied = among(truth.occupied, voxel.key);
      const bool is_free = among(truth.free, voxel.key);
      const bool on_surface = std::any_of(made.surface.begin(), made.surface.end(),
                                          [&](const auto& row) { return row.first == voxel.key; });
      if (is_occupied) ++(voxel.occupied ? plain.occupied.occupied : plain.occupied.free);
      if (is_free) ++(voxel.occupied ? plain.free.occupied : plain.free.free);
      plain.free_on_surface += !voxel.occupied && !is_occupied && !is_free && on_surface;
    }
    plain.occupied.unmapped = static_cast<std::int64_t>(truth.occupied.size()) -
                              plain.occupied.occupied - plain.occupied.free;
    plain.free.unmapped =
        static_cast<std::int64_t>(truth.free.size()) - plain.free.occupied - plain.free.free;
    const OccupancyCounts counts =
        score_occupancy(MapSnapshot(made.map), truth, surface_of(made.surface));
    ASSERT_EQ(counts, plain) << "seed " << seed;
    for (const Metric& metric : occupancy_metrics(counts)) {
      EXPECT_GE(metric.value.value_or(0.0), 0.0);
      EXPECT_LE(metric.value.value_or(0.0), 1.0);
    }
  }
}

}  // namespace
}  // namespace mapscore::eval
