// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#pragma once

#include "core/classes.hpp"
#include "core/geometry/voxel.hpp"
#include "core/mapping/semantic_map.hpp"

#include <cstddef>
#include <vector>

namespace mapscore::eval {

struct PredictedVoxel {
  VoxelKey key;
  ClassId class_id = kBackground;
  double probability = 0.0;

  bool operator==(const PredictedVoxel&) const = default;
};

/// True when a voxel of the map belongs to the prediction: it has a class other than background,
/// with a probability of at least `threshold`, and is occupied.
[[nodiscard]] inline bool predicted(const MapVoxel& voxel, double threshold) {
  return voxel.best_class != kBackground && voxel.occupied && voxel.probability >= threshold;
}

/// The voxels of one map at one time, ordered by key, with a look-up by key. A pruned leaf must
/// have been spread into the finest voxels that it covers. Immutable, safe to share between
/// threads.
class MapSnapshot {
 public:
  /// Takes the voxels in any order. Throws Error naming the voxel that appears twice, lies beyond
  /// +-1000000 voxels or has a probability outside [0, 1].
  explicit MapSnapshot(std::vector<MapVoxel> voxels);

  [[nodiscard]] const std::vector<MapVoxel>& voxels() const { return voxels_; }
  /// The voxel, or nullptr when it is not in the map; in logarithmic time.
  [[nodiscard]] const MapVoxel* find(const VoxelKey& key) const;

 private:
  std::vector<MapVoxel> voxels_;
};

/// Throws Error naming the voxel and what to do about its class, which the table has not.
[[noreturn]] void refuse_class(const VoxelKey& key, ClassId class_id, std::size_t class_count);

/// Throws as refuse_class when the class is not below `class_count`.
inline void check_class(const VoxelKey& key, ClassId class_id, std::size_t class_count) {
  if (class_id >= class_count) refuse_class(key, class_id, class_count);
}

/// P of all classes, ordered by key.
[[nodiscard]] std::vector<PredictedVoxel> prediction_of(const MapSnapshot& map, double threshold);

/// P_c by class id, each ordered by key. Throws Error naming the voxel whose class is not below
/// `class_count`.
[[nodiscard]] std::vector<std::vector<VoxelKey>> predicted_by_class(const MapSnapshot& map,
                                                                    double threshold,
                                                                    std::size_t class_count);

}  // namespace mapscore::eval
