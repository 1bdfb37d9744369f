// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#include "eval/truth/shapes/shape_tests.hpp"

#include "core/error.hpp"

#include <string>
#include <utility>

namespace mapscore::eval {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;

bool form_meets(const PreparedShape& shape, const Box& box) {
  return shape.bounds().intersects(box) &&
         std::visit([&](const auto& form) { return meets(form, box); }, shape.form());
}

bool form_contains(const PreparedShape& shape, const Box& box) {
  return shape.solid() && shape.bounds().contains(box) &&
         std::visit([&](const auto& form) { return contains(form, box); }, shape.form());
}

bool boundary_meets(const PreparedShape& shape, const Box& box) {
  return form_meets(shape, box) && !form_contains(shape, box);
}

void check(const Shape& shape, int index) {
  const std::string where = "shape " + std::to_string(index) + " (" + name_of(shape.kind) +
                            (shape.name.empty() ? "" : " '" + shape.name + "'") + "): ";
  if (!shape.T_world_shape.matrix().allFinite()) {
    throw Error(where + "its pose is not finite; mend the scene or the recording's truth/");
  }
  const auto sizes = shape.size.head(sizes_of(shape.kind));
  if (!sizes.allFinite() || (sizes.array() <= 0).any()) {
    throw Error(where +
                "a size is not positive and finite; give every drawn geom its sizes in metres");
  }
  for (const Triangle& triangle : shape.triangles) {
    for (const Vector3d& corner : triangle) {
      if (!corner.allFinite()) throw Error(where + "a triangle is not finite; mend the mesh");
    }
  }
}

Form form_of(const Shape& shape, const Pose& T_map_shape) {
  const Matrix3d R = T_map_shape.linear();
  const Vector3d centre = T_map_shape.translation();
  const Vector3d& size = shape.size;
  switch (shape.kind) {
    case ShapeKind::plane:
      return OrientedBox{R, centre, {size.x(), size.y(), 0}};
    case ShapeKind::sphere:
      return Ball{centre, size.x()};
    case ShapeKind::capsule:
      return Capsule{centre - size.y() * R.col(2), centre + size.y() * R.col(2), size.x()};
    case ShapeKind::ellipsoid:
      return Ellipsoid{R, centre, size};
    case ShapeKind::cylinder:
      return Cylinder{R, centre, size.x(), size.y()};
    case ShapeKind::box:
    case ShapeKind::mesh:
      break;
  }
  return OrientedBox{R, centre, size};
}

}  // namespace

PreparedShape::PreparedShape(Form form, bool solid, int shape, InstanceId instance)
    : form_(std::move(form)),
      solid_(solid),
      shape_(shape),
      instance_(instance),
      bounds_(std::visit([](const auto& f) { return bounds_of(f); }, form_)) {}

std::vector<PreparedShape> prepare(const std::vector<Shape>& shapes, const Pose& T_map_world) {
  if (!T_map_world.matrix().allFinite()) {
    throw Error("map frame: its origin or yaw is not finite; check map_origin_m and map_yaw_deg");
  }
  std::vector<PreparedShape> pieces;
  for (int index = 0; index < static_cast<int>(shapes.size()); ++index) {
    const Shape& shape = shapes[index];
    check(shape, index);
    const Pose T_map_shape = T_map_world * shape.T_world_shape;
    if (shape.kind != ShapeKind::mesh) {
      pieces.emplace_back(form_of(shape, T_map_shape), shape.solid(), index, shape.instance);
    }
    for (const Triangle& t : shape.triangles) {
      const Triangle placed{T_map_shape * t[0], T_map_shape * t[1], T_map_shape * t[2]};
      pieces.emplace_back(placed, false, index, shape.instance);
    }
  }
  return pieces;
}

bool meets_surface(const PreparedShape& shape, const Box& box) {
  return boundary_meets(shape, widened(box, kContact_m));
}

bool meets_solid(const PreparedShape& shape, const Box& box) {
  return shape.solid() && form_meets(shape, widened(box, kContact_m));
}

bool inside_open(const PreparedShape& shape, const Box& box) {
  return form_contains(shape, widened(box, kContact_m));
}

bool open_meets_surface(const PreparedShape& shape, const Box& box) {
  return boundary_meets(shape, widened(box, -kContact_m));
}

}  // namespace mapscore::eval
