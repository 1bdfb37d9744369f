// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#include "eval/score/voxel_score.hpp"

#include "eval/score/voxel_window.hpp"

#include <algorithm>
#include <cmath>
#include <span>

namespace mapscore::eval {

namespace {

/// Neighbours whose surface makes a false voxel `near`.
constexpr int kNearVoxels = 1;

using SurfaceWindow = VoxelWindow<SurfaceVoxel>;
using MapWindow = VoxelWindow<MapVoxel>;

/// Calls act(voxel, window into S) for the predicted voxels of the map.
template <class Act>
void for_each_predicted(const MapSnapshot& map, double threshold, SurfaceWindow rows,
                        std::size_t class_count, const Act& act) {
  for (const MapVoxel& voxel : map.voxels()) {
    if (!predicted(voxel, threshold)) continue;
    check_class(voxel.key, voxel.best_class, class_count);
    act(voxel, rows);
  }
}

/// Calls act(truth, window into the map) for the voxels of V. They come class by class, each sorted
/// by key: one walk through the map for each class.
template <class Act>
void for_each_visible(const VisibleTruth& visible, const MapSnapshot& map, int reach,
                      std::size_t class_count, const Act& act) {
  for (auto rest = visible.voxels(); !rest.empty();) {
    const auto of_class = visible.of(rest.front().owner);
    check_class(of_class.front().key, of_class.front().owner, class_count);
    MapWindow rows(map.voxels(), reach);
    for (const VisibleVoxel& truth : of_class) act(truth, rows);
    rest = rest.subspan(of_class.size());
  }
}

bool holds(std::span<const SurfaceVoxel> rows, ClassId class_id) {
  return std::ranges::find(rows, class_id, &SurfaceVoxel::class_id) != rows.end();
}

void count_predicted(const MapVoxel& voxel, SurfaceWindow& surface, ClassCounts& counts) {
  const auto of_class = [&](const SurfaceVoxel& row) { return row.class_id == voxel.best_class; };
  const auto rows = surface.at(voxel.key);
  const bool is_true = holds(rows, voxel.best_class);
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

void count_visible(const VisibleVoxel& truth, MapWindow& map, double threshold,
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

/// The step that a probability belongs to, of a curve that has all of them or none yet.
CurveStep& step_of(ClassCurve& curve, double probability) {
  if (curve.steps.empty()) {
    curve.steps.resize(kCurveSteps + 1);
    for (int k = 0; k <= kCurveSteps; ++k)
      curve.steps[static_cast<std::size_t>(kCurveSteps - k)].thousandth = k;
  }
  return curve.steps[static_cast<std::size_t>(kCurveSteps - thousandth_of(probability))];
}

void add_prediction(double probability, bool is_true, ClassCurve& curve) {
  CurveStep& step = step_of(curve, probability);
  ++step.predicted;
  step.true_predicted += is_true;
  step.probability_sum_billionth += std::llround(kBillion * probability);
  const double error = probability - (is_true ? 1.0 : 0.0);
  curve.squared_error_billionth += std::llround(kBillion * error * error);
}

/// Column of what the map says of one voxel; `voxel` holds it, or nothing.
std::size_t answer_of(std::span<const MapVoxel> voxel, double threshold, std::size_t class_count) {
  if (voxel.empty()) return class_count + kUnmapped;
  return predicted(voxel.front(), threshold) ? voxel.front().best_class : class_count + kUnlabelled;
}

}  // namespace

Counts score_voxels(const MapSnapshot& map, double threshold, const SurfaceTruth& surface,
                    const VisibleTruth& visible, std::size_t class_count,
                    const ScoreOptions& options) {
  check(options);
  check_same_lattice(surface, visible);
  const int reach = options.tolerances.empty() ? 0 : options.tolerances.back();
  Counts counts = zero_counts(class_count, options);
  for_each_predicted(map, threshold, {surface.voxels(), std::max(reach, kNearVoxels)}, class_count,
                     [&](const MapVoxel& voxel, SurfaceWindow& rows) {
                       count_predicted(voxel, rows, counts[voxel.best_class]);
                     });
  for_each_visible(visible, map, reach, class_count,
                   [&](const VisibleVoxel& truth, MapWindow& rows) {
                     count_visible(truth, rows, threshold, counts[truth.owner]);
                   });
  return counts;
}

std::vector<ClassCurve> curves_of(const MapSnapshot& map, const SurfaceTruth& surface,
                                  const VisibleTruth& visible, std::size_t class_count) {
  std::vector<ClassCurve> curves(class_count);
  for_each_predicted(map, 0.0, {surface.voxels(), 0}, class_count,
                     [&](const MapVoxel& voxel, SurfaceWindow& rows) {
                       const bool is_true = holds(rows.at(voxel.key), voxel.best_class);
                       add_prediction(voxel.probability, is_true, curves[voxel.best_class]);
                     });
  for_each_visible(visible, map, 0, class_count, [&](const VisibleVoxel& truth, MapWindow& rows) {
    const auto here = rows.at(truth.key);  // one or none
    if (here.empty() || here.front().best_class != truth.owner || !predicted(here.front(), 0.0))
      return;
    ++step_of(curves[truth.owner], here.front().probability).found;
  });
  for (std::size_t c = 0; c < class_count; ++c) {
    curves[c].visible = static_cast<std::int64_t>(visible.count(static_cast<ClassId>(c)));
    std::erase_if(curves[c].steps, [](const CurveStep& step) { return step.predicted == 0; });
    curves[c].steps.shrink_to_fit();
  }
  return curves;
}

ConfusionMatrix confusion_of(const MapSnapshot& map, double threshold, const SurfaceTruth& surface,
                             const VisibleTruth& visible, std::size_t class_count) {
  check_same_lattice(surface, visible);
  ConfusionMatrix matrix(class_count, kVoxelAnswers);
  for_each_predicted(
      map, threshold, {surface.voxels(), 0}, class_count,
      [&](const MapVoxel& voxel, SurfaceWindow& rows) {
        if (!holds(rows.at(voxel.key), voxel.best_class) && !visible.owner_of(voxel.key))
          matrix.count(kBackground, voxel.best_class);
      });
  for_each_visible(visible, map, 0, class_count, [&](const VisibleVoxel& truth, MapWindow& rows) {
    matrix.count(truth.owner, answer_of(rows.at(truth.key), threshold, class_count));
  });
  return matrix;
}

}  // namespace mapscore::eval
