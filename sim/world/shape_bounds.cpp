// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#include "sim/world/shape_bounds.hpp"

namespace mapscore::sim {
namespace {

/// Half the extents of a primitive along the world's axes.
Eigen::Vector3d half_extents(const Shape& shape) {
  const Eigen::Matrix3d R = shape.T_world_shape.linear();
  const Eigen::Vector3d& size = shape.size;
  if (shape.kind == ShapeKind::sphere) return Eigen::Vector3d::Constant(size.x());
  if (shape.kind == ShapeKind::ellipsoid) return (R * size.asDiagonal()).rowwise().norm();
  if (shape.kind == ShapeKind::capsule)
    return Eigen::Vector3d::Constant(size.x()) + size.y() * R.col(2).cwiseAbs();
  if (shape.kind == ShapeKind::cylinder)  // two circles about the shape's z axis
    return (size.x() * R.leftCols<2>().rowwise().norm()).eval() + size.y() * R.col(2).cwiseAbs();
  return R.cwiseAbs() * size;
}

}  // namespace

Eigen::AlignedBox3d bounds_of(std::span<const Triangle> triangles, const Pose& T_world_mesh) {
  Eigen::AlignedBox3d bounds;
  for (const Triangle& triangle : triangles)
    for (const Eigen::Vector3d& corner : triangle) bounds.extend(T_world_mesh * corner);
  return bounds;
}

Eigen::AlignedBox3d bounds_of(const Shape& shape) {
  if (shape.kind == ShapeKind::mesh) return bounds_of(shape.triangles, shape.T_world_shape);
  const Eigen::Vector3d half = half_extents(shape);
  const Eigen::Vector3d centre = shape.T_world_shape.translation();
  return {centre - half, centre + half};
}

}  // namespace mapscore::sim
