// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#include "sim/robot/scene_colliders.hpp"

#include "sim/world/compiled_scene.hpp"
#include "sim/world/facets.hpp"
#include "sim/world/shape_bounds.hpp"
#include "sim/world/surfaces.hpp"

#include <fmt/format.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <set>

namespace mapscore::sim {
namespace {

constexpr double kPlaneHalfThicknessM = 0.05;
constexpr double kRoomM = 2.5;
constexpr std::size_t kMostSlabs = 20000;
constexpr double kSlabM = 0.01, kLeastAreaM2 = 1e-6;
constexpr double kHighestM = 1.5, kLowestM = -0.5;  ///< beyond these no robot is

std::string body_name(const mjModel& model, int geom) {
  for (int body = model.geom_bodyid[geom]; body > 0; body = model.body_parentid[body]) {
    const std::string name = element_name(model, mjOBJ_BODY, body);
    if (!name.empty()) return name;
  }
  const std::string name = element_name(model, mjOBJ_GEOM, geom);
  return fmt::format("geom {} of the world body", name.empty() ? fmt::to_string(geom) : name);
}

bool collides(const mjModel& model, int geom) {
  return model.geom_contype[geom] != 0 || model.geom_conaffinity[geom] != 0;
}

/// Ids of the scene's geoms that stand for their bodies.
std::vector<int> standing_geoms(const World& world, mjData& data) {
  const mjModel& model = world.model();
  std::vector<bool> body_collides(model.nbody, false);
  for (int geom = 0; geom < model.ngeom; ++geom)
    if (collides(model, geom)) body_collides[model.geom_bodyid[geom]] = true;
  std::set<int> geoms;
  for (const mjvGeom& drawn : visible_scene(model, data).geoms)
    if (!body_collides[model.geom_bodyid[drawn.objid]]) geoms.insert(drawn.objid);
  for (int geom = 0; geom < model.ngeom; ++geom)
    if (collides(model, geom)) geoms.insert(geom);
  std::erase_if(geoms, [&](int geom) { return world.robot_geom(geom); });
  return {geoms.begin(), geoms.end()};
}

double lowest_m(const mjModel& model, int geom, const Pose& T_world_geom) {
  if (model.geom_type[geom] == mjGEOM_PLANE) return -1e9;
  const Eigen::AlignedBox3d bounds = geom_bounds(model, geom);
  const Eigen::Vector3d reach =
      T_world_geom.linear().cwiseAbs() * (0.5 * bounds.sizes());  // half extents along the world
  return (T_world_geom * bounds.center()).z() - reach.z();
}

void add_height_field(const mjModel& model, int field, const std::string& name, mjSpec* spec) {
  mjsHField* copy = mjs_addHField(spec);
  mjs_setName(copy->element, name.c_str());
  std::copy_n(model.hfield_size + 4 * field, 4, copy->size);
  copy->nrow = model.hfield_nrow[field];
  copy->ncol = model.hfield_ncol[field];
  mjs_setFloat(copy->userdata, model.hfield_data + model.hfield_adr[field],
               copy->nrow * copy->ncol);
}

/// Whether a mesh spans more than 2.5 m along both x and y of the world, so that its hull would
/// fill the rooms inside it; false above 20000 triangles.
bool is_room(const std::vector<Triangle>& triangles, const Pose& T_world_mesh) {
  if (triangles.size() > kMostSlabs) return false;
  const Eigen::AlignedBox3d bounds = bounds_of(triangles, T_world_mesh);
  return bounds.sizes().x() > kRoomM && bounds.sizes().y() > kRoomM;
}

/// Adds a mesh asset with the vertices of a compiled one; geoms collide with its convex hull.
void add_hull(mjSpec* spec, const std::string& name, const mjModel& model, int mesh) {
  const float* vertices = model.mesh_vert + 3 * model.mesh_vertadr[mesh];
  const int* faces = model.mesh_face + 3 * model.mesh_faceadr[mesh];
  add_mesh(spec, name, {vertices, vertices + 3 * model.mesh_vertnum[mesh]},
           {faces, faces + 3 * model.mesh_facenum[mesh]});
}

/// Adds a triangle as a slab 1 cm thick behind its front face. False, and nothing added, where it
/// has no area to speak of, lies above the robot or under the floor.
bool add_slab(mjSpec* spec, const std::string& name, const Triangle& triangle,
              const Pose& T_world_mesh) {
  const Eigen::Vector3d across = (triangle[1] - triangle[0]).cross(triangle[2] - triangle[0]);
  if (across.norm() < 2.0 * kLeastAreaM2) return false;
  const Eigen::AlignedBox3d bounds = bounds_of({&triangle, 1}, T_world_mesh);
  if (bounds.min().z() > kHighestM || bounds.max().z() < kLowestM) return false;
  const Eigen::Vector3d back = -kSlabM * across.normalized();
  std::vector<float> vertices;
  for (const Eigen::Vector3d& shift : {Eigen::Vector3d(0, 0, 0), back})
    for (const Eigen::Vector3d& corner : triangle)
      for (int axis = 0; axis < 3; ++axis)
        vertices.push_back(static_cast<float>(corner[axis] + shift[axis]));
  add_mesh(spec, name, vertices,
           {0, 1, 2, 5, 4, 3, 0, 3, 4, 0, 4, 1, 1, 4, 5, 1, 5, 2, 2, 5, 3, 2, 3, 0});
  return true;
}

/// Copies geoms of a compiled scene into the world body of a spec.
class ColliderCopy {
 public:
  ColliderCopy(const mjModel& model, mjSpec* spec) : model_(model), spec_(spec) {}

