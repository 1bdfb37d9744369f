// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#include "core/objects/object_box.hpp"

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

namespace mapscore {
namespace {

/// Planes nearer than this, metres, are one.
constexpr double kSamePlane_m = 1e-9;

using Polygon = std::vector<Eigen::Vector3d>;

/// Points p of the box have normal . p <= offset.
struct Face {
  Eigen::Vector3d normal;  ///< outwards
  double offset_m;
  Polygon corners;  ///< counter-clockwise seen from outside
};

std::array<Face, 6> faces_of(const ObjectBox& box) {
  std::array<Face, 6> faces;
  const Eigen::Matrix3d axes = box.T_frame_box.linear();
  for (int axis = 0; axis < 3; ++axis) {
    const Eigen::Vector3d along = 0.5 * box.size_m[axis] * axes.col(axis);
    const Eigen::Vector3d a = 0.5 * box.size_m[(axis + 1) % 3] * axes.col((axis + 1) % 3);
    const Eigen::Vector3d b = 0.5 * box.size_m[(axis + 2) % 3] * axes.col((axis + 2) % 3);
    for (const int side : {-1, 1}) {
      const Eigen::Vector3d middle = box.centre() + side * along;
      const Eigen::Vector3d normal = side * axes.col(axis);
      Polygon corners{middle - a - b, middle + a - b, middle + a + b, middle - a + b};
      if (side < 0) std::reverse(corners.begin(), corners.end());
      faces[static_cast<std::size_t>(2 * axis + (side > 0))] = {normal, normal.dot(middle),
                                                                std::move(corners)};
    }
  }
  return faces;
}

/// Sutherland and Hodgman: the part of a convex polygon on the inner side of a face, widened by
/// kSamePlane_m.
Polygon clipped(const Polygon& polygon, const Face& face) {
  Polygon kept;
  for (std::size_t n = 0; n < polygon.size(); ++n) {
    const Eigen::Vector3d &from = polygon[n], &to = polygon[(n + 1) % polygon.size()];
    const double out_from = face.normal.dot(from) - face.offset_m - kSamePlane_m;
    const double out_to = face.normal.dot(to) - face.offset_m - kSamePlane_m;
    if (out_from <= 0.0) kept.push_back(from);
    if ((out_from < 0.0 && out_to > 0.0) || (out_from > 0.0 && out_to < 0.0))
      kept.push_back(from + out_from / (out_from - out_to) * (to - from));
  }
  return kept;
}

double area_m2(const Polygon& polygon, const Eigen::Vector3d& normal) {
  Eigen::Vector3d twice = Eigen::Vector3d::Zero();
  for (std::size_t n = 2; n < polygon.size(); ++n)
    twice += (polygon[n - 1] - polygon[0]).cross(polygon[n] - polygon[0]);
  return 0.5 * twice.dot(normal);
}

bool same_plane(const Face& a, const Face& b) {
  return (a.normal - b.normal).norm() < kSamePlane_m &&
         std::abs(a.offset_m - b.offset_m) < 2.0 * kSamePlane_m;
}

/// Flux of (p - origin) through the parts of `faces` within `other`. `again`: faces that lie on one
/// of the other's were counted there.
double flux(const std::array<Face, 6>& faces, const std::array<Face, 6>& other,
            const Eigen::Vector3d& origin, bool again) {
  double sum = 0.0;
  for (const Face& face : faces) {
    const auto shared = [&](const Face& of) { return same_plane(face, of); };
    if (again && std::any_of(other.begin(), other.end(), shared)) continue;
    Polygon part = face.corners;
    for (const Face& of : other) part = clipped(part, of);
    sum += area_m2(part, face.normal) * (face.offset_m - face.normal.dot(origin));
  }
  return sum;
}

}  // namespace

std::array<Eigen::Vector3d, 8> ObjectBox::corners() const {
  std::array<Eigen::Vector3d, 8> corners;
  for (std::size_t n = 0; n < 8; ++n) {
    const Eigen::Array3d sides(n & 1 ? 0.5 : -0.5, n & 2 ? 0.5 : -0.5, n & 4 ? 0.5 : -0.5);
    corners[n] = T_frame_box * (sides * size_m.array()).matrix();
  }
  return corners;
}

bool ObjectBox::contains(const Eigen::Vector3d& p) const {
  const Eigen::Vector3d in_box = T_frame_box.inverse() * p;
  return (in_box.array().abs() <= 0.5 * size_m.array()).all();
}

Eigen::AlignedBox3d ObjectBox::bounds() const {
  return cover_in(Pose::Identity(), *this);
}

ObjectBox oriented(const Eigen::AlignedBox3d& box) {
  ObjectBox result;
  result.T_frame_box.translation() = box.center();
  result.size_m = box.sizes();
  return result;
}

Eigen::AlignedBox3d cover_in(const Pose& axes, const ObjectBox& box) {
  const Pose T_axes_box = axes.inverse() * box.T_frame_box;
  const Eigen::Vector3d reach = 0.5 * (T_axes_box.linear().cwiseAbs() * box.size_m);
  return {T_axes_box.translation() - reach, T_axes_box.translation() + reach};
}

bool meet(const ObjectBox& a, const ObjectBox& b) {
  const Eigen::Matrix3d axes_a = a.T_frame_box.linear(), axes_b = b.T_frame_box.linear();
  const Eigen::Vector3d apart = b.centre() - a.centre();
  const auto separated_along = [&](const Eigen::Vector3d& axis) {
    const double reach = 0.5 * ((axes_a.transpose() * axis).cwiseAbs().dot(a.size_m) +
                                (axes_b.transpose() * axis).cwiseAbs().dot(b.size_m));
    return std::abs(apart.dot(axis)) > reach;
  };
  for (int i = 0; i < 3; ++i) {
    if (separated_along(axes_a.col(i)) || separated_along(axes_b.col(i))) return false;
    for (int j = 0; j < 3; ++j) {
      const Eigen::Vector3d axis = axes_a.col(i).cross(axes_b.col(j));
      if (axis.squaredNorm() > 1e-18 && separated_along(axis)) return false;
    }
  }
  return true;
}

double intersection_m3(const ObjectBox& a, const ObjectBox& b) {
  const Eigen::Vector3d apart = a.centre() - b.centre();
  if (apart.norm() > 0.5 * (a.size_m.norm() + b.size_m.norm())) return 0.0;
  const auto faces_a = faces_of(a), faces_b = faces_of(b);
  const double twice =
      flux(faces_a, faces_b, a.centre(), false) + flux(faces_b, faces_a, a.centre(), true);
  return std::clamp(twice / 3.0, 0.0, std::min(a.volume_m3(), b.volume_m3()));
}

double iou(const ObjectBox& a, const ObjectBox& b) {
  const double common = intersection_m3(a, b);
  const double both = a.volume_m3() + b.volume_m3() - common;
  return both > 0.0 ? common / both : 0.0;
}

double overlap_share(const ObjectBox& a, const ObjectBox& b) {
  const double smaller = std::min(a.volume_m3(), b.volume_m3());
  return smaller > 0.0 ? intersection_m3(a, b) / smaller : 0.0;
}

}  // namespace mapscore
