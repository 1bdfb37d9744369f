// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#pragma once

#include "core/classes.hpp"
#include "core/geometry/camera.hpp"
#include "core/geometry/shape.hpp"
#include "sim/world/class_assignment.hpp"
#include "sim/world/drawn_scene.hpp"
#include "sim/world/motion.hpp"
#include "sim/world/mujoco_session.hpp"
#include "sim/world/world.hpp"

#include <memory>
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

/// A motion and where its joints' values go.
struct JointMotion {
  Motion motion;
  std::vector<int> addresses;  ///< in qpos, one a joint
};

struct World::State {
  std::shared_ptr<const CompiledScene> compiled;
  DrawnScene drawn;
  std::vector<Shape> shapes;
  std::shared_ptr<const JointMotion> motion;  ///< none for a world that stands still
};

/// Everything but dynamics: no solver can diverge.
void place(const mjModel& model, mjData& data);

/// The drawn geoms at the pose that `data` holds, without the robot's and the transparent ones;
/// geoms of opaque classes become solid.
[[nodiscard]] DrawnScene solid_scene(const mjModel& model, mjData& data, const Ownership& ownership,
                                     const std::vector<bool>& robot_body);

/// As solid_scene, marked by instance and with round shapes drawn by facets, as renderers need it.
[[nodiscard]] DrawnScene faceted_scene(const CompiledScene& scene, mjData& data,
                                       const std::vector<Shape>& shapes,
                                       const std::vector<Pose>& T_world_shape);

}  // namespace mapscore::sim
