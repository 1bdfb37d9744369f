// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#include "sim/world/drawn_scene.hpp"

#include "sim/world/mujoco_session.hpp"

#include <algorithm>

namespace mapscore::sim {
namespace {

using Box3 = Eigen::AlignedBox3d;

mjvOption plain_options() {
  mjvOption options;
  mjv_defaultOption(&options);
  std::fill(std::begin(options.flags), std::end(options.flags), mjtByte{0});
  options.flags[mjVIS_TEXTURE] = options.flags[mjVIS_STATIC] = 1;
  std::fill(std::begin(options.sitegroup), std::end(options.sitegroup), mjtByte{0});
  for (int group = 0; group < mjNGROUP; ++group) options.geomgroup[group] = group < 3;
  return options;
}

Box3 bounds_in(const Pose& T_frame_world, const mjModel& model, const mjData& data,
               const std::vector<int>& geoms) {
  Box3 bounds;
  for (const int geom : geoms) {
    if (model.geom_type[geom] == mjGEOM_PLANE) continue;
    const Pose T_frame_geom = T_frame_world * geom_pose(data, geom);
    const Box3 box = geom_bounds(model, geom);
    for (int corner = 0; corner < 8; ++corner)
      bounds.extend(T_frame_geom * box.corner(static_cast<Box3::CornerType>(corner)));
  }
  return bounds;
}

Box3 extent_in(const Pose& T_frame_world, const mjModel& model) {
  const Eigen::Vector3d middle =
      T_frame_world * Eigen::Map<const Eigen::Vector3d>(model.stat.center);
  const Eigen::Vector3d half = Eigen::Vector3d::Constant(0.5 * model.stat.extent);
  return {middle - half, middle + half};
}

/// MuJoCo's own head light as it is where a file does not change it.
mjvLight head_light() {
  mjvLight light{};
  light.type = mjLIGHT_DIRECTIONAL;
  light.texid = -1;
  light.headlight = 1;
  light.attenuation[0] = 1.0f;
  light.cutoff = 180.0f;
  light.dir[2] = -1.0f;
  std::fill(std::begin(light.ambient), std::end(light.ambient), 0.1f);
  std::fill(std::begin(light.diffuse), std::end(light.diffuse), 0.4f);
  std::fill(std::begin(light.specular), std::end(light.specular), 0.5f);
  return light;
}

}  // namespace

Box3 geom_bounds(const mjModel& model, int geom) {
  const Eigen::Map<const Eigen::Vector3d> centre(model.geom_aabb + 6 * geom);
  const Eigen::Map<const Eigen::Vector3d> half(model.geom_aabb + 6 * geom + 3);
  return {centre - half, centre + half};
}

bool is_infinite_plane(const mjModel& model, int geom) {
  const mjtNum* size = model.geom_size + 3 * geom;
  return model.geom_type[geom] == mjGEOM_PLANE && (size[0] <= 0 || size[1] <= 0);
}

DrawnScene visible_scene(const mjModel& model, mjData& data) {
  mjvScene scene;
  mjv_defaultScene(&scene);
  mjv_makeScene(&model, &scene, static_cast<int>(model.ngeom) + 1000);
  const mjvOption options = plain_options();
  mjvCamera camera;
  mjv_defaultFreeCamera(&model, &camera);
  mjv_updateScene(&model, &data, &options, nullptr, &camera, mjCAT_STATIC | mjCAT_DYNAMIC, &scene);
  DrawnScene drawn;
  std::copy_if(scene.geoms, scene.geoms + scene.ngeom, std::back_inserter(drawn.geoms),
               [](const mjvGeom& geom) { return geom.objtype == mjOBJ_GEOM && geom.rgba[3] > 0; });
  drawn.lights.assign(scene.lights, scene.lights + scene.nlight);
  if (drawn.lights.empty()) drawn.lights.push_back(head_light());
  mjv_freeScene(&scene);
  std::stable_sort(drawn.geoms.begin(), drawn.geoms.end(),
                   [](const mjvGeom& a, const mjvGeom& b) { return a.objid < b.objid; });
  return drawn;
}

void cut_infinite_planes(mjModel& model, const mjData& data, const std::vector<int>& geoms) {
  for (int geom = 0; geom < model.ngeom; ++geom) {
    if (!is_infinite_plane(model, geom)) continue;
    const Pose T_plane_world = geom_pose(data, geom).inverse();
    Box3 bounds = bounds_in(T_plane_world, model, data, geoms);
    if (bounds.isEmpty()) bounds = extent_in(T_plane_world, model);
    Eigen::Vector3d centre = Eigen::Vector3d::Zero();
    for (int axis = 0; axis < 2; ++axis) {
      mjtNum& half_size = model.geom_size[3 * geom + axis];
      if (half_size > 0) continue;
      half_size = 0.5 * bounds.sizes()[axis];
      centre[axis] = bounds.center()[axis];
    }
    mjtNum local[3] = {centre.x(), centre.y(), 0}, shift[3];
    mju_rotVecQuat(shift, local, model.geom_quat + 4 * geom);
    for (int axis = 0; axis < 3; ++axis) model.geom_pos[3 * geom + axis] += shift[axis];
    model.geom_sameframe[geom] = mjSAMEFRAME_NONE;  // else kinematics would not look at geom_pos
  }
}

}  // namespace mapscore::sim
