// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#pragma once

#include "core/geometry/camera.hpp"
#include "sim/world/drawn_scene.hpp"

#include <mujoco/mujoco.h>

#include <array>

namespace mapscore::sim {

/// OpenGL's camera for a centred pinhole with square pixels at `T_world_optical`.
[[nodiscard]] mjvGLCamera gl_camera(const CameraModel& camera, const Pose& T_world_optical);

/// What a view needs of the scene: geoms whose bounding ball lies outside are not worth drawing.
class Frustum {
 public:
  Frustum(const CameraModel& camera, const Pose& T_world_optical);

  /// False only when no point of the ball can be seen.
  [[nodiscard]] bool may_see(const Eigen::Vector3d& centre_world, double radius_m) const;

  /// False only when the ball shades nothing that can be seen: a shadow on a visible point comes
  /// from within the convex hull of the frustum and the light.
  [[nodiscard]] bool may_shade(const Eigen::Vector3d& centre_world, double radius_m,
                               const mjvLight& light) const;

 private:
  struct Plane {
    Eigen::Vector3d inward;  ///< unit normal
    Eigen::Vector3d point;
    [[nodiscard]] double distance(const Eigen::Vector3d& p) const { return inward.dot(p - point); }
  };
  std::array<Plane, 5> planes_;  ///< the four sides and the near plane, world frame
};

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
