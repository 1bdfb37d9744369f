// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#include "sim/world/compiled_scene.hpp"

#include "sim/world/scene_builder.hpp"

namespace mapscore::sim {

void place(const mjModel& model, mjData& data) {
  mj_kinematics(&model, &data);
  mj_comPos(&model, &data);
  mj_camlight(&model, &data);
}

DrawnScene solid_scene(const mjModel& model, mjData& data, const Ownership& ownership,
                       const std::vector<bool>& robot_body) {
  DrawnScene drawn = visible_scene(model, data);
  std::erase_if(drawn.geoms, [&](mjvGeom& geom) {
    const int body = model.geom_bodyid[geom.objid];
    if (ownership.opaque(body)) geom.rgba[3] = 1.0f;
    return robot_body[body] || geom.rgba[3] < 1.0f;
  });
  return drawn;
}

DrawnScene faceted_scene(const CompiledScene& scene, mjData& data, const std::vector<Shape>& shapes,
                         const std::vector<Pose>& T_world_shape) {
  DrawnScene drawn = solid_scene(*scene.model, data, scene.ownership, scene.robot_body);
  for (mjvGeom& geom : drawn.geoms) geom.segid = scene.assignment.geom_instances[geom.objid];
  draw_by_facets(*scene.model, shapes, T_world_shape, drawn);
  return drawn;
}

}  // namespace mapscore::sim
