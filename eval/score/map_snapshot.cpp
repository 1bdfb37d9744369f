// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#include "eval/score/map_snapshot.hpp"

#include "core/error.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cstdint>
#include <cstdlib>
#include <string>

namespace mapscore::eval {

namespace {

/// Leaves room below the +-2^20 of packed keys for every neighbour that scoring asks for.
constexpr std::int32_t kIndexMax = 1000000;

std::string name_of(const VoxelKey& key) {
  return fmt::format("map voxel {},{},{}", key.i, key.j, key.k);
}

void check_voxel(const MapVoxel& voxel) {
  const auto beyond = [](std::int64_t index) { return std::abs(index) > kIndexMax; };
  if (beyond(voxel.key.i) || beyond(voxel.key.j) || beyond(voxel.key.k)) {
    throw Error(name_of(voxel.key) +
                ": lies beyond 1000000 voxels from the origin; check the voxel size");
  }
  if (!(voxel.probability >= 0.0 && voxel.probability <= 1.0)) {
    throw Error(
        fmt::format("{}: probability {} is outside [0, 1]; normalise the map's probabilities",
                    name_of(voxel.key), voxel.probability));
  }
}

}  // namespace

MapSnapshot::MapSnapshot(std::vector<MapVoxel> voxels) : voxels_(std::move(voxels)) {
  std::for_each(voxels_.begin(), voxels_.end(), check_voxel);
  if (!std::ranges::is_sorted(voxels_, {}, &MapVoxel::key)) {
    std::ranges::sort(voxels_, {}, &MapVoxel::key);
  }
  const auto twin = std::ranges::adjacent_find(voxels_, {}, &MapVoxel::key);
  if (twin != voxels_.end()) {
    throw Error(name_of(twin->key) +
                ": appears twice; give every voxel once, with its most probable class");
  }
}

const MapVoxel* MapSnapshot::find(const VoxelKey& key) const {
  const auto voxel = std::ranges::lower_bound(voxels_, key, {}, &MapVoxel::key);
  return voxel == voxels_.end() || voxel->key != key ? nullptr : &*voxel;
}

std::vector<PredictedVoxel> prediction_of(const MapSnapshot& map, double threshold) {
  std::vector<PredictedVoxel> prediction;
  for (const MapVoxel& voxel : map.voxels()) {
    if (predicted(voxel, threshold)) {
      prediction.push_back({voxel.key, voxel.best_class, voxel.probability});
    }
  }
  return prediction;
}

void refuse_class(const VoxelKey& key, ClassId class_id, std::size_t class_count) {
  throw Error(
      fmt::format("{}: class {} is not in the class table of {} classes; score against the scene "
                  "that the map was made of",
                  name_of(key), class_id, class_count));
}

std::vector<std::vector<VoxelKey>> predicted_by_class(const MapSnapshot& map, double threshold,
                                                      std::size_t class_count) {
  std::vector<std::vector<VoxelKey>> by_class(class_count);
  for (const MapVoxel& voxel : map.voxels()) {
    if (!predicted(voxel, threshold)) continue;
    check_class(voxel.key, voxel.best_class, class_count);
    by_class[voxel.best_class].push_back(voxel.key);
  }
  return by_class;
}

}  // namespace mapscore::eval
