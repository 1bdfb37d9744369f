// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#include "eval/truth/shapes/convex_forms.hpp"

#include <Eigen/QR>
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace mapscore::eval {
namespace {

using Eigen::Vector3d;

constexpr double kGapTolerance_m = 1e-10;
constexpr int kMaxSteps = 500;

/// From the nearest point of the box to p.
Vector3d excess(const Vector3d& p, const Box& box) {
  return p - p.cwiseMax(box.min()).cwiseMin(box.max());
}

/// Corner of the form, numbered along its own axes.
Vector3d turned_corner(const OrientedBox& form, int corner) {
  return form.centre + form.R * corner_of(Box(-form.half, form.half), corner);
}

double squared_distance(const OrientedBox& form, const Vector3d& p) {
  const Vector3d inner = (form.R.transpose() * (p - form.centre)).cwiseAbs();
  return (inner - form.half).cwiseMax(0).squaredNorm();
}

/// Distance to the plane of the triangle for points above or below it, infinite for others: those
/// are nearest to an edge.
double squared_height(const Triangle& t, const Vector3d& p) {
  const Vector3d normal = (t[1] - t[0]).cross(t[2] - t[0]);
  const double area2 = normal.squaredNorm();
  for (int i = 0; i < 3; ++i) {
    const Vector3d edge = t[(i + 1) % 3] - t[i];
    if (normal.dot(edge.cross(p - t[i])) < 0) return std::numeric_limits<double>::infinity();
  }
  if (area2 == 0) return std::numeric_limits<double>::infinity();
  const double height = normal.dot(p - t[0]);
  return height * height / area2;
}

/// Farthest point of a form along `direction`, which is not 0.
Vector3d support(const Ellipsoid& form, const Vector3d& direction) {
  const Vector3d scaled = form.radii.cwiseProduct(form.R.transpose() * direction);
  return form.centre + form.R * form.radii.cwiseProduct(scaled.normalized());
}

Vector3d support(const Cylinder& form, const Vector3d& direction) {
  const Vector3d inner = form.R.transpose() * direction;
  const double across = inner.head<2>().norm();
  Vector3d local{0, 0, std::copysign(form.half, inner.z())};
  if (across > 0) local.head<2>() = inner.head<2>() * (form.radius / across);
  return form.centre + form.R * local;
}

Vector3d support(const Box& box, const Vector3d& direction) {
  return (direction.array() > 0).select(box.max(), box.min());
}

/// Up to four points whose hull lies in the difference of two bodies.
struct Simplex {
  std::array<Vector3d, 4> points;
  int size = 0;
};

/// Point of least norm of the affine hull of some corners, as weights; false when it lies outside.
bool least_norm_weights(const Simplex& simplex, unsigned subset, std::array<double, 4>& weights) {
  std::array<int, 4> corner{};
  int count = 0;
  for (int i = 0; i < simplex.size; ++i) {
    if (subset >> i & 1u) corner[count++] = i;
  }
  weights.fill(0);
  if (count == 1) {
    weights[corner[0]] = 1;
    return true;
  }
  Eigen::Matrix<double, 3, Eigen::Dynamic, 0, 3, 3> edges(3, count - 1);
  const Vector3d& origin = simplex.points[corner[0]];
  for (int c = 1; c < count; ++c) edges.col(c - 1) = simplex.points[corner[c]] - origin;
  const Eigen::Matrix<double, Eigen::Dynamic, 1, 0, 3, 1> x =
      edges.colPivHouseholderQr().solve(-origin);
  weights[corner[0]] = 1 - x.sum();
  for (int c = 1; c < count; ++c) weights[corner[c]] = x[c - 1];
  return std::all_of(weights.begin(), weights.end(), [](double w) { return w >= 0; });
}

/// Point of the simplex nearest to the origin; keeps only the corners that carry it. The last
/// corner is always one of them, being the newest.
Vector3d reduce(Simplex& simplex) {
  const unsigned newest = 1u << (simplex.size - 1);
  Vector3d nearest = simplex.points[simplex.size - 1];
  unsigned kept = newest;
  std::array<double, 4> weights;
  for (unsigned subset = newest + 1; subset < 2 * newest; ++subset) {
    if (!least_norm_weights(simplex, subset, weights)) continue;
    Vector3d p = Vector3d::Zero();
    for (int i = 0; i < simplex.size; ++i) {
      if (subset >> i & 1u) p += weights[i] * simplex.points[i];
    }
    // A flat tetrahedron solves to no nearer a point than one of its sides does.
    if (subset == 15u && p.norm() > kGapTolerance_m) continue;
    if (p.squaredNorm() < nearest.squaredNorm()) {
      nearest = p;
      kept = subset;
    }
  }
  int size = 0;
  for (int i = 0; i < simplex.size; ++i) {
    if (kept >> i & 1u) simplex.points[size++] = simplex.points[i];
  }
  simplex.size = size;
  return nearest;
}

/// |v| is the length of a vector from one body to the other, hence an upper bound; v . w / |v| for
/// the extreme w against v bounds the distance from below.
template <typename RoundForm>
double bounded_gap(const RoundForm& form, const Box& box) {
  Simplex simplex;
  Vector3d v = box.center() - form.centre;
  for (int step = 0; step < kMaxSteps; ++step) {
    const double upper = v.norm();
    if (upper <= kGapTolerance_m) return upper;
    const Vector3d w = support(box, -v) - support(form, v);
    if (upper - v.dot(w) / upper <= kGapTolerance_m) return upper;
    simplex.points[simplex.size++] = w;
    const Vector3d next = reduce(simplex);
    if (simplex.size == 4) return 0;                     // the origin lies within: the bodies meet
    if (step > 0 && next.norm() >= upper) return upper;  // as near as doubles get
    v = next;
  }
  return v.norm();
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

// Two convex polyhedra are nearest at a corner of one and a face of the other or between two edges.
// A segment against the box covers the edges and the form's corners.
double gap(const OrientedBox& form, const Box& box) {
  double least = std::numeric_limits<double>::infinity();
  for (int corner = 0; corner < 8; ++corner) {
    least = std::min(least, squared_distance(form, corner_of(box, corner)));
    for (int bit = 1; bit < 8; bit *= 2) {
      if (corner & bit) continue;
      least = std::min(least, squared_distance(turned_corner(form, corner),
                                               turned_corner(form, corner | bit), box));
    }
  }
  return std::sqrt(least);
}

double gap(const Triangle& form, const Box& box) {
  double least = std::numeric_limits<double>::infinity();
  for (int i = 0; i < 3; ++i) {
    least = std::min(least, squared_distance(form[i], form[(i + 1) % 3], box));
  }
  for (int corner = 0; corner < 8; ++corner) {
    least = std::min(least, squared_height(form, corner_of(box, corner)));
  }
  return std::sqrt(least);
}

double gap(const Ball& form, const Box& box) {
  return std::max(0.0, box.exteriorDistance(form.centre) - form.radius);
}

double gap(const Capsule& form, const Box& box) {
  return std::max(0.0, std::sqrt(squared_distance(form.a, form.b, box)) - form.radius);
}

double gap(const Ellipsoid& form, const Box& box) {
  return bounded_gap(form, box);
}

double gap(const Cylinder& form, const Box& box) {
  return bounded_gap(form, box);
}

}  // namespace mapscore::eval
