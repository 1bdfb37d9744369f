// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#pragma once

#include "core/geometry/shape.hpp"
#include "sim/world/facets.hpp"

#include <mujoco/mujoco.h>

#include <string>
#include <vector>

namespace mapscore::sim {

/// Adds a mesh to what will be compiled. No geom need refer to it: renderers draw it by its id.
void add_mesh(mjSpec* spec, const std::string& name, const Facets& facets);

/// Facets of a mesh that lie flat, each with its own normal; those without an area are left out.
[[nodiscard]] Facets flat_facets(const std::vector<Triangle>& triangles);

/// Makes `geom` draw the mesh of id `mesh`, as it was given, at a pose.
void draw_mesh(const mjModel& model, int mesh, const Pose& T_world_shape, mjvGeom& geom);

}  // namespace mapscore::sim
