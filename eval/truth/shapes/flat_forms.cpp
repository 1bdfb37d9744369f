// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#include "eval/truth/shapes/convex_forms.hpp"

// Forms with flat faces. An axis on which two projections do not overlap proves that the bodies are
// apart, whatever its length and however it was rounded, so near-parallel edges need no special
// case: their axes only fail to separate.

namespace mapscore::eval {
namespace {

using Eigen::Vector3d;

Vector3d unit_cross(int axis, const Vector3d& v) {
  switch (axis) {
    case 0:
      return {0, -v.z(), v.y()};
    case 1:
      return {v.z(), 0, -v.x()};
    default:
      return {-v.y(), v.x(), 0};
  }
}

bool separates(const Vector3d& axis, const OrientedBox& form, const Vector3d& offset,
               const Vector3d& box_half) {
  const double form_radius = (form.R.transpose() * axis).cwiseAbs().dot(form.half);
  return std::abs(axis.dot(offset)) > form_radius + axis.cwiseAbs().dot(box_half);
}

/// True when one of the form's axes is one of the map's. Both bodies are then prisms along it, and
/// what lies apart does so along it or, seen along it, along a side of a rectangle: the crosses of
/// edges are these same axes again.
bool upright(const OrientedBox& form) {
  for (int j = 0; j < 3; ++j) {
    if ((form.R.col(j).array() == 0).count() == 2) return true;
  }
  return false;
}

/// `corners` relative to the centre of the box.
bool separates(const Vector3d& axis, const Triangle& corners, const Vector3d& box_half) {
  const Vector3d at{axis.dot(corners[0]), axis.dot(corners[1]), axis.dot(corners[2])};
  const double radius = axis.cwiseAbs().dot(box_half);
  return at.minCoeff() > radius || at.maxCoeff() < -radius;
}

}  // namespace

bool meets(const OrientedBox& form, const Box& box) {
  const Vector3d half = 0.5 * box.sizes();
  const Vector3d offset = form.centre - box.center();
  for (int i = 0; i < 3; ++i) {
    if (separates(Vector3d::Unit(i), form, offset, half)) return false;
    if (separates(form.R.col(i), form, offset, half)) return false;
  }
  if (upright(form)) return true;
  for (int i = 0; i < 3; ++i) {
    for (int j = 0; j < 3; ++j) {
      if (separates(unit_cross(i, form.R.col(j)), form, offset, half)) return false;
    }
  }
  return true;
}

bool meets(const Triangle& form, const Box& box) {
  const Vector3d half = 0.5 * box.sizes();
  const Vector3d centre = box.center();
  const Triangle corners{form[0] - centre, form[1] - centre, form[2] - centre};
  const std::array<Vector3d, 3> edges{form[1] - form[0], form[2] - form[1], form[0] - form[2]};
  for (int i = 0; i < 3; ++i) {
    if (separates(Vector3d::Unit(i), corners, half)) return false;
  }
  if (separates(edges[0].cross(edges[1]), corners, half)) return false;
  for (int i = 0; i < 3; ++i) {
    for (const Vector3d& edge : edges) {
      if (separates(unit_cross(i, edge), corners, half)) return false;
    }
  }
  return true;
}

double depth(const OrientedBox& form, const Vector3d& p) {
  return (form.half - (form.R.transpose() * (p - form.centre)).cwiseAbs()).minCoeff();
}

bool contains(const OrientedBox& form, const Box& box) {
  const Vector3d at = (form.R.transpose() * (box.center() - form.centre)).cwiseAbs();
  const Vector3d reach = form.R.transpose().cwiseAbs() * (0.5 * box.sizes());
  return ((at + reach).array() < form.half.array()).all();
}

Box bounds_of(const OrientedBox& form) {
  const Vector3d reach = form.R.cwiseAbs() * form.half;
  return {form.centre - reach, form.centre + reach};
}

Box bounds_of(const Triangle& form) {
  return Box(form[0].cwiseMin(form[1]).cwiseMin(form[2]),
             form[0].cwiseMax(form[1]).cwiseMax(form[2]));
}

}  // namespace mapscore::eval
