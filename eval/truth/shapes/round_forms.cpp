// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#include "eval/truth/shapes/convex_forms.hpp"

#include <algorithm>
#include <array>
#include <cmath>

// Ball, capsule and ellipsoid; the cylinder has a file of its own.

namespace mapscore::eval {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;

/// Minimum of x^T Q x over a box, Q positive definite, by active sets. When the minimum over the
/// free axes lies outside the box, the constrained one lies on a side that it violates: otherwise a
/// step towards it would stay inside and lower x^T Q x, which is convex.
class BoxMinimum {
 public:
  BoxMinimum(const Matrix3d& Q, const Vector3d& low, const Vector3d& high)
      : Q_(Q), low_(low), high_(high) {}

  [[nodiscard]] double value() const { return value({true, true, true}, Vector3d::Zero()); }

 private:
  using Free = std::array<bool, 3>;

  double value(const Free& free, const Vector3d& fixed) const {
    const Vector3d x = stationary(free, fixed);
    double best = -1;
    for (int i = 0; i < 3; ++i) {
      if (!free[i] || (x[i] >= low_[i] && x[i] <= high_[i])) continue;
      Free rest = free;
      rest[i] = false;
      Vector3d at = fixed;
      at[i] = x[i] < low_[i] ? low_[i] : high_[i];
      const double candidate = value(rest, at);
      if (best < 0 || candidate < best) best = candidate;
    }
    return best < 0 ? std::max(0.0, x.dot(Q_ * x)) : best;
  }

  /// Q_ff x_f = -Q_fc x_c: free axes f, fixed axes c.
  Vector3d stationary(const Free& free, const Vector3d& fixed) const {
    Vector3d x = fixed;
    std::array<int, 3> axes{};
    int count = 0;
    for (int i = 0; i < 3; ++i) {
      if (free[i]) axes[count++] = i;
    }
    const auto rhs = [&](int i) { return -Q_.row(i).dot(fixed); };  // fixed is 0 on free axes
    if (count == 3) return Vector3d::Zero();
    if (count == 1) x[axes[0]] = rhs(axes[0]) / Q_(axes[0], axes[0]);
    if (count == 2) {
      const int i = axes[0], j = axes[1];
      const double determinant = Q_(i, i) * Q_(j, j) - Q_(i, j) * Q_(j, i);
      x[i] = (rhs(i) * Q_(j, j) - rhs(j) * Q_(i, j)) / determinant;
      x[j] = (rhs(j) * Q_(i, i) - rhs(i) * Q_(j, i)) / determinant;
    }
    return x;
  }

  const Matrix3d& Q_;
  const Vector3d low_, high_;
};

/// Where the ray of the least distance of an inner point ends. Coordinates and radii per axis, p >=
/// 0. The nearest boundary point is x_i = r_i^2 p_i / (s + r_i^2 - r_min^2) with s in (0, r_min^2]
/// such that sum (x_i / r_i)^2 = 1; when even s -> 0 leaves the sum below 1, p lies on the plane
/// across the smallest axis and x leaves that plane.
double inner_distance(const Vector3d& p, const Vector3d& r) {
  int shortest = 0;
  r.minCoeff(&shortest);
  const double r2_min = r[shortest] * r[shortest];
  const auto at = [&](double s) {
    Vector3d x;
    for (int i = 0; i < 3; ++i) {
      x[i] = p[i] == 0 ? 0 : r[i] * r[i] * p[i] / (s + (r[i] * r[i] - r2_min));
    }
    return x;
  };
  const auto level = [&](const Vector3d& x) { return x.cwiseQuotient(r).squaredNorm(); };

  double low = 0, high = r2_min;
  for (int step = 0; step < 2000; ++step) {
    const double middle = 0.5 * (low + high);
    if (middle <= low || middle >= high) break;
    (level(at(middle)) > 1 ? low : high) = middle;
  }
  Vector3d x = at(high);
  const double rest = 1 - level(x);
  if (p[shortest] == 0 && rest > 0) x[shortest] = r[shortest] * std::sqrt(rest);
  return (x - p).norm();
}

}  // namespace

bool meets(const Ball& form, const Box& box) {
  return box.squaredExteriorDistance(form.centre) <= form.radius * form.radius;
}

double depth(const Ball& form, const Vector3d& p) {
  return form.radius - (p - form.centre).norm();
}

bool contains(const Ball& form, const Box& box) {
  const Vector3d farthest = (box.center() - form.centre).cwiseAbs() + 0.5 * box.sizes();
  return farthest.squaredNorm() < form.radius * form.radius;
}

Box bounds_of(const Ball& form) {
  const Vector3d reach = Vector3d::Constant(form.radius);
  return {form.centre - reach, form.centre + reach};
}

bool meets(const Capsule& form, const Box& box) {
  return squared_distance(form.a, form.b, box) <= form.radius * form.radius;
}

double depth(const Capsule& form, const Vector3d& p) {
  return form.radius - std::sqrt(squared_distance(form.a, form.b, p));
}

Box bounds_of(const Capsule& form) {
  const Vector3d reach = Vector3d::Constant(form.radius);
  return {form.a.cwiseMin(form.b) - reach, form.a.cwiseMax(form.b) + reach};
}

bool meets(const Ellipsoid& form, const Box& box) {
  const Matrix3d to_unit = form.radii.cwiseInverse().asDiagonal() * form.R.transpose();
  const Matrix3d Q = to_unit.transpose() * to_unit;
  return BoxMinimum(Q, box.min() - form.centre, box.max() - form.centre).value() <= 1;
}

double depth(const Ellipsoid& form, const Vector3d& p) {
  const Vector3d inner = (form.R.transpose() * (p - form.centre)).cwiseAbs();
  const double level = inner.cwiseQuotient(form.radii).norm();
  return level < 1 ? inner_distance(inner, form.radii) : 1 - level;
}

bool contains(const Ellipsoid& form, const Box& box) {
  for (int corner = 0; corner < 8; ++corner) {
    const Vector3d inner = form.R.transpose() * (corner_of(box, corner) - form.centre);
    if (inner.cwiseQuotient(form.radii).squaredNorm() >= 1) return false;
  }
  return true;
}

Box bounds_of(const Ellipsoid& form) {
  const Vector3d reach = (form.R * form.radii.asDiagonal()).rowwise().norm();
  return {form.centre - reach, form.centre + reach};
}

}  // namespace mapscore::eval
