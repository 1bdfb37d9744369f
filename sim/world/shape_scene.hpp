// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#pragma once

#include "core/classes.hpp"
#include "core/geometry/shape.hpp"
#include "sim/world/drawn_scene.hpp"
#include "sim/world/mujoco_session.hpp"

#include <vector>

namespace mapscore::sim {

/// What a renderer needs to draw shapes without the scene that they came from.
struct ShapeScene {
  ModelPtr model;             ///< holds their meshes and nothing else
  std::vector<Shape> shapes;  ///< those that have an area
  DrawnScene drawn;           ///< one geom a shape; `objid`: its place among them
};

/// Boxes as they are, round shapes by facets, planes and meshes seen from their front alone, as
/// MuJoCo draws them; in the colours of their classes, muted, and light grey for background.
/// Throws Error with MuJoCo's reason when a mesh is refused.
[[nodiscard]] ShapeScene scene_of_shapes(std::vector<Shape> shapes, const ClassTable& table);

}  // namespace mapscore::sim
