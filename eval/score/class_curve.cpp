// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#include "eval/score/class_curve.hpp"

#include "eval/score/metrics.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>

namespace mapscore::eval {

namespace {

constexpr double kBillion = 1e9;
/// F1 that differ by less are equal, so that rounding chooses no threshold.
constexpr double kF1Slack = 1e-12;

/// Puts a step under those above it.
void lower(CurvePoint& point, const CurveStep& step) {
  point.predicted += step.predicted;
  point.true_predicted += step.true_predicted;
  point.found += step.found;
}

void form_ratios(CurvePoint& point, std::int64_t visible) {
  point.precision = ratio(point.true_predicted, point.predicted);
  point.recall = ratio(point.found, visible);
  point.f1 = f1(point.true_predicted, point.predicted, point.found, visible);
}

void add(const CurveStep& step, CurveStep& to) {
  to.predicted += step.predicted;
  to.true_predicted += step.true_predicted;
  to.found += step.found;
  to.probability_sum_billionth += step.probability_sum_billionth;
}

}  // namespace

ClassCurve& ClassCurve::operator+=(const ClassCurve& other) {
  visible += other.visible;
  squared_error_billionth += other.squared_error_billionth;
  std::vector<CurveStep> merged;
  merged.reserve(steps.size() + other.steps.size());
  std::merge(steps.begin(), steps.end(), other.steps.begin(), other.steps.end(),
             std::back_inserter(merged),
             [](const CurveStep& a, const CurveStep& b) { return a.thousandth > b.thousandth; });
  steps.clear();
  for (const CurveStep& step : merged) {
    if (steps.empty() || steps.back().thousandth != step.thousandth)
      steps.push_back(step);
    else
      add(step, steps.back());
  }
  return *this;
}

std::vector<CurvePoint> points_of(const ClassCurve& curve) {
  std::vector<CurvePoint> points;
  points.reserve(curve.steps.size());
  CurvePoint point;
  for (const CurveStep& step : curve.steps) {
    point.threshold = static_cast<double>(step.thousandth) / kCurveSteps;
    lower(point, step);
    form_ratios(point, curve.visible);
    points.push_back(point);
  }
  return points;
}

CurvePoint point_at(const ClassCurve& curve, std::optional<double> threshold) {
  CurvePoint at;
  at.threshold = threshold.value_or(std::numeric_limits<double>::infinity());
  const int least = threshold ? thousandth_of(*threshold) : kCurveSteps + 1;
  for (const CurveStep& step : curve.steps) {
    if (step.thousandth < least) break;
    lower(at, step);
  }
  form_ratios(at, curve.visible);
  return at;
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
    add(step, sums[static_cast<std::size_t>(bin)]);
  }
  std::vector<ReliabilityBin> bins;
  for (int b = 0; b < kReliabilityBins; ++b) {
    const CurveStep& sum = sums[static_cast<std::size_t>(b)];
    ReliabilityBin bin;
    bin.low = static_cast<double>(b) / kReliabilityBins;
    bin.high = static_cast<double>(b + 1) / kReliabilityBins;
    bin.voxels = sum.predicted;
    bin.share_true = ratio(sum.true_predicted, sum.predicted);
    if (sum.predicted > 0)
      bin.mean_probability = static_cast<double>(sum.probability_sum_billionth) / kBillion /
                             static_cast<double>(sum.predicted);
    bins.push_back(bin);
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
