// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#include "sim/render/scene_buffer.hpp"

#include <algorithm>

namespace mapscore::sim {

SceneBuffer::SceneBuffer(const mjModel& model, const DrawnScene& drawn, std::size_t geoms) {
  mjv_defaultScene(&scene_);
  mjv_makeScene(&model, &scene_, static_cast<int>(std::max<std::size_t>(geoms, 1)));
  std::copy(drawn.lights.begin(), drawn.lights.end(), scene_.lights);
  scene_.nlight = static_cast<int>(drawn.lights.size());
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
