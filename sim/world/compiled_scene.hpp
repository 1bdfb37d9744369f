// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#pragma once

#include "core/geometry/camera.hpp"
#include "core/geometry/shape.hpp"
#include "sim/world/class_assignment.hpp"
#include "sim/world/drawn_scene.hpp"
#include "sim/world/motion.hpp"
#include "sim/world/mujoco_session.hpp"
#include "sim/world/world.hpp"

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace mapscore::sim {

/// What a scene compiles to; the same at every instant.
struct CompiledScene {
  ModelPtr model;
  std::vector<bool> robot_body;
  Ownership ownership;
  Assignment assignment;
  Calibration calibration;
  std::string hash;
};

/// Everything but dynamics: no solver can diverge.
void place(const mjModel& model, mjData& data);

/// Moves the joints of a motion to where they are at a stamp, and places what hangs on them.
void place_at(const Motion& motion, double stamp_s, const mjModel& model, mjData& data);

/// The drawn geoms at the pose that `data` holds, without the robot's and the transparent ones;
/// geoms of opaque classes become solid.
[[nodiscard]] DrawnScene solid_scene(const mjModel& model, mjData& data, const Ownership& ownership,
                                     const std::vector<bool>& robot_body);

/// As solid_scene, marked by instance and with round shapes drawn by facets, as renderers need it.
[[nodiscard]] DrawnScene faceted_scene(const CompiledScene& scene, mjData& data,
                                       const std::vector<Shape>& shapes,
                                       const std::vector<Pose>& T_world_shape);

/// XXH3 (128 bits, hexadecimal) over the bytes of scene, class file and robot, and over what they
/// compile to, which covers included files, meshes and textures: names, geoms, cameras, lights and
/// assets. Says nothing of where the files lie.
[[nodiscard]] std::string content_hash(const mjModel& model, const std::filesystem::path& scene,
                                       const std::optional<std::filesystem::path>& classes,
                                       const std::filesystem::path& robot);

}  // namespace mapscore::sim
