// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#pragma once

#include "core/geometry/camera.hpp"

#include <mujoco/mujoco.h>

#include <array>

namespace mapscore::sim {

/// Clip planes of every view. Depth buffers hold floats that run to zero far away: a near plane at
/// 0.1 m keeps the error of flat surfaces below 0.05 mm up to 6 m, wherever the far plane is.
inline constexpr double kNearM = 0.1;
inline constexpr double kFarM = 100.0;

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

}  // namespace mapscore::sim
