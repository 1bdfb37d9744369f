// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#pragma once

#include <mujoco/mujoco.h>

#include <Eigen/Geometry>
#include <vector>

namespace mapscore::sim {

/// What a renderer draws: geoms in the order of the model, at the pose of loading, the robot's and
/// the transparent ones left out. `objid` is the geom's id in the model, `segid` its instance id,
/// which a segmentation pass shows as colour segid + 1. `modelrbound` is the radius of a sphere
/// about `pos` that holds the geom, 0 where none is known.
struct DrawnScene {
  std::vector<mjvGeom> geoms;
  std::vector<mjvLight> lights;
};

/// Every geom that MuJoCo draws at the pose that `data` holds (kinematics done), with its effective
/// colour and alpha, and the lights; where a scene has none and switches its head light off, a head
/// light all the same. Groups 3 to 5, alpha 0, sites, flexes and skins are left out.
[[nodiscard]] DrawnScene visible_scene(const mjModel& model, mjData& data);

/// Least box along the axes of a geom that holds it, as MuJoCo has it.
[[nodiscard]] Eigen::AlignedBox3d geom_bounds(const mjModel& model, int geom);

/// Whether a geom is a plane without end along x or y.
[[nodiscard]] bool is_infinite_plane(const mjModel& model, int geom);

/// Gives planes without end the size of the rectangle that all other geoms among `geoms` cover on
/// them; where there are none, of the square of half the scene's extent about its centre.
/// Kinematics must be done again afterwards.
void cut_infinite_planes(mjModel& model, const mjData& data, const std::vector<int>& geoms);

}  // namespace mapscore::sim
