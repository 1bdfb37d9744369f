// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#include "sim/world/shape_bounds.hpp"

namespace mapscore::sim {
namespace {

/// Half the extents of a primitive along the world's axes.
Eigen::Vector3d half_extents(const Shape& shape) {
  const Eigen::Matrix3d R = shape.T_world_shape.linear();
  const Eigen::Vector3d& size = shape.size;
  const auto disc = [&](double radius) {  // a circle about the shape's z axis
    return (radius * R.leftCols<2>().rowwise().norm()).eval();
  };
  switch (shape.kind) {
    case ShapeKind::sphere:
      return Eigen::Vector3d::Constant(size.x());
    case ShapeKind::ellipsoid:
      return (R * size.asDiagonal()).rowwise().norm();
    case ShapeKind::capsule:
      return Eigen::Vector3d::Constant(size.x()) + size.y() * R.col(2).cwiseAbs();
    case ShapeKind::cylinder:
      return disc(size.x()) + size.y() * R.col(2).cwiseAbs();
    default:
      return R.cwiseAbs() * size;
  }
}

}  // namespace

Eigen::AlignedBox3d bounds_of(const Shape& shape) {
  Eigen::AlignedBox3d bounds;
  if (shape.kind == ShapeKind::mesh) {
    for (const Triangle& triangle : shape.triangles)
      for (const Eigen::Vector3d& corner : triangle) bounds.extend(shape.T_world_shape * corner);
    return bounds;
  }
  const Eigen::Vector3d half = half_extents(shape);
  const Eigen::Vector3d centre = shape.T_world_shape.translation();
  return {centre - half, centre + half};
}

}  // namespace mapscore::sim
