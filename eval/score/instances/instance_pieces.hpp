// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#pragma once

#include "core/classes.hpp"
#include "core/geometry/voxel.hpp"
#include "eval/score/map_snapshot.hpp"

#include <cstdint>
#include <limits>
#include <span>
#include <vector>

namespace mapscore::eval {

/// One object as a map shows it.
struct PredictedInstance {
  ClassId class_id = kBackground;
  std::int64_t voxels = 0;
  int score = 0;   ///< mean probability of its voxels in thousandths, rounded down
  VoxelKey least;  ///< its first voxel

  bool operator==(const PredictedInstance&) const = default;
};

/// The objects that a prediction consists of, in the order of their least keys, and which voxels
/// they hold.
struct PredictedInstances {
  static constexpr std::uint32_t kNone = std::numeric_limits<std::uint32_t>::max();

  std::vector<PredictedInstance> instances;
  std::vector<VoxelKey> voxels;        ///< of the prediction, ascending
  std::vector<std::uint32_t> members;  ///< of each voxel: index into `instances`, or kNone
};

/// The number that a map's file gives to the object that a voxel belongs to; 0: none.
struct NumberedVoxel {
  VoxelKey key;
  std::uint32_t number = 0;
};

/// The 26-connected pieces of one class each. Linear in the voxels of the map. Thread-safe.
[[nodiscard]] PredictedInstances pieces_of(const MapSnapshot& map, double threshold);

/// The objects that the file numbers; a class is that of most of an object's predicted voxels, ties
/// to the lower id. `numbers` in any order, each key once; a voxel that is not in it is numbered 0.
/// Thread-safe.
[[nodiscard]] PredictedInstances objects_of(const MapSnapshot& map, double threshold,
                                            std::span<const NumberedVoxel> numbers);

}  // namespace mapscore::eval
