// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#include "sim/inventory/scene_inventory.hpp"

#include "sim/world/class_assignment.hpp"
#include "sim/world/compiled_scene.hpp"
#include "sim/world/scene_builder.hpp"
#include "sim/world/shape_bounds.hpp"
#include "sim/world/surfaces.hpp"

#include <set>

namespace mapscore::sim {
namespace {

/// Nothing shines: the headlight is off and every light is missing or off.
bool dark(const mjModel& model) {
  const auto& headlight = model.vis.headlight;
  const auto bright = [](const float* rgb) { return rgb[0] > 0 || rgb[1] > 0 || rgb[2] > 0; };
  if (headlight.active && (bright(headlight.ambient) || bright(headlight.diffuse))) return false;
  for (int light = 0; light < model.nlight; ++light)
    if (model.light_active[light] &&
        (bright(model.light_diffuse + 3 * light) || bright(model.light_ambient + 3 * light)))
      return false;
  return true;
}

std::vector<BodyEntry> bodies_of(const mjModel& model, const Ownership& ownership) {
  std::vector<BodyEntry> bodies(model.nbody);
  for (int body = 0; body < model.nbody; ++body) {
    BodyEntry& entry = bodies[body];
    entry.name = element_name(model, mjOBJ_BODY, body);
    entry.parent = model.body_parentid[body];
    entry.jointed = model.body_jntnum[body] > 0;
    entry.matched = ownership.owner_of_body[body] >= 0;
  }
  return bodies;
}

void count_unseen(const mjModel& model, const Ownership& ownership, const DrawnScene& visible,
                  Unseen& unseen) {
  std::set<std::string> names;
  std::set<int> seen;
  for (const mjvGeom& geom : visible.geoms) {
    const int body = model.geom_bodyid[geom.objid];
    seen.insert(geom.objid);
    if (geom.rgba[3] >= 1.0f || ownership.opaque(body)) continue;
    ++unseen.transparent;
    names.insert(element_name(model, mjOBJ_BODY, body));
  }
  unseen.transparent_bodies.assign(names.begin(), names.end());
  for (int geom = 0; geom < model.ngeom; ++geom) {
    if (seen.contains(geom)) {
      unseen.infinite_planes += is_infinite_plane(model, geom) ? 1 : 0;
    } else {
      (model.geom_group[geom] > 2 ? unseen.hidden_groups : unseen.invisible) += 1;
    }
  }
  unseen.flexes = static_cast<int>(model.nflex);
  unseen.skins = static_cast<int>(model.nskin);
  unseen.sites = static_cast<int>(model.nsite);
  unseen.keyframes = static_cast<int>(model.nkey);
  unseen.no_light = dark(model);
}

}  // namespace

SceneInventory take_inventory(const std::filesystem::path& scene) {
  quiet_mujoco();
  SceneBuilder builder(scene, {});
  const ModelPtr model = builder.compile();
  const DataPtr data(mj_makeData(model.get()));
  place(*model, *data);
  const std::vector<bool> no_robot(model->nbody, false);
  const Ownership ownership = assign_bodies(*model, class_file_beside(scene), no_robot);
  SceneInventory inventory;
  inventory.bodies = bodies_of(*model, ownership);
  count_unseen(*model, ownership, visible_scene(*model, *data), inventory.unseen);
  const DrawnScene solid = solid_scene(*model, *data, ownership, no_robot);
  refuse_countless_triangles(*model, solid, scene.string());
  for (const mjvGeom& geom : solid.geoms) {
    BodyEntry& body = inventory.bodies[model->geom_bodyid[geom.objid]];
    ++body.drawn_geoms;
    if (!is_infinite_plane(*model, geom.objid))
      body.bounds.extend(bounds_of(surface_of(*model, *data, geom.objid, scene.string())));
  }
  for (const BodyEntry& body : inventory.bodies) inventory.bounds.extend(body.bounds);
  return inventory;
}

}  // namespace mapscore::sim
