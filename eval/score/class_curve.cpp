// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#include "eval/score/class_curve.hpp"

#include "eval/score/metric.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace mapscore::eval {

namespace {

/// F1 that differ by less are equal, so that rounding chooses no threshold.
constexpr double kF1Slack = 1e-12;

/// `sum`: of the steps at the threshold and above.
CurvePoint point_of(double threshold, const CurveStep& sum, std::int64_t visible) {
  return {threshold,
          sum.predicted,
          sum.true_predicted,
          sum.found,
          ratio(sum.true_predicted, sum.predicted),
          ratio(sum.found, visible),
          f1(sum.true_predicted, sum.predicted, sum.found, visible)};
}

}  // namespace

CurveStep& CurveStep::operator+=(const CurveStep& other) {
  predicted += other.predicted;
  true_predicted += other.true_predicted;
  found += other.found;
  probability_sum_billionth += other.probability_sum_billionth;
  return *this;
}

ClassCurve& ClassCurve::operator+=(const ClassCurve& other) {
  visible += other.visible;
  squared_error_billionth += other.squared_error_billionth;
  pool_steps(steps, other.steps, &CurveStep::thousandth);
  return *this;
}

std::vector<CurvePoint> points_of(const ClassCurve& curve) {
  std::vector<CurvePoint> points;
  points.reserve(curve.steps.size());
  CurveStep sum;
  for (const CurveStep& step : curve.steps) {
    sum += step;
    const double threshold = static_cast<double>(step.thousandth) / kCurveSteps;
    points.push_back(point_of(threshold, sum, curve.visible));
  }
  return points;
}

CurvePoint point_at(const ClassCurve& curve, std::optional<double> threshold) {
  CurveStep sum;
  const int least = threshold ? thousandth_of(*threshold) : kCurveSteps + 1;
  for (const CurveStep& step : curve.steps) {
    if (step.thousandth < least) break;
    sum += step;
  }
  return point_of(threshold.value_or(std::numeric_limits<double>::infinity()), sum, curve.visible);
}

std::optional<double> average_precision(const ClassCurve& curve) {
  if (curve.visible == 0) return std::nullopt;
  double area = 0.0;  // times |V|, so that rounding never lifts it above 1
  std::int64_t found_before = 0;
  for (const CurvePoint& point : points_of(curve)) {
    area += static_cast<double>(point.found - found_before) * *point.precision;
    found_before = point.found;
  }
  return area / static_cast<double>(curve.visible);
}

std::optional<double> best_f1_threshold(const ClassCurve& curve) {
  std::optional<double> best;
  double greatest = -1.0;
  for (const CurvePoint& point : points_of(curve)) {
    if (*point.f1 <= greatest + kF1Slack) continue;
    greatest = *point.f1;
    best = point.threshold;
  }
  return best;
}

std::optional<double> brier(const ClassCurve& curve) {
  std::int64_t voxels = 0;
  for (const CurveStep& step : curve.steps) voxels += step.predicted;
  if (voxels == 0) return std::nullopt;
  return static_cast<double>(curve.squared_error_billionth) / kBillion /
         static_cast<double>(voxels);
}

std::vector<ReliabilityBin> reliability(const ClassCurve& curve) {
  std::vector<CurveStep> sums(kReliabilityBins);
  for (const CurveStep& step : curve.steps) {
    const int bin =
        std::min(step.thousandth * kReliabilityBins / kCurveSteps, kReliabilityBins - 1);
    sums[static_cast<std::size_t>(bin)] += step;
  }
  std::vector<ReliabilityBin> bins;
  for (int b = 0; b < kReliabilityBins; ++b) {
    const CurveStep& sum = sums[static_cast<std::size_t>(b)];
    bins.push_back({static_cast<double>(b) / kReliabilityBins,
                    static_cast<double>(b + 1) / kReliabilityBins, sum.predicted, std::nullopt,
                    ratio(sum.true_predicted, sum.predicted)});
    if (sum.predicted > 0)
      bins.back().mean_probability = static_cast<double>(sum.probability_sum_billionth) / kBillion /
                                     static_cast<double>(sum.predicted);
  }
  return bins;
}

std::optional<double> expected_calibration_error(const ClassCurve& curve) {
  double error = 0.0;
  std::int64_t voxels = 0;
  for (const ReliabilityBin& bin : reliability(curve)) {
    if (bin.voxels == 0) continue;
    error += static_cast<double>(bin.voxels) * std::abs(*bin.mean_probability - *bin.share_true);
    voxels += bin.voxels;
  }
  return voxels == 0 ? std::nullopt : std::optional(error / static_cast<double>(voxels));
}

}  // namespace mapscore::eval
