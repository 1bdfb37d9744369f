// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#include "sim/render/scene_buffer.hpp"

#include <Eigen/Core>
#include <algorithm>
#include <span>

namespace mapscore::sim {
namespace {

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
