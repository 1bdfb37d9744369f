// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#include "eval/alignment/surface_points.hpp"

#include "core/geometry/voxel.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>
#include <tuple>
#include <unordered_set>
#include <variant>

namespace mapscore::eval {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;
using Points = std::vector<OrientedPoint>;

/// Middles of equal parts of [-half, half], each at most `spacing_m` long.
std::vector<double> steps(double half_m, double spacing_m) {
  const int count = std::max(1, static_cast<int>(std::ceil(2 * half_m / spacing_m)));
  std::vector<double> middles;
  for (int n = 0; n < count; ++n) middles.push_back(((n + 0.5) / count * 2 - 1) * half_m);
  return middles;
}

/// Directions spread evenly over the sphere by the golden angle.
std::vector<Vector3d> directions(double radius_m, double spacing_m) {
  const double wanted = 4 * std::numbers::pi * std::pow(radius_m / spacing_m, 2);
  const int count = std::max(12, static_cast<int>(std::ceil(wanted)));
  const double golden = std::numbers::pi * (3 - std::sqrt(5.0));
  std::vector<Vector3d> spread;
  for (int n = 0; n < count; ++n) {
    const double z = 1 - (n + 0.5) * 2 / count, r = std::sqrt(1 - z * z);
    spread.emplace_back(r * std::cos(golden * n), r * std::sin(golden * n), z);
  }
  return spread;
}

/// The curved face about `axis` from -half to half along it.
void add_side(const Vector3d& centre, const Vector3d& axis, double radius_m, double half_m,
              double spacing_m, Points& points) {
  const Vector3d x = axis.unitOrthogonal(), y = axis.cross(x);
  for (const double angle : steps(std::numbers::pi, spacing_m / radius_m))
    for (const double along : steps(half_m, spacing_m)) {
      const Vector3d n = std::cos(angle) * x + std::sin(angle) * y;
      points.push_back({centre + radius_m * n + along * axis, n});
    }
}

void add(const OrientedBox& box, double spacing_m, Points& points) {
  for (int axis = 0; axis < 3; ++axis) {
    const bool is_flat = box.half.z() == 0;  // a rectangle, which has one face
    if (is_flat && axis != 2) continue;
    const int b = (axis + 1) % 3, c = (axis + 2) % 3;
    for (const double side : {1.0, -1.0}) {
      if (is_flat && side < 0) continue;
      for (const double u : steps(box.half[b], spacing_m))
        for (const double v : steps(box.half[c], spacing_m)) {
          Vector3d p;
          p[axis] = side * box.half[axis];
          p[b] = u;
          p[c] = v;
          points.push_back({box.centre + box.R * p, side * box.R.col(axis)});
        }
    }
  }
}

void add(const Ball& ball, double spacing_m, Points& points) {
  for (const Vector3d& d : directions(ball.radius, spacing_m))
    points.push_back({ball.centre + ball.radius * d, d});
}

void add(const Ellipsoid& form, double spacing_m, Points& points) {
  for (const Vector3d& d : directions(form.radii.maxCoeff(), spacing_m))
    points.push_back({form.centre + form.R * form.radii.cwiseProduct(d),
                      form.R * d.cwiseQuotient(form.radii).normalized()});
}

void add(const Capsule& form, double spacing_m, Points& points) {
  const Vector3d way = form.b - form.a;
  const Vector3d axis = way.normalized();
  add_side((form.a + form.b) / 2, axis, form.radius, way.norm() / 2, spacing_m, points);
  for (const Vector3d& d : directions(form.radius, spacing_m))
    points.push_back({(d.dot(axis) > 0 ? form.b : form.a) + form.radius * d, d});
}

void add(const Cylinder& form, double spacing_m, Points& points) {
  add_side(form.centre, form.R.col(2), form.radius, form.half, spacing_m, points);
  for (const double side : {1.0, -1.0})
    for (const double u : steps(form.radius, spacing_m))
      for (const double v : steps(form.radius, spacing_m))
        if (std::hypot(u, v) <= form.radius)
          points.push_back(
              {form.centre + form.R * Vector3d(u, v, side * form.half), side * form.R.col(2)});
}

void add(const Triangle& t, double spacing_m, Points& points) {
  const Vector3d u = t[1] - t[0], v = t[2] - t[0];
  const Vector3d n = u.cross(v);
  if (n.norm() == 0) return;
  const double longest = std::max({u.norm(), v.norm(), (u - v).norm()});
  const int parts = std::max(1, static_cast<int>(std::ceil(longest / spacing_m)));
  for (int i = 0; i < parts; ++i)
    for (int j = 0; i + j < parts; ++j)
      points.push_back(
          {t[0] + (i + 1.0 / 3) / parts * u + (j + 1.0 / 3) / parts * v, n.normalized()});
}

/// The area that points are laid over, square metres.
double area_m2(const OrientedBox& box) {
  const Vector3d& h = box.half;  // a rectangle has one face
  return h.z() == 0 ? 4 * h.x() * h.y() : 8 * (h.x() * h.y() + h.y() * h.z() + h.z() * h.x());
}
double area_m2(const Ball& ball) {
  return 4 * std::numbers::pi * ball.radius * ball.radius;
}
double area_m2(const Ellipsoid& form) {
  return area_m2(Ball{form.centre, form.radii.maxCoeff()});
}
double area_m2(const Capsule& form) {
  return 2 * std::numbers::pi * form.radius * ((form.b - form.a).norm() + 2 * form.radius);
}
double area_m2(const Cylinder& form) {
  return 4 * std::numbers::pi * form.radius * form.half + 8 * form.radius * form.radius;
}
double area_m2(const Triangle& t) {
  const double longest =
      std::max({(t[1] - t[0]).norm(), (t[2] - t[0]).norm(), (t[1] - t[2]).norm()});
  return longest * longest / 2;
}

/// Which face of a cube the normal points through, opposite ones as one.
int axis_of(const Vector3d& n) {
  int axis = 0;
  n.cwiseAbs().maxCoeff(&axis);
  return axis;
}

/// Keeps one point for each cell and axis of the normal.
void thin(Points& points, double spacing_m) {
  const auto place = [&](const OrientedPoint& point) {
    return std::tuple(voxel_of(point.p, spacing_m), axis_of(point.n));
  };
  std::ranges::stable_sort(points, {}, place);
  const auto doubled = std::ranges::unique(points, {}, place);
  points.erase(doubled.begin(), doubled.end());
}

/// Solids by slabs across x, so that a point is looked up in those near it alone.
class SolidSlabs {
 public:
  explicit SolidSlabs(std::span<const PreparedShape> pieces) {
    for (const PreparedShape& piece : pieces)
      if (piece.solid())
        for (int slab = slab_of(piece.bounds().min()); slab <= slab_of(piece.bounds().max());
             ++slab)
          slabs_[slab].push_back(&piece);
  }

