// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#include "eval/truth/shapes/segment_distance.hpp"

#include <algorithm>
#include <array>

namespace mapscore::eval {
namespace {

using Eigen::Vector3d;

/// From the nearest point of the box to p.
Vector3d excess(const Vector3d& p, const Box& box) {
  return p - p.cwiseMax(box.min()).cwiseMin(box.max());
}

}  // namespace

// f(t) = |excess(a + t d)|^2 is convex and piecewise quadratic in t; its pieces end where the
// segment crosses a plane of the box. Half its derivative, g(t) = excess . d, is piecewise linear
// and does not fall, so the piece in which it changes sign holds the minimum.
double squared_distance(const Vector3d& a, const Vector3d& b, const Box& box) {
  const Vector3d d = b - a;
  const auto slope = [&](double t) { return excess(a + t * d, box).dot(d); };
  double t_low = 0, t_high = 1, slope_low = slope(0), slope_high = slope(1);
  if (slope_low >= 0) return excess(a, box).squaredNorm();
  if (slope_high <= 0) return excess(b, box).squaredNorm();

  for (int axis = 0; axis < 3; ++axis) {
    for (const double plane : {box.min()[axis], box.max()[axis]}) {
      const double t = d[axis] == 0 ? t_low : (plane - a[axis]) / d[axis];
      if (t <= t_low || t >= t_high) continue;
      const double s = slope(t);
      (s < 0 ? t_low : t_high) = t;
      (s < 0 ? slope_low : slope_high) = s;
    }
  }
  const double t = t_low + (t_high - t_low) * (slope_low / (slope_low - slope_high));
  return excess(a + t * d, box).squaredNorm();
}

double squared_distance(const Vector3d& a, const Vector3d& b, const Vector3d& p) {
  const Vector3d d = b - a;
  const double length2 = d.squaredNorm();
  const double t = length2 == 0 ? 0 : std::clamp((p - a).dot(d) / length2, 0.0, 1.0);
  return (p - (a + t * d)).squaredNorm();
}

}  // namespace mapscore::eval
