// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#pragma once

#include "core/geometry/shape.hpp"
#include "sim/world/drawn_scene.hpp"

#include <mujoco/mujoco.h>

#include <string>
#include <vector>

namespace mapscore::sim {

/// Triangles of a compiled mesh, in the frame of its geoms.
[[nodiscard]] std::vector<Triangle> mesh_triangles(const mjModel& model, int mesh);

/// Exact surface of one geom at the pose that `data` holds (kinematics done). Height fields become
/// the triangles that MuJoCo draws: top, sides and base; a signed distance field its mesh. Throws
/// Error naming `scene_file` and the geom when it is of a kind that Shape cannot hold.
[[nodiscard]] Shape surface_of(const mjModel& model, const mjData& data, int geom,
                               const std::string& scene_file);

/// Throws Error naming `scene_file` when the meshes and height fields of `drawn` have so many
/// triangles in all that their surfaces would fill the memory.
void refuse_countless_triangles(const mjModel& model, const DrawnScene& drawn,
                                const std::string& scene_file);

}  // namespace mapscore::sim
