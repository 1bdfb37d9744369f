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

bool in_range(const VoxelKey& key) {
  return std::abs(std::int64_t{key.i}) <= kIndexMax && std::abs(std::int64_t{key.j}) <= kIndexMax &&
         std::abs(std::int64_t{key.k}) <= kIndexMax;
}

void check_voxel(const MapVoxel& voxel) {
  if (!in_range(voxel.key)) {
    throw Error(name_of(voxel.key) +
                ": lies beyond 1000000 voxels from the origin; check the voxel size");
  }
  if (!(voxel.probability >= 0.0 && voxel.probability <= 1.0)) {
    throw Error(
        fmt::format("{}: probability {} is outside [0, 1]; normalise the map's probabilities",
                    name_of(voxel.key), voxel.probability));
  }
}

bool key_before(const MapVoxel& a, const MapVoxel& b) {
  return a.key < b.key;
}

}  // namespace

MapSnapshot::MapSnapshot(std::vector<MapVoxel> voxels) : voxels_(std::move(voxels)) {
  std::for_each(voxels_.begin(), voxels_.end(), check_voxel);
  if (!std::is_sorted(voxels_.begin(), voxels_.end(), key_before)) {
    std::sort(voxels_.begin(), voxels_.end(), key_before);
  }
  const auto twin =
      std::adjacent_find(voxels_.begin(), voxels_.end(),
                         [](const MapVoxel& a, const MapVoxel& b) { return a.key == b.key; });
  if (twin != voxels_.end()) {
    throw Error(name_of(twin->key) +
                ": appears twice; give every voxel once, with its most probable class");
  }
  index_ = KeyIndex(voxels_.size());
  for (std::size_t row = 0; row < voxels_.size(); ++row) {
    index_.insert(pack(voxels_[row].key), static_cast<std::uint32_t>(row));
  }
}

const MapVoxel* MapSnapshot::find(const VoxelKey& key) const {
  const std::uint32_t row = index_.find(pack(key));
  return row == KeyIndex::kNone ? nullptr : &voxels_[row];
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
