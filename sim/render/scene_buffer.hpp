// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#pragma once

#include "sim/world/drawn_scene.hpp"

#include <mujoco/mujoco.h>

namespace mapscore::sim {

/// Owner of an mjvScene with room for a number of geoms, lit as the drawn scene is.
class SceneBuffer {
 public:
  SceneBuffer(const mjModel& model, const DrawnScene& drawn, std::size_t geoms);
  ~SceneBuffer() { mjv_freeScene(&scene_); }
  SceneBuffer(const SceneBuffer&) = delete;
  SceneBuffer& operator=(const SceneBuffer&) = delete;

  void clear() { scene_.ngeom = 0; }
  /// Lit as another drawn scene is.
  void light_as(const DrawnScene& drawn);
  void add(const mjvGeom& geom) { scene_.geoms[scene_.ngeom++] = geom; }
  /// Head lights shine from the camera along its view.
  void look_through(const mjvGLCamera& camera);

  /// Lit colours, with or without shadows; no reflections.
  void show_colours(bool shadows);
  /// Lights of its own in place of the scene's: towards what is looked at, and from above. A face
  /// that is seen gets from 0.5 to 1 of its colour.
  void light_plainly();
  void hide_sky() { scene_.flags[mjRND_SKYBOX] = 0; }
  /// One flat colour a geom: red + 256 green + 65536 blue = segid + 1.
  void show_ids();

  [[nodiscard]] mjvScene& scene() { return scene_; }

 private:
  mjvScene scene_;
};

}  // namespace mapscore::sim
