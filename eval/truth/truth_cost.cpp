// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#include "eval/truth/truth_cost.hpp"

#include "core/error.hpp"
#include "eval/truth/shapes/shape_tests.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <numbers>
#include <variant>

namespace mapscore::eval {
namespace {

using Eigen::Vector3d;
using std::numbers::pi;

/// A row, once; the slabs that it is joined from are let go as it grows.
constexpr double kBytesOfVoxel = sizeof(SurfaceVoxel);
/// A row, and two to four slots of its index.
constexpr double kBytesOfViewedVoxel = 80;
/// Measured, of the three homes: 0.39 to 0.44 us at 5 mm, up to 0.7 us at 2 cm.
constexpr double kSecondsOfVoxel = 0.5e-6;

/// What the number of cubes that a convex piece meets follows from.
struct Extent {
  double volume = 0;  ///< m^3
  Vector3d shadows;   ///< area of the projection along each axis of the map, m^2
  double thinnest = 0;
};

Extent extent_of(const OrientedBox& box) {
  const Vector3d edge = 2 * box.half;
  const Vector3d faces(edge.y() * edge.z(), edge.z() * edge.x(), edge.x() * edge.y());
  return {edge.prod(), box.R.cwiseAbs() * faces, edge.minCoeff()};
}

Extent extent_of(const Ball& ball) {
  const double r = ball.radius;
  return {4.0 / 3.0 * pi * r * r * r, Vector3d::Constant(pi * r * r), 2 * r};
}

Extent extent_of(const Ellipsoid& form) {
  const Vector3d& r = form.radii;
  const Vector3d faces(r.y() * r.z(), r.z() * r.x(), r.x() * r.y());
  return {4.0 / 3.0 * pi * r.prod(), pi * (form.R * faces.asDiagonal()).rowwise().norm(),
          2 * r.minCoeff()};
}

/// Shadows of the round side of a cylinder about `axis`, a unit vector.
Vector3d side_shadows(const Vector3d& axis, double radius, double length) {
  return 2 * radius * length * (1.0 - axis.array().square()).max(0.0).sqrt().matrix();
}

Extent extent_of(const Capsule& form) {
  const double r = form.radius, length = (form.b - form.a).norm();
  const Vector3d axis = length > 0 ? Vector3d((form.b - form.a) / length) : Vector3d::UnitZ();
  return {pi * r * r * (length + 4.0 / 3.0 * r),
          side_shadows(axis, r, length) + Vector3d::Constant(pi * r * r), 2 * r};
}

Extent extent_of(const Cylinder& form) {
  const double disc = pi * form.radius * form.radius, length = 2 * form.half;
  const Vector3d axis = form.R.col(2);
  return {disc * length, side_shadows(axis, form.radius, length) + disc * axis.cwiseAbs(),
          std::min(2 * form.radius, length)};
}

Extent extent_of(const Triangle& t) {
  return {0, 0.5 * (t[1] - t[0]).cross(t[2] - t[0]).cwiseAbs(), 0};
}

/// Cubes of edge w on a lattice of edge h that meet the piece's surface, on the mean.
double voxels_of(const PreparedShape& piece, double w, double h) {
  const auto [volume, shadows, thinnest] =
      std::visit([](const auto& form) { return extent_of(form); }, piece.form());
  const double area = w * shadows.sum();
  if (std::holds_alternative<Triangle>(piece.form())) return area / (h * h * h);
  const double lengths = w * w * piece.bounds().sizes().sum(), cube = w * w * w;
  const double met = volume + area + lengths + cube;
  const double inside = thinnest > w ? std::max(0.0, volume - area + lengths - cube) : 0.0;
  return (met - inside) / (h * h * h);
}

}  // namespace

TruthCost truth_cost(const std::vector<Shape>& shapes, const Pose& T_map_world,
                     const SurfaceOptions& options) {
  const double w = options.edge_m + 2 * options.epsilon_m;
  TruthCost cost;
  for (const PreparedShape& piece : prepare(shapes, T_map_world))
    cost.voxels += voxels_of(piece, w, options.edge_m);
  cost.bytes = cost.voxels * kBytesOfVoxel;
  cost.whole_view = cost.voxels * kBytesOfViewedVoxel;
  cost.seconds = cost.voxels * kSecondsOfVoxel;
  return cost;
}

void refuse_too_large(const TruthCost& cost, double edge_m, double available_bytes) {
  constexpr double kMost = 4e9, kLeast = 256e6;
  if (cost.bytes <= std::clamp(0.5 * available_bytes, kLeast, kMost)) return;
  throw Error(
      fmt::format("truth at {} m: about {:.0f} million voxels, {:.1f} GB and {:.1f} minutes; add "
                  "--yes, or take larger voxels",
                  edge_m, cost.voxels / 1e6, cost.bytes / 1e9, cost.seconds / 60));
}

}  // namespace mapscore::eval