  /// Whether a point lies inside of a solid, not on its surface.
  [[nodiscard]] bool contain(const Vector3d& p) const {
    const auto slab = slabs_.find(slab_of(p));
    const Box at(p, p);
    return slab != slabs_.end() &&
           std::ranges::any_of(slab->second,
                               [&](const PreparedShape* solid) { return inside_open(*solid, at); });
  }

 private:
  static int slab_of(const Vector3d& p) {
    constexpr double kSlab_m = 0.25, kFarthest_m = 1e6;
    return static_cast<int>(std::floor(std::clamp(p.x(), -kFarthest_m, kFarthest_m) / kSlab_m));
  }

  std::map<int, std::vector<const PreparedShape*>> slabs_;
};

}  // namespace

double bounded_spacing_m(std::span<const PreparedShape> pieces) {
  constexpr double kFine_m = 0.05, kMostPoints = 3e6;
  double sum_m2 = 0.0;
  for (const PreparedShape& piece : pieces)
    sum_m2 += std::visit([](const auto& form) { return area_m2(form); }, piece.form());
  return std::max(kFine_m, std::sqrt(sum_m2 / kMostPoints));
}

std::vector<OrientedPoint> surface_points(std::span<const PreparedShape> pieces, double spacing_m) {
  Points points;
  const SolidSlabs solids(pieces);
  for (const PreparedShape& piece : pieces)
    std::visit([&](const auto& form) { add(form, spacing_m, points); }, piece.form());
  std::erase_if(points, [&](const OrientedPoint& point) { return solids.contain(point.p); });
  thin(points, spacing_m);
  return points;
}

void keep_seen(std::vector<OrientedPoint>& points, std::span<const Eigen::Vector3d> seen) {
  constexpr double kSeenCell_m = 0.03;
  std::unordered_set<std::uint64_t> cells;
  for (const Eigen::Vector3d& p : seen) {
    const VoxelKey at = packable_voxel_of(p, kSeenCell_m).value();
    for (int i = -1; i <= 1; ++i)
      for (int j = -1; j <= 1; ++j)
        for (int k = -1; k <= 1; ++k) cells.insert(pack({at.i + i, at.j + j, at.k + k}));
  }
  std::erase_if(points, [&](const OrientedPoint& point) {
    const auto at = packable_voxel_of(point.p, kSeenCell_m);
    return !at || !cells.contains(pack(*at));
  });
}

}  // namespace mapscore::eval
