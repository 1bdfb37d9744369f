// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#include "eval/explore/exploration_curve.hpp"

#include <algorithm>

namespace mapscore::eval {
namespace {

double along(const CoveragePoint& point, CurveAxis axis) {
  return axis == CurveAxis::metres ? point.driven_m : point.stamp_s;
}

}  // namespace

std::optional<double> reaches(const ExplorationCurve& curve, double share, CurveAxis axis) {
  for (const CoveragePoint& point : curve)
    if (point.coverage >= share) return along(point, axis);
  return std::nullopt;
}

double coverage_at(const ExplorationCurve& curve, double at, CurveAxis axis) {
  double coverage = 0.0;
  for (const CoveragePoint& point : curve)
    if (along(point, axis) <= at) coverage = point.coverage;
  return coverage;
}

double area_under(const ExplorationCurve& curve, double until, CurveAxis axis) {
  double area = 0.0, coverage = 0.0, from = 0.0;
  for (const CoveragePoint& point : curve) {
    const double to = std::min(along(point, axis), until);
    area += coverage * (to - from);
    from = to;
    coverage = point.coverage;
  }
  area += coverage * (until - from);
  return area / until;
}

}  // namespace mapscore::eval
