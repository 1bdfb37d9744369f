// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#pragma once

#include "core/geometry/shape.hpp"

#include <mujoco/mujoco.h>

#include <string>
#include <vector>

namespace mapscore::sim {

/// Triangles of a compiled mesh, in the frame of its geoms.
[[nodiscard]] std::vector<Triangle> triangles_of(const mjModel& model, int mesh);

/// Whether a mesh spans more than 2.5 m along both x and y of the world, so that its hull would
/// fill the rooms inside it; false above 20000 triangles.
[[nodiscard]] bool is_room(const std::vector<Triangle>& triangles, const Pose& T_world_mesh);

/// Adds a mesh asset with the vertices of a compiled one; geoms collide with its convex hull.
void add_hull(mjSpec* spec, const std::string& name, const mjModel& model, int mesh);

/// Adds a triangle as a slab 1 cm thick behind its front face. False, and nothing added, where it
/// has no area to speak of, lies above the robot or under the floor.
[[nodiscard]] bool add_slab(mjSpec* spec, const std::string& name, const Triangle& triangle,
                            const Pose& T_world_mesh);

}  // namespace mapscore::sim
