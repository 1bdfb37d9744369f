// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#pragma once

#include "core/geometry/shape.hpp"

#include <mujoco/mujoco.h>

#include <Eigen/Core>
#include <array>
#include <string>
#include <vector>

namespace mapscore::sim {

/// Largest distance between a drawn round surface and the exact one.
inline constexpr double kFacetToleranceM = 0.0005;

/// Flat facets of a surface: vertices with outward normals, faces counter-clockwise from outside.
struct Facets {
  std::vector<Eigen::Vector3d> vertices, normals;
  std::vector<std::array<int, 3>> faces;
};

[[nodiscard]] bool is_round(ShapeKind kind);

/// Inscribed facets of a sphere, ellipsoid, capsule or cylinder (sizes as in Shape), every point of
/// them within `tolerance_m` of the exact surface: a step of angle d on a sphere of radius r loses
/// r d^2 / 8 in each of two directions. At least 12 and at most 256 facets around.
[[nodiscard]] Facets facets_of(ShapeKind kind, const Eigen::Vector3d& size, double tolerance_m);

/// Facets of a mesh that lie flat, each with its own normal; those without an area are left out.
[[nodiscard]] Facets flat_facets(const std::vector<Triangle>& triangles);

/// Adds a mesh to what will be compiled. No geom need refer to it: renderers draw it by its id.
mjsMesh* add_mesh(mjSpec* spec, const std::string& name, const std::vector<float>& vertices,
                  const std::vector<int>& faces);
void add_mesh(mjSpec* spec, const std::string& name, const Facets& facets);

/// A box of half sizes; its colour is still to be set.
[[nodiscard]] mjvGeom box_geom(const Eigen::Vector3d& half_m, const Eigen::Vector3d& centre_world,
                               const Eigen::Matrix3d& R_world_box);

/// Makes `geom` draw the mesh of id `mesh`, as it was given, at a pose.
void draw_mesh(const mjModel& model, int mesh, const Pose& T_world_shape, mjvGeom& geom);

}  // namespace mapscore::sim
