// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#include "eval/truth/shapes/convex_forms.hpp"

#include <algorithm>
#include <array>
#include <cmath>

namespace mapscore::eval {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;

/// Points of the plane, at most what a box cut by a slab has as corners (8 + 2 x 12 edges).
struct Outline {
  std::array<Vector2d, 32> points;
  int size = 0;
  void add(const Vector2d& p) { points[size++] = p; }
};

double cross(const Vector2d& a, const Vector2d& b) {
  return a.x() * b.y() - a.y() * b.x();
}

/// Corners of the box's part within |z| <= half, in the cylinder's frame, projected along z.
Outline slab_outline(const Cylinder& form, const Box& box) {
  std::array<Vector3d, 8> corners;
  for (int c = 0; c < 8; ++c) {
    corners[c] = form.R.transpose() * (corner_of(box, c) - form.centre);
  }
  Outline outline;
  for (int c = 0; c < 8; ++c) {
    if (std::abs(corners[c].z()) <= form.half) outline.add(corners[c].head<2>());
    for (int bit = 1; bit < 8; bit *= 2) {
      if (c & bit) continue;
      const Vector3d& a = corners[c];
      const Vector3d& b = corners[c | bit];
      for (const double plane : {-form.half, form.half}) {
        if ((a.z() < plane) == (b.z() < plane)) continue;
        const double t = (plane - a.z()) / (b.z() - a.z());
        outline.add(a.head<2>() + t * (b - a).head<2>());
      }
    }
  }
  return outline;
}

/// Convex hull, counter-clockwise (monotone chain); `outline` is sorted. Returns its size.
int hull_of(Outline& outline, std::array<Vector2d, 66>& hull) {
  const auto begin = outline.points.begin(), end = begin + outline.size;
  std::sort(begin, end, [](const Vector2d& a, const Vector2d& b) {
    return a.x() < b.x() || (a.x() == b.x() && a.y() < b.y());
  });
  int size = 0;
  const auto push = [&](const Vector2d& p, int least) {
    while (size >= least && cross(hull[size - 1] - hull[size - 2], p - hull[size - 2]) <= 0) --size;
    hull[size++] = p;
  };
  for (int i = 0; i < outline.size; ++i) push(outline.points[i], 2);
  const int lower = size + 1;
  for (int i = outline.size - 2; i >= 0; --i) push(outline.points[i], lower);
  return size > 1 ? size - 1 : size;  // the last point repeats the first
}

double squared_distance_of_origin(const Vector2d& a, const Vector2d& b) {
  const Vector2d d = b - a;
  const double length2 = d.squaredNorm();
  const double t = length2 == 0 ? 0 : std::clamp(-a.dot(d) / length2, 0.0, 1.0);
  return (a + t * d).squaredNorm();
}

bool hull_within(Outline& outline, double radius) {
  std::array<Vector2d, 66> hull;
  const int size = hull_of(outline, hull);
  bool origin_inside = size > 2;
  for (int i = 0; i < size; ++i) {
    const Vector2d& a = hull[i];
    const Vector2d& b = hull[(i + 1) % size];
    if (squared_distance_of_origin(a, b) <= radius * radius) return true;
    if (cross(b - a, -a) < 0) origin_inside = false;
  }
  return origin_inside;
}

}  // namespace

bool meets(const Cylinder& form, const Box& box) {
  const Vector3d centre = form.R.transpose() * (box.center() - form.centre);
  const Vector3d half = 0.5 * box.sizes();
  const double reach_z = form.R.col(2).cwiseAbs().dot(half);
  if (std::abs(centre.z()) - reach_z > form.half) return false;
  const double from_axis = centre.head<2>().norm();
  if (from_axis <= form.radius && std::abs(centre.z()) <= form.half) return true;
  if (from_axis - half.norm() > form.radius) return false;
  Outline outline = slab_outline(form, box);
  return outline.size > 0 && hull_within(outline, form.radius);
}

double depth(const Cylinder& form, const Vector3d& p) {
  const Vector3d inner = form.R.transpose() * (p - form.centre);
  return std::min(form.radius - inner.head<2>().norm(), form.half - std::abs(inner.z()));
}

Box bounds_of(const Cylinder& form) {
  const Vector3d axis = form.R.col(2);
  const Vector3d disc = (Vector3d::Ones() - axis.cwiseAbs2()).cwiseMax(0).cwiseSqrt();
  const Vector3d reach = form.half * axis.cwiseAbs() + form.radius * disc;
  return {form.centre - reach, form.centre + reach};
}

}  // namespace mapscore::eval
