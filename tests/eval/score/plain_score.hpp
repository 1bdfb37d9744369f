// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#pragma once

#include "eval/score/counts.hpp"
#include "eval/truth/distance.hpp"
#include "tests/eval/score/random_scene.hpp"

#include <algorithm>
#include <cstdlib>
#include <limits>
#include <map>
#include <set>
#include <utility>
#include <vector>

namespace mapscore::eval::testing {

/// The scores by the words of docs/metrics.md: sets, and loops over all of them.
struct PlainScore {
  std::set<std::pair<VoxelKey, ClassId>> surface;
  std::map<VoxelKey, ClassId> owners;
  std::set<VoxelKey> of_four_samples;
  std::map<VoxelKey, MapVoxel> map;
  double threshold = 0.0;

  PlainScore(const SurfaceTruth& S, const VisibleTruth& V, const std::vector<MapVoxel>& voxels,
             double least_probability)
      : threshold(least_probability) {
    for (const SurfaceVoxel& row : S.voxels()) surface.insert({row.key, row.class_id});
    for (const VisibleVoxel& voxel : V.voxels()) {
      owners[voxel.key] = voxel.owner;
      if (voxel.samples >= 4) of_four_samples.insert(voxel.key);
    }
    for (const MapVoxel& voxel : voxels) map[voxel.key] = voxel;
  }

  [[nodiscard]] bool predicts(const VoxelKey& key, ClassId c) const {
    const auto voxel = map.find(key);
    return voxel != map.end() && voxel->second.best_class == c && c != kBackground &&
           voxel->second.occupied && voxel->second.probability >= threshold;
  }
  [[nodiscard]] bool on_surface(const VoxelKey& key, ClassId c) const {
    return surface.contains({key, c});
  }
  /// True when a voxel within t of `key` on each axis satisfies `holds`.
  template <class Holds>
  [[nodiscard]] static bool within(const VoxelKey& key, int t, const Holds& holds) {
    for (int i = key.i - t; i <= key.i + t; ++i)
      for (int j = key.j - t; j <= key.j + t; ++j)
        for (int k = key.k - t; k <= key.k + t; ++k)
          if (holds(VoxelKey{i, j, k})) return true;
    return false;
  }

  [[nodiscard]] ClassCounts of(ClassId c, const std::vector<int>& tolerances) const {
    ClassCounts counts;
    for (const int t : tolerances) counts.at_tolerance.push_back({t, 0, 0});
    const auto in_surface = [&](const VoxelKey& key) { return on_surface(key, c); };
    const auto in_prediction = [&](const VoxelKey& key) { return predicts(key, c); };
    for (const auto& [key, voxel] : map) {
      if (!predicts(key, c)) continue;
      ++counts.predicted;
      bool leaks = false;
      for (ClassId other = 0; other < 4; ++other) leaks = leaks || on_surface(key, other);
      if (in_surface(key)) {
        ++counts.true_predicted;
      } else if (within(key, 1, in_surface)) {
        ++counts.false_near;
      } else {
        ++(leaks ? counts.false_leak : counts.false_floating);
      }
      for (ToleranceCounts& at : counts.at_tolerance)
        at.true_predicted += within(key, at.voxels, in_surface) ? 1 : 0;
    }
    for (const auto& [key, owner] : owners) {
      if (owner != c) continue;
      ++counts.visible;
      counts.visible_4 += of_four_samples.contains(key);
      counts.found_4 += of_four_samples.contains(key) && predicts(key, c);
      bool any = false;
      for (ClassId other = 1; other < 4; ++other) any = any || predicts(key, other);
      if (predicts(key, c)) {
        ++counts.found;
      } else if (any) {
        ++counts.missed_mislabelled;
      } else {
        ++(map.contains(key) ? counts.missed_unlabelled : counts.missed_unmapped);
      }
      for (ToleranceCounts& at : counts.at_tolerance)
        at.found += within(key, at.voxels, in_prediction) ? 1 : 0;
    }
    return counts;
  }

  /// Distances of the predicted cubes of a class to its surface, by a look at every piece.
  [[nodiscard]] std::vector<double> accuracy(ClassId c, const RandomScene& scene) const {
    const auto pieces = pieces_of(prepare(scene.shapes, Pose::Identity()), scene.table, c);
    std::vector<double> distances;
    for (const auto& [key, voxel] : map) {
      if (!predicts(key, c)) continue;
      const Eigen::Vector3d low = low_corner_of(key, scene.edge_m);
      const Box cube(low, low_corner_of({key.i + 1, key.j + 1, key.k + 1}, scene.edge_m));
      distances.push_back(distance_to_surface(pieces, cube));
    }
    return distances;
  }

  /// Distances of the samples of a class to its predicted cubes, by a look at every cube.
  [[nodiscard]] std::vector<double> completeness(ClassId c, const Points& points,
                                                 double edge_m) const {
    std::vector<double> distances;
    for (const Eigen::Vector3d& p : points[c]) {
      double least = std::numeric_limits<double>::infinity();
      for (const auto& [key, voxel] : map) {
        if (!predicts(key, c)) continue;
        const Eigen::Array3d outside = (p - centre_of(key, edge_m)).array().abs() - edge_m / 2;
        least = std::min(least, outside.max(0.0).matrix().norm());
      }
      distances.push_back(least);
    }
    return distances;
  }
};

}  // namespace mapscore::eval::testing
