// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#include "sim/render/eye.hpp"

#include <algorithm>

namespace mapscore::sim {
namespace {

/// Half extents of the image plane at unit distance.
Eigen::Vector2d half_extents(const CameraModel& camera) {
  return {0.5 * camera.width_px / camera.fx_px, 0.5 * camera.height_px / camera.fy_px};
}

/// Radius with a margin for single precision and for half a texel of a shadow map.
double reach_of(double radius_m) {
  return 1.001 * radius_m + 0.02;
}

}  // namespace

mjvGLCamera gl_camera(const CameraModel& camera, const Pose& T_world_optical) {
  const Eigen::Vector2d half = kNearM * half_extents(camera);
  mjvGLCamera gl{};
  Eigen::Map<Eigen::Vector3f>(gl.pos) = T_world_optical.translation().cast<float>();
  Eigen::Map<Eigen::Vector3f>(gl.forward) = T_world_optical.linear().col(2).cast<float>();
  Eigen::Map<Eigen::Vector3f>(gl.up) = (-T_world_optical.linear().col(1)).cast<float>();
  gl.frustum_width = static_cast<float>(half.x());
  gl.frustum_top = static_cast<float>(half.y());
  gl.frustum_bottom = -gl.frustum_top;
  gl.frustum_near = static_cast<float>(kNearM);
  gl.frustum_far = static_cast<float>(kFarM);
  return gl;
}

Frustum::Frustum(const CameraModel& camera, const Pose& T_world_optical) {
  const Eigen::Vector2d half = half_extents(camera);
  const std::array<Eigen::Vector3d, 4> sides = {
      Eigen::Vector3d(1, 0, half.x()), Eigen::Vector3d(-1, 0, half.x()),
      Eigen::Vector3d(0, 1, half.y()), Eigen::Vector3d(0, -1, half.y())};
  for (std::size_t i = 0; i < sides.size(); ++i) {
    planes_[i] = {T_world_optical.linear() * sides[i].normalized(), T_world_optical.translation()};
  }
  planes_[4] = {T_world_optical.linear().col(2), T_world_optical * Eigen::Vector3d(0, 0, kNearM)};
}

bool Frustum::may_see(const Eigen::Vector3d& centre_world, double radius_m) const {
  return std::none_of(planes_.begin(), planes_.end(), [&](const Plane& plane) {
    return plane.distance(centre_world) < -reach_of(radius_m);
  });
}

bool Frustum::may_shade(const Eigen::Vector3d& centre_world, double radius_m,
                        const mjvLight& light) const {
  const auto vector = [](const float* v) {
    return Eigen::Map<const Eigen::Vector3f>(v).cast<double>().eval();
  };
  const bool directional = light.type == mjLIGHT_DIRECTIONAL;
  return std::none_of(planes_.begin(), planes_.end(), [&](const Plane& plane) {
    const bool light_inside = directional ? plane.inward.dot(vector(light.dir)) <= 0
                                          : plane.distance(vector(light.pos)) >= 0;
    return light_inside && plane.distance(centre_world) < -reach_of(radius_m);
  });
}

}  // namespace mapscore::sim
