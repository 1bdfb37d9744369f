// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#pragma once

#include "core/geometry/shape.hpp"

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <variant>

namespace mapscore::eval {

/// Closed axis-aligned box of the map frame, metres.
using Box = Eigen::AlignedBox3d;

// The convex forms that every drawn surface is made of, placed in the map frame. Rotations take the
// form's own axes to the map's. Metres.

/// |R^T (x - centre)| <= half on each axis. A rectangle when half.z is 0.
struct OrientedBox {
  Eigen::Matrix3d R;
  Eigen::Vector3d centre, half;
};

struct Ball {
  Eigen::Vector3d centre;
  double radius;
};

/// |diag(radii)^-1 R^T (x - centre)| <= 1.
struct Ellipsoid {
  Eigen::Matrix3d R;
  Eigen::Vector3d centre, radii;
};

/// All points within `radius` of the segment from `a` to `b`.
struct Capsule {
  Eigen::Vector3d a, b;
  double radius;
};

/// With y = R^T (x - centre): y.x^2 + y.y^2 <= radius^2 and |y.z| <= half.
struct Cylinder {
  Eigen::Matrix3d R;
  Eigen::Vector3d centre;
  double radius, half;
};

using Form = std::variant<OrientedBox, Ball, Ellipsoid, Capsule, Cylinder, Triangle>;

/// Corner 0..7 of a box: bit 0 picks the high x, bit 1 the high y, bit 2 the high z.
[[nodiscard]] inline Eigen::Vector3d corner_of(const Box& box, int corner) {
  return {(corner & 1 ? box.max() : box.min()).x(), (corner & 2 ? box.max() : box.min()).y(),
          (corner & 4 ? box.max() : box.min()).z()};
}

/// True when the closed form and the closed box have a point in common. Exact up to rounding:
/// separating axes (boxes, triangles), the nearest point of a box (balls), a box-constrained least
/// squares problem solved by its active sets (ellipsoids), the least distance of a segment
/// (capsules), the box cut by the slab of the axis and projected along it (cylinders).
[[nodiscard]] bool meets(const OrientedBox& form, const Box& box);
[[nodiscard]] bool meets(const Triangle& form, const Box& box);
[[nodiscard]] bool meets(const Ball& form, const Box& box);
[[nodiscard]] bool meets(const Ellipsoid& form, const Box& box);
[[nodiscard]] bool meets(const Capsule& form, const Box& box);
[[nodiscard]] bool meets(const Cylinder& form, const Box& box);

/// How far a point of the form lies from the form's boundary (metres, <= 0 outside; then only the
/// sign is meaningful). Concave within the form, so the least depth of a box is that of a corner.
/// A triangle has no inside.
[[nodiscard]] double depth(const OrientedBox& form, const Eigen::Vector3d& p);
[[nodiscard]] inline double depth(const Triangle&, const Eigen::Vector3d&) {
  return 0;
}
[[nodiscard]] double depth(const Ball& form, const Eigen::Vector3d& p);
[[nodiscard]] double depth(const Ellipsoid& form, const Eigen::Vector3d& p);
[[nodiscard]] double depth(const Capsule& form, const Eigen::Vector3d& p);
[[nodiscard]] double depth(const Cylinder& form, const Eigen::Vector3d& p);

/// True when the closed box lies in the open interior of the form; forms are convex, so this is a
/// test of the eight corners. Never for a triangle.
[[nodiscard]] bool contains(const OrientedBox& form, const Box& box);
[[nodiscard]] inline bool contains(const Triangle&, const Box&) {
  return false;
}
[[nodiscard]] bool contains(const Ball& form, const Box& box);
[[nodiscard]] bool contains(const Ellipsoid& form, const Box& box);
/// Capsules and cylinders.
template <class RoundForm>
[[nodiscard]] bool contains(const RoundForm& form, const Box& box) {
  for (int corner = 0; corner < 8; ++corner) {
    if (depth(form, corner_of(box, corner)) <= 0) return false;
  }
  return true;
}

/// Smallest axis-aligned box around the form.
[[nodiscard]] Box bounds_of(const OrientedBox& form);
[[nodiscard]] Box bounds_of(const Triangle& form);
[[nodiscard]] Box bounds_of(const Ball& form);
[[nodiscard]] Box bounds_of(const Ellipsoid& form);
[[nodiscard]] Box bounds_of(const Capsule& form);
[[nodiscard]] Box bounds_of(const Cylinder& form);

/// Distance in metres between a closed form and a closed box that have no point in common; 0 or
/// rounding noise when they have. Closed formulas for boxes, triangles, balls and capsules.
/// Ellipsoids and cylinders: the method of Gilbert, Johnson and Keerthi, stopped when its upper and
/// lower bound differ by at most 1e-10 m.
[[nodiscard]] double gap(const OrientedBox& form, const Box& box);
[[nodiscard]] double gap(const Triangle& form, const Box& box);
[[nodiscard]] double gap(const Ball& form, const Box& box);
[[nodiscard]] double gap(const Capsule& form, const Box& box);
[[nodiscard]] double gap(const Ellipsoid& form, const Box& box);
[[nodiscard]] double gap(const Cylinder& form, const Box& box);

/// Squared distance (m^2) between the segment a-b (a point when a = b) and a closed box, or a
/// point.
[[nodiscard]] double squared_distance(const Eigen::Vector3d& a, const Eigen::Vector3d& b,
                                      const Box& box);
[[nodiscard]] double squared_distance(const Eigen::Vector3d& a, const Eigen::Vector3d& b,
                                      const Eigen::Vector3d& p);

}  // namespace mapscore::eval
