// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#pragma once

#include "core/geometry/shape.hpp"
#include "sim/world/drawn_scene.hpp"
#include "sim/world/mujoco_session.hpp"

#include <filesystem>
#include <vector>

namespace mapscore::sim {

/// The MJCF scene with the robot's body `base_footprint` attached to its world, names prefixed by
/// `robot/`; kept open so that meshes can be added before it is compiled again. An empty path of
/// the robot: the scene by itself.
class SceneBuilder {
 public:
  /// Files that may cost MuJoCo much are first parsed and compiled in a process of their own.
  /// Throws Error when a file is missing, or MuJoCo refuses it or dies of it.
  SceneBuilder(const std::filesystem::path& scene, const std::filesystem::path& robot);

  /// Throws Error with MuJoCo's reason.
  [[nodiscard]] ModelPtr compile();

  /// Adds one mesh of the fewest facets that stay within kFacetToleranceM for every round shape;
  /// shapes of one size share a mesh. Bodies and geoms keep their ids.
  void add_facets(const std::vector<Shape>& shapes);

 private:
  void attach(const std::filesystem::path& robot);

  std::filesystem::path scene_;
  SpecPtr spec_, robot_spec_;  ///< the latter is null where there is no robot
};

/// Draws the round geoms among `drawn` by the meshes that `add_facets` made of `shapes`, at
/// `T_world_shape` (one of each a geom, in the same order).
void draw_by_facets(const mjModel& model, const std::vector<Shape>& shapes,
                    const std::vector<Pose>& T_world_shape, DrawnScene& drawn);

}  // namespace mapscore::sim
