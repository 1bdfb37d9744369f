// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#pragma once

#include "core/random_stream.hpp"
#include "eval/score/map_snapshot.hpp"
#include "eval/truth/surface_truth.hpp"
#include "eval/truth/visible_truth.hpp"

#include <cstdint>
#include <map>
#include <set>
#include <utility>
#include <vector>

namespace mapscore::eval::testing {

inline constexpr double kEdge_m = 0.05;
inline constexpr ClassId kCup = 1, kChair = 2;

/// Rows of (voxel, class) as a surface truth.
inline SurfaceTruth surface_of(const std::set<std::pair<VoxelKey, ClassId>>& rows) {
  std::vector<SurfaceVoxel> voxels;
  for (const auto& [key, class_id] : rows) voxels.push_back({key, class_id, false});
  return {std::move(voxels), kEdge_m};
}

/// Owner by voxel as a visible truth.
inline VisibleTruth visible_of(const std::map<VoxelKey, ClassId>& owners) {
  std::vector<VisibleVoxel> voxels;
  for (const auto& [key, owner] : owners) voxels.push_back({key, owner, 1});
  return {std::move(voxels), kEdge_m};
}

/// A map that is certain of its classes.
inline MapSnapshot map_of(const std::map<VoxelKey, ClassId>& labels, double probability = 1.0) {
  std::vector<MapVoxel> voxels;
  for (const auto& [key, class_id] : labels) voxels.push_back({key, class_id, probability, true});
  return MapSnapshot(std::move(voxels));
}

/// A random world of a few classes in a small block of voxels, where sets overlap and touch often.
struct RandomCase {
  static constexpr std::size_t kClasses = 4;
  std::set<std::pair<VoxelKey, ClassId>> surface;
  std::map<VoxelKey, ClassId> owners;
  std::vector<MapVoxel> map;
};

inline RandomCase random_case(std::uint64_t seed) {
  RandomStream random(seed, "score test");
  RandomCase made;
  const double fill = 0.05 + 0.3 * random.uniform();
  for (int n = 0; n < 8 * 8 * 8; ++n) {
    const VoxelKey key{n / 64 - 4, n / 8 % 8 - 4, n % 8 - 4};
    for (ClassId c = 0; c < RandomCase::kClasses; ++c) {
      if (random.uniform() < fill) made.surface.insert({key, c});
    }
    const auto any = static_cast<ClassId>(random.uniform() * RandomCase::kClasses);
    if (any != kBackground && made.surface.contains({key, any}) && random.uniform() < 0.7) {
      made.owners[key] = any;
    }
    const auto believed = static_cast<ClassId>(random.uniform() * RandomCase::kClasses);
    const double probability = static_cast<int>(random.uniform() * 8) / 8.0;
    if (random.uniform() < 0.4) {
      made.map.push_back({key, believed, probability, random.uniform() < 0.9});
    }
  }
  return made;
}

}  // namespace mapscore::eval::testing
