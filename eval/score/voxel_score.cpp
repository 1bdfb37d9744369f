// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#include "eval/score/voxel_score.hpp"

#include "core/error.hpp"
#include "eval/score/voxel_shell.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace mapscore::eval {

namespace {

/// Neighbours whose surface makes a false voxel `near`.
constexpr int kNearVoxels = 1;

bool on_another_surface(const SurfaceTruth& surface, const VoxelKey& key, ClassId class_id) {
  const auto rows = surface.classes_at(key);
  return std::any_of(rows.begin(), rows.end(),
                     [class_id](const SurfaceVoxel& row) { return row.class_id != class_id; });
}

void count_predicted(const MapVoxel& voxel, const SurfaceTruth& surface, int reach,
                     ClassCounts& counts) {
  const ClassId class_id = voxel.best_class;
  const auto in_surface = [&](const VoxelKey& key) { return surface.contains(key, class_id); };
  const bool is_true = in_surface(voxel.key);
  const int distance = is_true ? 0 : shell_distance(voxel.key, reach, in_surface);
  ++counts.predicted;
  for (ToleranceCounts& at : counts.at_tolerance) at.true_predicted += distance <= at.voxels;
  if (is_true) {
    ++counts.true_predicted;
  } else if (distance <= kNearVoxels) {
    ++counts.false_near;
  } else if (on_another_surface(surface, voxel.key, class_id)) {
    ++counts.false_leak;
  } else {
    ++counts.false_floating;
  }
}

void count_visible(const VisibleVoxel& truth, const MapSnapshot& map, double threshold, int reach,
                   ClassCounts& counts) {
  const auto predicts_class = [&](const MapVoxel* voxel) {
    return voxel && voxel->best_class == truth.owner && predicted(*voxel, threshold);
  };
  const MapVoxel* voxel = map.find(truth.key);
  const bool is_found = predicts_class(voxel);
  const int distance = is_found ? 0 : shell_distance(truth.key, reach, [&](const VoxelKey& key) {
    return predicts_class(map.find(key));
  });
  ++counts.visible;
  for (ToleranceCounts& at : counts.at_tolerance) at.found += distance <= at.voxels;
  if (is_found) {
    ++counts.found;
  } else if (!voxel) {
    ++counts.missed_unmapped;
  } else if (predicted(*voxel, threshold)) {
    ++counts.missed_mislabelled;
  } else {
    ++counts.missed_unlabelled;
  }
}

void check_same_lattice(const SurfaceTruth& surface, const VisibleTruth& visible) {
  if (surface.edge_m() != visible.edge_m()) {
    throw Error(
        fmt::format("voxel_m: surface truth has {} m, visible truth {} m; make both with one size",
                    surface.edge_m(), visible.edge_m()));
  }
}

[[noreturn]] void refuse_class(const VoxelKey& key, ClassId class_id, std::size_t class_count) {
  throw Error(
      fmt::format("voxel {},{},{}: class {} is not in the class table of {} classes; "
                  "score against the scene that the map was made of",
                  key.i, key.j, key.k, class_id, class_count));
}

}  // namespace

Counts score_voxels(const MapSnapshot& map, double threshold, const SurfaceTruth& surface,
                    const VisibleTruth& visible, std::size_t class_count,
                    const ScoreOptions& options) {
  check(options);
  check_same_lattice(surface, visible);
  const int reach = options.tolerances.empty() ? 0 : options.tolerances.back();
  Counts counts = zero_counts(class_count, options);
  for (const MapVoxel& voxel : map.voxels()) {
    if (!predicted(voxel, threshold)) continue;
    if (voxel.best_class >= class_count) refuse_class(voxel.key, voxel.best_class, class_count);
    count_predicted(voxel, surface, std::max(reach, kNearVoxels), counts[voxel.best_class]);
  }
  for (const VisibleVoxel& truth : visible.voxels()) {
    if (truth.owner >= class_count) refuse_class(truth.key, truth.owner, class_count);
    count_visible(truth, map, threshold, reach, counts[truth.owner]);
  }
  return counts;
}

}  // namespace mapscore::eval
