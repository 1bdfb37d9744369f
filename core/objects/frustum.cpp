// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#include "core/objects/frustum.hpp"

#include <algorithm>

namespace mapscore {
namespace {

struct Interval {
  double low, high;
};

Interval along(const Eigen::Vector3d& axis, const std::array<Eigen::Vector3d, 8>& corners) {
  Interval interval{axis.dot(corners[0]), axis.dot(corners[0])};
  for (const Eigen::Vector3d& corner : corners) {
    interval.low = std::min(interval.low, axis.dot(corner));
    interval.high = std::max(interval.high, axis.dot(corner));
  }
  return interval;
}

}  // namespace

Frustum::Frustum(const CameraModel& camera, double near_m, double far_m) {
  const double left = -0.5, right = camera.width_px - 0.5;
  const double top = -0.5, bottom = camera.height_px - 0.5;
  std::size_t n = 0;
  for (const double z : {near_m, far_m})
    for (const auto& [u, v] : {std::pair(left, top), std::pair(right, top),
                               std::pair(right, bottom), std::pair(left, bottom)})
      corners_[n++] = camera.back_project(u, v, z);
  for (std::size_t side = 0; side < 4; ++side) edges_[side] = corners_[side].normalized();
  edges_[4] = Eigen::Vector3d::UnitX();
  edges_[5] = Eigen::Vector3d::UnitY();
  for (std::size_t side = 0; side < 4; ++side)
    normals_[side] = edges_[side].cross(edges_[(side + 1) % 4]);
  normals_[4] = Eigen::Vector3d::UnitZ();
}

bool Frustum::meets(const ObjectBox& box) const {
  const std::array<Eigen::Vector3d, 8> box_corners = box.corners();
  const Eigen::Matrix3d axes = box.T_frame_box.linear();
  const auto separated_along = [&](const Eigen::Vector3d& axis) {
    if (axis.squaredNorm() < 1e-18) return false;  // of parallel edges: no direction at all
    const Interval mine = along(axis, corners_), its = along(axis, box_corners);
    return mine.high < its.low || its.high < mine.low;
  };
  for (const Eigen::Vector3d& normal : normals_)
    if (separated_along(normal)) return false;
  for (int axis = 0; axis < 3; ++axis)
    if (separated_along(axes.col(axis))) return false;
  for (const Eigen::Vector3d& edge : edges_)
    for (int axis = 0; axis < 3; ++axis)
      if (separated_along(edge.cross(axes.col(axis)))) return false;
  return true;
}

}  // namespace mapscore