  void add(int geom, const Pose& T_world_geom) {
    body_name_ = body_name(model_, geom);
    name_ = fmt::format("scene/{}", geom);
    const int type = model_.geom_type[geom];
    if (type == mjGEOM_PLANE) {
      add_plane(geom, T_world_geom);
    } else if (type == mjGEOM_MESH || type == mjGEOM_SDF) {
      add_mesh_geom(geom, T_world_geom);
    } else if (type == mjGEOM_HFIELD) {
      const int field = model_.geom_dataid[geom];
      const std::string asset = fmt::format("scene/hfield/{}", field);
      if (assets_.insert(asset).second) add_height_field(model_, field, asset, spec_);
      mjs_setString(add_geom(mjGEOM_HFIELD, T_world_geom)->hfieldname, asset.c_str());
    } else {
      std::copy_n(model_.geom_size + 3 * geom, 3,
                  add_geom(static_cast<mjtGeom>(type), T_world_geom)->size);
    }
  }

  std::vector<Collider> take() { return std::move(colliders_); }

 private:
  mjsGeom* add_geom(mjtGeom type, const Pose& T_world_geom) {
    mjsGeom* geom = mjs_addGeom(mjs_findBody(spec_, "world"), nullptr);
    const std::string name = fmt::format("{}/{}", name_, colliders_.size());
    mjs_setName(geom->element, name.c_str());
    geom->type = type;
    geom->contype = geom->conaffinity = 1;
    geom->group = 0;
    const Eigen::Quaterniond q(T_world_geom.linear());
    Eigen::Map<Eigen::Vector3d>(geom->pos) = T_world_geom.translation();
    Eigen::Map<Eigen::Vector4d>(geom->quat) = Eigen::Vector4d(q.w(), q.x(), q.y(), q.z());
    colliders_.push_back({name, body_name_});
    return geom;
  }

  void add_box(const Eigen::AlignedBox3d& bounds, const Pose& T_world_geom) {
    const Pose T_world_box = T_world_geom * Eigen::Translation3d(bounds.center());
    Eigen::Map<Eigen::Vector3d>(add_geom(mjGEOM_BOX, T_world_box)->size) = 0.5 * bounds.sizes();
  }

  void add_plane(int geom, const Pose& T_world_geom) {
    const mjtNum* size = model_.geom_size + 3 * geom;
    const Eigen::Vector3d half(size[0], size[1], 2.0 * kPlaneHalfThicknessM);
    add_box({-half, Eigen::Vector3d(half.x(), half.y(), 0.0)}, T_world_geom);
  }

  void add_mesh_geom(int geom, const Pose& T_world_geom) {
    constexpr double kThinnestM = 0.002;
    const int mesh = model_.geom_dataid[geom];
    const Eigen::AlignedBox3d bounds = geom_bounds(model_, geom);
    if (bounds.sizes().minCoeff() < kThinnestM) {  // a hull needs a volume
      const Eigen::Vector3d half = (0.5 * bounds.sizes()).cwiseMax(0.5 * kThinnestM);
      return add_box({bounds.center() - half, bounds.center() + half}, T_world_geom);
    }
    const std::vector<Triangle> triangles = mesh_triangles(model_, mesh);
    if (is_room(triangles, T_world_geom)) {
      int index = 0;
      for (const Triangle& triangle : triangles) {
        const std::string asset = fmt::format("{}/triangle/{}", name_, index++);
        if (add_slab(spec_, asset, triangle, T_world_geom)) add_asset_geom(asset, T_world_geom);
      }
      return;
    }
    const std::string asset = fmt::format("scene/mesh/{}", mesh);
    if (assets_.insert(asset).second) add_hull(spec_, asset, model_, mesh);
    add_asset_geom(asset, T_world_geom);
  }

  void add_asset_geom(const std::string& asset, const Pose& T_world_geom) {
    mjs_setString(add_geom(mjGEOM_MESH, T_world_geom)->meshname, asset.c_str());
  }

  const mjModel& model_;
  mjSpec* spec_;
  std::string name_, body_name_;
  std::set<std::string> assets_;
  std::vector<Collider> colliders_;
};

}  // namespace

std::vector<Collider> add_scene_colliders(const World& world, double height_m, mjSpec* spec) {
  const mjModel& model = world.model();
  const DataPtr data(mj_makeData(&model));
  place(model, *data);
  ColliderCopy copy(model, spec);
  for (const int geom : standing_geoms(world, *data)) {
    const Pose T_world_geom = geom_pose(*data, geom);
    if (lowest_m(model, geom, T_world_geom) < height_m) copy.add(geom, T_world_geom);
  }
  return copy.take();
}

}  // namespace mapscore::sim
