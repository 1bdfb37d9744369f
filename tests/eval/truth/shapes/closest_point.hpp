// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#pragma once

#include "core/geometry/pose.hpp"
#include "core/geometry/shape.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <vector>

/// Nearest points of the drawn shapes to a point, from the shapes' definitions. Metres. Shares no
/// code with what it checks.
namespace mapscore::eval::test {

/// A convex set of the map frame: a shape that is no mesh, or one triangle of a mesh.
struct ConvexSet {
  ShapeKind kind = ShapeKind::box;
  Eigen::Vector3d size = Eigen::Vector3d::Zero();
  Pose T_map_set = Pose::Identity();
  /// Mesh only, in the map frame.
  Triangle triangle{Eigen::Vector3d::Zero(), Eigen::Vector3d::Zero(), Eigen::Vector3d::Zero()};

  [[nodiscard]] bool solid() const { return kind != ShapeKind::plane && kind != ShapeKind::mesh; }
};

inline std::vector<ConvexSet> convex_sets_of(const Shape& shape, const Pose& T_map_world) {
  const Pose T_map_shape = T_map_world * shape.T_world_shape;
  std::vector<ConvexSet> sets;
  for (const Triangle& t : shape.triangles) {
    sets.push_back({ShapeKind::mesh,
                    shape.size,
                    Pose::Identity(),
                    {T_map_shape * t[0], T_map_shape * t[1], T_map_shape * t[2]}});
  }
  if (sets.empty()) {
    ConvexSet set;
    set.kind = shape.kind;
    set.size = shape.size;
    set.T_map_set = T_map_shape;
    sets.push_back(set);
  }
  return sets;
}

inline Eigen::Vector3d nearest_on_segment(const Eigen::Vector3d& a, const Eigen::Vector3d& b,
                                          const Eigen::Vector3d& p) {
  const double length2 = (b - a).squaredNorm();
  const double t = length2 > 0 ? (p - a).dot(b - a) / length2 : 0;
  return a + std::clamp(t, 0.0, 1.0) * (b - a);
}

/// The foot on the triangle's plane where it falls within, else the nearest point of an edge; also
/// of a triangle without area.
inline Eigen::Vector3d nearest_in_triangle(const Triangle& t, const Eigen::Vector3d& p) {
  const Eigen::Vector3d across = (t[1] - t[0]).cross(t[2] - t[0]);
  const Eigen::Vector3d normal = across.normalized();
  const Eigen::Vector3d foot = p - normal.dot(p - t[0]) * normal;
  bool within = across.norm() > 1e-16;  // m^2
  Eigen::Vector3d nearest = t[0];
  for (int i = 0; i < 3; ++i) {
    const Eigen::Vector3d &a = t[i], &b = t[(i + 1) % 3];
    within = within && normal.dot((b - a).cross(foot - a)) >= 0;
    const Eigen::Vector3d candidate = nearest_on_segment(a, b, p);
    if ((candidate - p).norm() < (nearest - p).norm()) nearest = candidate;
  }
  return within ? foot : nearest;
}

/// Nearest point x of an ellipsoid to a point y outside: x_i = a_i^2 y_i / (t + a_i^2) with the
/// t > 0 where x lies on the surface. |x|^2 in units of the radii is convex and falls in t, so
/// Newton's method climbs to it from 0 and never passes it.
inline Eigen::Vector3d nearest_in_ellipsoid(const Eigen::Vector3d& radii,
                                            const Eigen::Vector3d& y) {
  if (y.cwiseQuotient(radii).squaredNorm() <= 1) return y;
  const Eigen::Array3d a2 = radii.array().square();
  double t = 0;
  for (int step = 0; step < 100; ++step) {
    const Eigen::Array3d terms = (radii.array() * y.array() / (t + a2)).square();
    const double next = t + (terms.sum() - 1) / (2 * (terms / (t + a2)).sum());
    if (!(next > t)) break;
    t = next;
  }
  return (a2 * y.array() / (t + a2)).matrix();
}

/// Nearest point of the closed set, solid ones filled, to a point of its own frame.
inline Eigen::Vector3d local_nearest(const ConvexSet& set, const Eigen::Vector3d& y) {
  using Eigen::Vector3d;
  const Vector3d& s = set.size;
  switch (set.kind) {
    case ShapeKind::plane:
      return {std::clamp(y.x(), -s.x(), s.x()), std::clamp(y.y(), -s.y(), s.y()), 0};
    case ShapeKind::box:
      return y.cwiseMax(-s).cwiseMin(s);
    case ShapeKind::sphere:
      return y.norm() <= s.x() ? y : Vector3d(s.x() * y.normalized());
    case ShapeKind::ellipsoid:
      return nearest_in_ellipsoid(s, y);
    case ShapeKind::capsule: {
      const Vector3d core(0, 0, std::clamp(y.z(), -s.y(), s.y()));
      return (y - core).norm() <= s.x() ? y : Vector3d(core + s.x() * (y - core).normalized());
    }
    case ShapeKind::cylinder: {
      const double shrink = std::min(1.0, s.x() / y.head<2>().norm());
      return {shrink * y.x(), shrink * y.y(), std::clamp(y.z(), -s.y(), s.y())};
    }
    case ShapeKind::mesh:
      return nearest_in_triangle(set.triangle, y);
  }
  return y;
}

/// Nearest point of the closed set, solid ones filled; the point itself when it lies within.
inline Eigen::Vector3d nearest_point(const ConvexSet& set, const Eigen::Vector3d& p_map) {
  const Pose T_set_map = set.T_map_set.inverse(Eigen::Isometry);
  return set.T_map_set * local_nearest(set, T_set_map * p_map);
}

/// How deep a point lies in a solid: its distance to the boundary, <= 0 when it is not inside. Of
/// an ellipsoid a bound from above: the distance along the ray from the centre.
inline double depth_in(const ConvexSet& set, const Eigen::Vector3d& p_map) {
  const Eigen::Vector3d y = set.T_map_set.inverse(Eigen::Isometry) * p_map;
  const Eigen::Vector3d& s = set.size;
  switch (set.kind) {
    case ShapeKind::box:
      return (s - y.cwiseAbs()).minCoeff();
    case ShapeKind::sphere:
      return s.x() - y.norm();
    case ShapeKind::ellipsoid: {
      const double part = y.cwiseQuotient(s).norm();
      return part > 0 ? y.norm() * (1 / part - 1) : s.minCoeff();
    }
    case ShapeKind::capsule:
      return s.x() - std::hypot(y.x(), y.y(), std::max(0.0, std::abs(y.z()) - s.y()));
    case ShapeKind::cylinder:
      return std::min(s.x() - y.head<2>().norm(), s.y() - std::abs(y.z()));
    case ShapeKind::plane:
    case ShapeKind::mesh:
      break;
  }
  return 0;
}

}  // namespace mapscore::eval::test
