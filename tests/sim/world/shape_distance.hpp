// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#pragma once

#include "core/geometry/shape.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace mapscore::sim::testing {

/// Signed distance to a box about the origin; 2D and 3D.
template <typename Vector>
double box_distance(const Vector& p, const Vector& half) {
  const Vector q = p.cwiseAbs() - half;
  return q.cwiseMax(0.0).norm() + std::min(q.maxCoeff(), 0.0);
}

inline double triangle_distance(const Triangle& t, const Eigen::Vector3d& p) {
  const Eigen::Vector3d ab = t[1] - t[0], ac = t[2] - t[0], ap = p - t[0];
  const Eigen::Vector3d n = ab.cross(ac);
  if (n.squaredNorm() > 0) {
    const double u = n.dot(ap.cross(ac)) / n.squaredNorm(),
                 v = n.dot(ab.cross(ap)) / n.squaredNorm();
    if (u >= 0 && v >= 0 && u + v <= 1) return std::abs(ap.dot(n)) / n.norm();
  }
  double nearest = std::numeric_limits<double>::infinity();
  for (int i = 0; i < 3; ++i) {
    const Eigen::Vector3d a = t[i], d = t[(i + 1) % 3] - a;
    const double along =
        d.squaredNorm() > 0 ? std::clamp((p - a).dot(d) / d.squaredNorm(), 0.0, 1.0) : 0;
    nearest = std::min(nearest, (a + along * d - p).norm());
  }
  return nearest;
}

/// Distance of a point in the shape's frame to its surface; for ellipsoids to first order.
inline double distance_to_surface(const Shape& shape, const Eigen::Vector3d& p) {
  const Eigen::Vector3d& s = shape.size;
  const double radial = p.head<2>().norm();
  switch (shape.kind) {
    case ShapeKind::sphere:
      return std::abs(p.norm() - s.x());
    case ShapeKind::box:
      return std::abs(box_distance<Eigen::Vector3d>(p, s));
    case ShapeKind::plane:
      return Eigen::Vector3d(std::max(std::abs(p.x()) - s.x(), 0.0),
                             std::max(std::abs(p.y()) - s.y(), 0.0), p.z())
          .norm();
    case ShapeKind::cylinder:
      return std::abs(box_distance<Eigen::Vector2d>({radial, p.z()}, {s.x(), s.y()}));
    case ShapeKind::capsule: {
      const double beyond = std::max(std::abs(p.z()) - s.y(), 0.0);
      return std::abs(std::hypot(radial, beyond) - s.x());
    }
    case ShapeKind::ellipsoid: {
      const Eigen::Vector3d q = p.cwiseQuotient(s);
      const double slope = q.cwiseQuotient(s).norm();
      return slope > 0 ? std::abs(q.norm() - 1) * q.norm() / slope : s.minCoeff();
    }
    case ShapeKind::mesh:
      break;
  }
  double nearest = std::numeric_limits<double>::infinity();
  for (const Triangle& t : shape.triangles) nearest = std::min(nearest, triangle_distance(t, p));
  return nearest;
}

}  // namespace mapscore::sim::testing
