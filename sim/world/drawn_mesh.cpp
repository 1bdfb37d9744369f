// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#include "sim/world/drawn_mesh.hpp"

#include <Eigen/Geometry>
#include <algorithm>

namespace mapscore::sim {
namespace {

std::vector<float> flattened(const std::vector<Eigen::Vector3d>& points) {
  std::vector<float> values;
  values.reserve(3 * points.size());
  for (const Eigen::Vector3d& p : points) {
    for (int axis = 0; axis < 3; ++axis) values.push_back(static_cast<float>(p[axis]));
  }
  return values;
}

}  // namespace

void add_mesh(mjSpec* spec, const std::string& name, const Facets& facets) {
  mjsMesh* mesh = mjs_addMesh(spec, nullptr);
  mjs_setName(mesh->element, name.c_str());
  std::fill_n(mesh->scale, 3, 1.0);      // not that of the scene's default class
  mesh->inertia = mjMESH_INERTIA_SHELL;  // thin shapes have next to no volume
  const std::vector<float> vertices = flattened(facets.vertices),
                           normals = flattened(facets.normals);
  std::vector<int> faces;
  for (const auto& face : facets.faces) faces.insert(faces.end(), face.begin(), face.end());
  mjs_setFloat(mesh->uservert, vertices.data(), static_cast<int>(vertices.size()));
  mjs_setFloat(mesh->usernormal, normals.data(), static_cast<int>(normals.size()));
  mjs_setInt(mesh->userface, faces.data(), static_cast<int>(faces.size()));
  mjs_setInt(mesh->userfacenormal, faces.data(), static_cast<int>(faces.size()));
}

Facets flat_facets(const std::vector<Triangle>& triangles) {
  Facets facets;
  for (const Triangle& triangle : triangles) {
    const Eigen::Vector3d across = (triangle[1] - triangle[0]).cross(triangle[2] - triangle[0]);
    if (!(across.norm() > 0)) continue;
    const int first = static_cast<int>(facets.vertices.size());
    for (const Eigen::Vector3d& corner : triangle) {
      facets.vertices.push_back(corner);
      facets.normals.push_back(across.normalized());
    }
    facets.faces.push_back({first, first + 1, first + 2});
  }
  return facets;
}

// The compiler moves a mesh to its centre of mass and main axes: v_asset = mesh_pos + R(mesh_quat)
// v.
void draw_mesh(const mjModel& model, int mesh, const Pose& T_world_shape, mjvGeom& geom) {
  mjtNum rotation[9];
  mju_quat2Mat(rotation, model.mesh_quat + 4 * mesh);
  Eigen::Matrix<float, 3, 3, Eigen::RowMajor> R_shape_mesh;
  for (int i = 0; i < 9; ++i) R_shape_mesh(i / 3, i % 3) = static_cast<float>(rotation[i]);
  const mjtNum* shift = model.mesh_pos + 3 * mesh;
  Eigen::Map<Eigen::Matrix<float, 3, 3, Eigen::RowMajor>> mat(geom.mat);
  mat = (T_world_shape.linear() * R_shape_mesh.cast<double>()).cast<float>();
  Eigen::Map<Eigen::Vector3f>(geom.pos) =
      (T_world_shape * Eigen::Vector3d(shift[0], shift[1], shift[2])).cast<float>();
  geom.type = mjGEOM_MESH;
  geom.dataid = 2 * mesh;  // odd numbers are convex hulls
  geom.texcoord = 0;
}

}  // namespace mapscore::sim
