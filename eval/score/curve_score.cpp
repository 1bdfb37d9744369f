// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#include "eval/score/curve_score.hpp"

#include "eval/score/map_snapshot.hpp"
#include "eval/score/voxel_window.hpp"

#include <algorithm>
#include <cmath>
#include <span>

namespace mapscore::eval {

namespace {

constexpr double kBillion = 1e9;

/// A curve under way: a place for every step. Made when a class has its first voxel.
class DenseCurve {
 public:
  /// The voxels' row of the step that a probability belongs to.
  [[nodiscard]] CurveStep& at(double probability) {
    if (steps_.empty()) steps_.resize(kCurveSteps + 1);
    return steps_[static_cast<std::size_t>(thousandth_of(probability))];
  }
  void add(double probability, bool is_true) {
    CurveStep& step = at(probability);
    ++step.predicted;
    step.true_predicted += is_true;
    step.probability_sum_billionth += std::llround(kBillion * probability);
    const double error = probability - (is_true ? 1.0 : 0.0);
    squared_error_billionth_ += std::llround(kBillion * error * error);
  }
  [[nodiscard]] ClassCurve take(std::int64_t visible) const {
    ClassCurve curve{visible, squared_error_billionth_, {}};
    for (std::size_t k = steps_.size(); k-- > 0;) {
      if (steps_[k].predicted == 0) continue;
      curve.steps.push_back(steps_[k]);
      curve.steps.back().thousandth = static_cast<int>(k);
    }
    return curve;
  }

 private:
  std::vector<CurveStep> steps_;  ///< by rising thousandth
  std::int64_t squared_error_billionth_ = 0;
};

void add_voxels(const MapSnapshot& map, const SurfaceTruth& surface,
                std::vector<DenseCurve>& curves) {
  VoxelWindow<SurfaceVoxel> rows(surface.voxels(), 0);
  for (const MapVoxel& voxel : map.voxels()) {
    if (!predicted(voxel, 0.0)) continue;
    check_class(voxel.key, voxel.best_class, curves.size());
    const auto here = rows.at(voxel.key);
    const bool is_true = std::any_of(here.begin(), here.end(), [&](const SurfaceVoxel& row) {
      return row.class_id == voxel.best_class;
    });
    curves[voxel.best_class].add(voxel.probability, is_true);
  }
}

/// V of one class, sorted by key.
void add_found(const MapSnapshot& map, std::span<const VisibleVoxel> visible, DenseCurve& curve) {
  VoxelWindow<MapVoxel> rows(map.voxels(), 0);
  for (const VisibleVoxel& truth : visible) {
    const auto here = rows.at(truth.key);  // one or none
    if (here.empty() || here.front().best_class != truth.owner || !predicted(here.front(), 0.0))
      continue;
    ++curve.at(here.front().probability).found;
  }
}

}  // namespace

std::vector<ClassCurve> curves_of(const MapSnapshot& map, const SurfaceTruth& surface,
                                  const VisibleTruth& visible, std::size_t class_count) {
  std::vector<DenseCurve> dense(class_count);
  add_voxels(map, surface, dense);
  for (auto rest = visible.voxels(); !rest.empty();) {
    const ClassId owner = rest.front().owner;
    check_class(rest.front().key, owner, class_count);
    const auto of_class = visible.of(owner);
    add_found(map, of_class, dense[owner]);
    rest = rest.subspan(of_class.size());
  }
  std::vector<ClassCurve> curves;
  for (std::size_t c = 0; c < class_count; ++c) {
    const std::size_t visible_count = visible.count(static_cast<ClassId>(c));
    curves.push_back(dense[c].take(static_cast<std::int64_t>(visible_count)));
  }
  return curves;
}

}  // namespace mapscore::eval
