// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#include "eval/score/voxel_score.hpp"

#include "eval/score/map_snapshot.hpp"
#include "eval/score/voxel_window.hpp"

#include <algorithm>
#include <span>

namespace mapscore::eval {

namespace {

/// Neighbours whose surface makes a false voxel `near`.
constexpr int kNearVoxels = 1;

void count_predicted(const MapVoxel& voxel, VoxelWindow<SurfaceVoxel>& surface,
                     ClassCounts& counts) {
  const auto of_class = [&](const SurfaceVoxel& row) { return row.class_id == voxel.best_class; };
  const auto rows = surface.at(voxel.key);
  const bool is_true = std::any_of(rows.begin(), rows.end(), of_class);
  const int distance = is_true ? 0 : surface.distance(voxel.key, of_class);
  ++counts.predicted;
  for (ToleranceCounts& at : counts.at_tolerance) at.true_predicted += distance <= at.voxels;
  if (is_true) {
    ++counts.true_predicted;
  } else if (distance <= kNearVoxels) {
    ++counts.false_near;
  } else if (!rows.empty()) {
    ++counts.false_leak;
  } else {
    ++counts.false_floating;
  }
}

void count_visible(const VisibleVoxel& truth, VoxelWindow<MapVoxel>& map, double threshold,
                   ClassCounts& counts) {
  const auto predicts_class = [&](const MapVoxel& voxel) {
    return voxel.best_class == truth.owner && predicted(voxel, threshold);
  };
  const auto voxel = map.at(truth.key);  // one or none
  const bool is_found = !voxel.empty() && predicts_class(voxel.front());
  const int distance = is_found ? 0 : map.distance(truth.key, predicts_class);
  // A whole surface has no samples, and nothing that was seen too little.
  const bool is_seen_well = truth.samples == 0 || truth.samples >= kManySamples;
  ++counts.visible;
  counts.visible_4 += is_seen_well;
  counts.found_4 += is_seen_well && is_found;
  for (ToleranceCounts& at : counts.at_tolerance) at.found += distance <= at.voxels;
  if (is_found) {
    ++counts.found;
  } else if (voxel.empty()) {
    ++counts.missed_unmapped;
  } else if (predicted(voxel.front(), threshold)) {
    ++counts.missed_mislabelled;
  } else {
    ++counts.missed_unlabelled;
  }
}

void count_predictions(const MapSnapshot& map, double threshold, const SurfaceTruth& surface,
                       int reach, Counts& counts) {
  VoxelWindow<SurfaceVoxel> rows(surface.voxels(), std::max(reach, kNearVoxels));
  for (const MapVoxel& voxel : map.voxels()) {
    if (!predicted(voxel, threshold)) continue;
    check_class(voxel.key, voxel.best_class, counts.size());
    count_predicted(voxel, rows, counts[voxel.best_class]);
  }
}

/// V comes class by class, each sorted by key: one walk through the map for each class.
void count_visibles(const MapSnapshot& map, double threshold, const VisibleTruth& visible,
                    int reach, Counts& counts) {
  for (auto rest = visible.voxels(); !rest.empty();) {
    const ClassId owner = rest.front().owner;
    check_class(rest.front().key, owner, counts.size());
    const auto of_class = visible.of(owner);
    VoxelWindow<MapVoxel> rows(map.voxels(), reach);
    for (const VisibleVoxel& truth : of_class) count_visible(truth, rows, threshold, counts[owner]);
    rest = rest.subspan(of_class.size());
  }
}

}  // namespace

Counts score_voxels(const MapSnapshot& map, double threshold, const SurfaceTruth& surface,
                    const VisibleTruth& visible, std::size_t class_count,
                    const ScoreOptions& options) {
  check(options);
  check_same_lattice(surface, visible);
  const int reach = options.tolerances.empty() ? 0 : options.tolerances.back();
  Counts counts = zero_counts(class_count, options);
  count_predictions(map, threshold, surface, reach, counts);
  count_visibles(map, threshold, visible, reach, counts);
  return counts;
}

}  // namespace mapscore::eval
