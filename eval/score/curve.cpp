// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#include "eval/score/curve.hpp"

#include "core/error.hpp"
#include "eval/score/metrics.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace mapscore::eval {

namespace {

/// Sorts by falling probability and joins equal ones.
void tidy(std::vector<ProbabilityStep>& steps) {
  std::sort(steps.begin(), steps.end(), [](const ProbabilityStep& a, const ProbabilityStep& b) {
    return a.probability > b.probability;
  });
  std::vector<ProbabilityStep> joined;
  for (const ProbabilityStep& step : steps) {
    if (joined.empty() || joined.back().probability != step.probability) {
      joined.push_back(step);
      continue;
    }
    joined.back().predicted += step.predicted;
    joined.back().true_predicted += step.true_predicted;
    joined.back().found += step.found;
  }
  steps = std::move(joined);
}

void check_class(const VoxelKey& key, ClassId class_id, std::size_t class_count) {
  if (class_id < class_count) return;
  throw Error(
      fmt::format("voxel {},{},{}: class {} is not in the class table of {} classes; "
                  "score against the scene that the map was made of",
                  key.i, key.j, key.k, class_id, class_count));
}

}  // namespace

ClassCurve& ClassCurve::operator+=(const ClassCurve& other) {
  visible += other.visible;
  steps.insert(steps.end(), other.steps.begin(), other.steps.end());
  tidy(steps);
  return *this;
}

std::vector<ClassCurve> curves_of(const MapSnapshot& map, const SurfaceTruth& surface,
                                  const VisibleTruth& visible, std::size_t class_count) {
  std::vector<ClassCurve> curves(class_count);
  for (const MapVoxel& voxel : map.voxels()) {
    if (!predicted(voxel, 0.0)) continue;
    check_class(voxel.key, voxel.best_class, class_count);
    const bool is_true = surface.contains(voxel.key, voxel.best_class);
    const bool is_found = visible.owner_of(voxel.key) == voxel.best_class;
    curves[voxel.best_class].steps.push_back({voxel.probability, 1, is_true, is_found});
  }
  for (const VisibleVoxel& truth : visible.voxels()) {
    check_class(truth.key, truth.owner, class_count);
    ++curves[truth.owner].visible;
  }
  for (ClassCurve& curve : curves) tidy(curve.steps);
  return curves;
}

std::vector<CurvePoint> points_of(const ClassCurve& curve) {
  std::vector<CurvePoint> points;
  CurvePoint point;
  for (const ProbabilityStep& step : curve.steps) {
    point.threshold = step.probability;
    point.predicted += step.predicted;
    point.true_predicted += step.true_predicted;
    point.found += step.found;
    point.precision = ratio(point.true_predicted, point.predicted);
    point.recall = ratio(point.found, curve.visible);
    point.f1 = f1(point.true_predicted, point.predicted, point.found, curve.visible);
    points.push_back(point);
  }
  return points;
}

std::optional<double> average_precision(const ClassCurve& curve) {
  if (curve.visible == 0) return std::nullopt;
  double area = 0.0, recall_before = 0.0;
  for (const CurvePoint& point : points_of(curve)) {
    area += (*point.recall - recall_before) * *point.precision;
    recall_before = *point.recall;
  }
  return area;
}

std::optional<double> best_f1_threshold(const ClassCurve& curve) {
  const std::vector<CurvePoint> points = points_of(curve);
  const auto best =
      std::max_element(points.begin(), points.end(),
                       [](const CurvePoint& a, const CurvePoint& b) { return a.f1 < b.f1; });
  return best == points.end() ? std::nullopt : std::optional(best->threshold);
}

std::optional<double> brier(const ClassCurve& curve) {
  double sum = 0.0;
  std::int64_t voxels = 0;
  for (const ProbabilityStep& step : curve.steps) {
    const double p = step.probability;
    sum += static_cast<double>(step.true_predicted) * (1.0 - p) * (1.0 - p) +
           static_cast<double>(step.predicted - step.true_predicted) * p * p;
    voxels += step.predicted;
  }
  return voxels == 0 ? std::nullopt : std::optional(sum / static_cast<double>(voxels));
}

std::vector<ReliabilityBin> reliability(const ClassCurve& curve, int bins) {
  if (bins < 1) throw Error(fmt::format("reliability.bins: {} must be at least 1", bins));
  struct Sum {
    double probability = 0.0;
    std::int64_t voxels = 0, true_voxels = 0;
  };
  std::vector<Sum> sums(static_cast<std::size_t>(bins));
  for (const ProbabilityStep& step : curve.steps) {
    Sum& sum = sums[static_cast<std::size_t>(
        std::min(bins - 1, static_cast<int>(step.probability * bins)))];
    sum.probability += step.probability * static_cast<double>(step.predicted);
    sum.voxels += step.predicted;
    sum.true_voxels += step.true_predicted;
  }
  std::vector<ReliabilityBin> curve_bins;
  for (int b = 0; b < bins; ++b) {
    const Sum& sum = sums[static_cast<std::size_t>(b)];
    ReliabilityBin bin{
        static_cast<double>(b) / bins, static_cast<double>(b + 1) / bins, sum.voxels, {}, {}};
    if (sum.voxels > 0) bin.mean_probability = sum.probability / static_cast<double>(sum.voxels);
    bin.share_true = ratio(sum.true_voxels, sum.voxels);
    curve_bins.push_back(bin);
  }
  return curve_bins;
}

}  // namespace mapscore::eval
