// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#pragma once

#include "core/geometry/shape.hpp"

#include <Eigen/Core>
#include <array>
#include <vector>

namespace mapscore::sim {

/// Largest distance between a drawn round surface and the exact one.
inline constexpr double kFacetToleranceM = 0.0005;

/// Flat facets of a round surface: vertices with outward normals, faces counter-clockwise from
/// outside.
struct Facets {
  std::vector<Eigen::Vector3d> vertices, normals;
  std::vector<std::array<int, 3>> faces;
};

[[nodiscard]] bool is_round(ShapeKind kind);

/// Inscribed facets of a sphere, ellipsoid, capsule or cylinder (sizes as in Shape), every point of
/// them within `tolerance_m` of the exact surface: a step of angle d on a sphere of radius r loses
/// r d^2 / 8 in each of two directions. At least 12 and at most 256 facets around.
[[nodiscard]] Facets facets_of(ShapeKind kind, const Eigen::Vector3d& size, double tolerance_m);

}  // namespace mapscore::sim
