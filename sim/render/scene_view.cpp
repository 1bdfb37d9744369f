// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#include "sim/render/scene_view.hpp"

#include <algorithm>
#include <span>

namespace mapscore::sim {
namespace {

/// Clip planes of every view. Depth buffers hold floats that run to zero far away: a near plane at
/// 0.1 m keeps the error of flat surfaces below 0.05 mm up to 6 m, wherever the far plane is.
constexpr double kNearM = 0.1, kFarM = 100.0;

/// Half extents of the image plane at unit distance.
Eigen::Vector2d half_extents(const CameraModel& camera) {
  return {0.5 * camera.width_px / camera.fx_px, 0.5 * camera.height_px / camera.fy_px};
}

/// Radius with a margin for single precision and for half a texel of a shadow map.
double reach_of(double radius_m) {
  return 1.001 * radius_m + 0.02;
}

mjvLight plain_light(const Eigen::Vector3f& direction, float ambient, float diffuse) {
  mjvLight light{};
  light.type = mjLIGHT_DIRECTIONAL;
  light.texid = -1;
  light.attenuation[0] = 1.0f;
  light.cutoff = 180.0f;
  Eigen::Map<Eigen::Vector3f>(light.dir) = direction.normalized();
  Eigen::Map<Eigen::Vector3f>(light.ambient).setConstant(ambient);
  Eigen::Map<Eigen::Vector3f>(light.diffuse).setConstant(diffuse);
  return light;
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
  for (std::size_t i = 0; i < sides.size(); ++i)
    planes_[i] = {T_world_optical.linear() * sides[i].normalized(), T_world_optical.translation()};
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

SceneBuffer::SceneBuffer(const mjModel& model, const DrawnScene& drawn, std::size_t geoms) {
  mjv_defaultScene(&scene_);
  mjv_makeScene(&model, &scene_, static_cast<int>(std::max<std::size_t>(geoms, 1)));
  light_as(drawn);
}

void SceneBuffer::light_as(const DrawnScene& drawn) {
  std::copy(drawn.lights.begin(), drawn.lights.end(), scene_.lights);
  scene_.nlight = static_cast<int>(drawn.lights.size());
}

void SceneBuffer::look_through(const mjvGLCamera& camera) {
  scene_.camera[0] = scene_.camera[1] = camera;
  for (mjvLight& light : std::span(scene_.lights, static_cast<std::size_t>(scene_.nlight))) {
    if (!light.headlight) continue;
    std::ranges::copy(camera.pos, light.pos);
    std::ranges::copy(camera.forward, light.dir);
  }
}

void SceneBuffer::light_plainly() {
  scene_.lights[0] = plain_light({0, 0, -1}, 0.5f, 0.25f);
  scene_.lights[0].headlight = 1;
  scene_.lights[1] = plain_light({0.35f, 0.6f, -1.0f}, 0.0f, 0.25f);
  scene_.nlight = 2;
}

void SceneBuffer::show_colours(bool shadows) {
  std::fill(std::begin(scene_.flags), std::end(scene_.flags), mjtByte{0});
  scene_.flags[mjRND_SHADOW] = shadows;
  scene_.flags[mjRND_SKYBOX] = scene_.flags[mjRND_CULL_FACE] = 1;
}

void SceneBuffer::show_ids() {
  std::fill(std::begin(scene_.flags), std::end(scene_.flags), mjtByte{0});
  scene_.flags[mjRND_SEGMENT] = scene_.flags[mjRND_IDCOLOR] = scene_.flags[mjRND_CULL_FACE] = 1;
}

}  // namespace mapscore::sim
