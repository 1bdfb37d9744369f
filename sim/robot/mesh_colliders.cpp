// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#include "sim/robot/mesh_colliders.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>

namespace mapscore::sim {
namespace {

constexpr double kRoomM = 2.5;
constexpr std::size_t kMostSlabs = 20000;
constexpr double kSlabM = 0.01, kLeastAreaM2 = 1e-6;
constexpr double kHighestM = 1.5, kLowestM = -0.5;  ///< beyond these no robot is

void add_mesh_asset(mjSpec* spec, const std::string& name, const std::vector<float>& vertices,
                    const std::vector<int>& faces) {
  mjsMesh* mesh = mjs_addMesh(spec, nullptr);
  mjs_setName(mesh->element, name.c_str());
  std::fill_n(mesh->scale, 3, 1.0);      // not that of the scene's default class
  mesh->inertia = mjMESH_INERTIA_SHELL;  // the other kinds refuse meshes that are open or thin
  mjs_setFloat(mesh->uservert, vertices.data(), static_cast<int>(vertices.size()));
  mjs_setInt(mesh->userface, faces.data(), static_cast<int>(faces.size()));
}

}  // namespace

std::vector<Triangle> triangles_of(const mjModel& model, int mesh) {
  const float* vertices = model.mesh_vert + 3 * model.mesh_vertadr[mesh];
  const int* faces = model.mesh_face + 3 * model.mesh_faceadr[mesh];
  std::vector<Triangle> triangles(model.mesh_facenum[mesh]);
  for (std::size_t i = 0; i < triangles.size(); ++i) {
    for (int corner = 0; corner < 3; ++corner) {
      const float* v = vertices + 3 * faces[3 * i + corner];
      triangles[i][corner] = Eigen::Vector3d(v[0], v[1], v[2]);
    }
  }
  return triangles;
}

bool is_room(const std::vector<Triangle>& triangles, const Pose& T_world_mesh) {
  if (triangles.size() > kMostSlabs) return false;
  Eigen::AlignedBox3d bounds;
  for (const Triangle& triangle : triangles)
    for (const Eigen::Vector3d& corner : triangle) bounds.extend(T_world_mesh * corner);
  return bounds.sizes().x() > kRoomM && bounds.sizes().y() > kRoomM;
}

void add_hull(mjSpec* spec, const std::string& name, const mjModel& model, int mesh) {
  const float* vertices = model.mesh_vert + 3 * model.mesh_vertadr[mesh];
  const int* faces = model.mesh_face + 3 * model.mesh_faceadr[mesh];
  add_mesh_asset(spec, name, {vertices, vertices + 3 * model.mesh_vertnum[mesh]},
                 {faces, faces + 3 * model.mesh_facenum[mesh]});
}

bool add_slab(mjSpec* spec, const std::string& name, const Triangle& triangle,
              const Pose& T_world_mesh) {
  const Eigen::Vector3d across = (triangle[1] - triangle[0]).cross(triangle[2] - triangle[0]);
  if (across.norm() < 2.0 * kLeastAreaM2) return false;
  Eigen::AlignedBox3d bounds;
  for (const Eigen::Vector3d& corner : triangle) bounds.extend(T_world_mesh * corner);
  if (bounds.min().z() > kHighestM || bounds.max().z() < kLowestM) return false;
  const Eigen::Vector3d back = -kSlabM * across.normalized();
  std::vector<float> vertices;
  for (const Eigen::Vector3d& shift : {Eigen::Vector3d(0, 0, 0), back})
    for (const Eigen::Vector3d& corner : triangle)
      for (int axis = 0; axis < 3; ++axis)
        vertices.push_back(static_cast<float>(corner[axis] + shift[axis]));
  add_mesh_asset(spec, name, vertices,
                 {0, 1, 2, 5, 4, 3, 0, 3, 4, 0, 4, 1, 1, 4, 5, 1, 5, 2, 2, 5, 3, 2, 3, 0});
  return true;
}

}  // namespace mapscore::sim
