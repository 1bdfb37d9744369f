// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#pragma once

#include "sim/world/world.hpp"

#include <mujoco/mujoco.h>

#include <string>
#include <vector>

namespace mapscore::sim {

/// A geom that stands in the robot's way: its name in the model of the drive, and what it is to a
/// reader: the nearest named body at or above it in the scene.
struct Collider {
  std::string geom_name;
  std::string body_name;
};

/// Adds to `spec`'s world what a robot of `height_m` can run into, as geoms that never move, at the
/// pose of loading. Bodies with geoms that collide (contype or conaffinity) stand with those;
/// bodies without stand with their drawn geoms, glass included. Planes become boxes 0.1 m thick of
/// their drawn size. Meshes stand as their convex hulls, unless they span more than 2.5 m both ways
/// on the floor (a room in one piece): then each triangle stands for itself, 1 cm thick. Geoms
/// whose bounds begin above `height_m` are left out.
[[nodiscard]] std::vector<Collider> add_scene_colliders(const World& world, double height_m,
                                                        mjSpec* spec);

}  // namespace mapscore::sim
