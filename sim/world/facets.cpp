// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#include "sim/world/facets.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

namespace mapscore::sim {
namespace {

/// A ring of a surface of revolution about z: radius, height, and the normal's two parts.
struct Ring {
  double radius, z, normal_radial, normal_z;
};

/// Facets around that keep a circle of `radius` within `tolerance`, a multiple of 4.
int slices_for(double radius, double tolerance) {
  const double step = 2.0 * std::acos(std::max(0.0, 1.0 - tolerance / radius));
  const int slices = static_cast<int>(std::ceil(2.0 * M_PI / step));
  return std::clamp((slices + 3) / 4 * 4, 12, 256);
}

/// Joins neighbouring rings by quadrilaterals; rings run from low to high z (the direction in which
/// the outside lies to the right). Rings of radius 0 become points.
Facets revolve(const std::vector<Ring>& rings, int slices) {
  Facets facets;
  for (const Ring& ring : rings) {
    for (int s = 0; s < slices; ++s) {
      const double angle = 2.0 * M_PI * s / slices;
      const double c = std::cos(angle), n = std::sin(angle);
      facets.vertices.emplace_back(ring.radius * c, ring.radius * n, ring.z);
      facets.normals.emplace_back(ring.normal_radial * c, ring.normal_radial * n, ring.normal_z);
    }
  }
  for (std::size_t r = 0; r + 1 < rings.size(); ++r) {
    const bool crease = rings[r].radius == rings[r + 1].radius && rings[r].z == rings[r + 1].z;
    if (crease) continue;  // same place, other normal
    for (int s = 0; s < slices; ++s) {
      const int base = static_cast<int>(r) * slices;
      const int a = base + s, b = base + (s + 1) % slices, c = a + slices, d = b + slices;
      if (rings[r].radius > 0) facets.faces.push_back({a, b, d});
      if (rings[r + 1].radius > 0) facets.faces.push_back({a, d, c});
    }
  }
  return facets;
}

/// Rings of a sphere's arc from latitude `from` to `to` in `steps` steps, its centre at height z0.
void append_arc(std::vector<Ring>& rings, double radius, double z0, double from, double to,
                int steps) {
  for (int i = 0; i <= steps; ++i) {
    const double latitude = from + (to - from) * i / steps;
    const bool pole = std::abs(std::abs(latitude) - M_PI_2) < 1e-9;
    const double c = pole ? 0.0 : std::cos(latitude), s = std::sin(latitude);
    rings.push_back({radius * c, z0 + radius * s, c, s});
  }
}

/// Inner rings of a cylinder's side, at most 0.4 m apart: light is computed at the vertices.
void append_side(std::vector<Ring>& rings, double radius, double half_length) {
  const int pieces = std::clamp(static_cast<int>(std::ceil(half_length / 0.2)), 1, 32);
  for (int i = 0; i <= pieces; ++i)
    rings.push_back({radius, half_length * (2.0 * i / pieces - 1.0), 1.0, 0.0});
}

Facets ellipsoid(const Eigen::Vector3d& half_axes, double tolerance) {
  const int slices = slices_for(half_axes.maxCoeff(), 0.5 * tolerance);
  std::vector<Ring> rings;
  append_arc(rings, 1.0, 0.0, -M_PI_2, M_PI_2, slices / 2);
  Facets facets = revolve(rings, slices);
  for (Eigen::Vector3d& v : facets.vertices) v = v.cwiseProduct(half_axes);
  for (Eigen::Vector3d& n : facets.normals) n = n.cwiseQuotient(half_axes).normalized();
  return facets;
}

Facets capsule(double radius, double half_length, double tolerance) {
  const int slices = slices_for(radius, 0.5 * tolerance);
  std::vector<Ring> rings;
  append_arc(rings, radius, -half_length, -M_PI_2, 0.0, slices / 4);
  append_side(rings, radius, half_length);
  append_arc(rings, radius, half_length, 0.0, M_PI_2, slices / 4);
  return revolve(rings, slices);
}

Facets cylinder(double radius, double half_length, double tolerance) {
  std::vector<Ring> rings{{0.0, -half_length, 0.0, -1.0}, {radius, -half_length, 0.0, -1.0}};
  append_side(rings, radius, half_length);
  rings.push_back({radius, half_length, 0.0, 1.0});
  rings.push_back({0.0, half_length, 0.0, 1.0});
  return revolve(rings, slices_for(radius, tolerance));
}

std::vector<float> flattened(const std::vector<Eigen::Vector3d>& points) {
  std::vector<float> values;
  values.reserve(3 * points.size());
  for (const Eigen::Vector3d& p : points)
    for (const double coordinate : p) values.push_back(static_cast<float>(coordinate));
  return values;
}

}  // namespace

bool is_round(ShapeKind kind) {
  return kind == ShapeKind::sphere || kind == ShapeKind::ellipsoid || kind == ShapeKind::capsule ||
         kind == ShapeKind::cylinder;
}

Facets facets_of(ShapeKind kind, const Eigen::Vector3d& size, double tolerance_m) {
  if (kind == ShapeKind::sphere) return ellipsoid(Eigen::Vector3d::Constant(size.x()), tolerance_m);
  if (kind == ShapeKind::ellipsoid) return ellipsoid(size, tolerance_m);
  if (kind == ShapeKind::capsule) return capsule(size.x(), size.y(), tolerance_m);
  if (kind == ShapeKind::cylinder) return cylinder(size.x(), size.y(), tolerance_m);
  return {};
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

mjsMesh* add_mesh(mjSpec* spec, const std::string& name, const std::vector<float>& vertices,
                  const std::vector<int>& faces) {
  mjsMesh* mesh = mjs_addMesh(spec, nullptr);
  mjs_setName(mesh->element, name.c_str());
  std::fill_n(mesh->scale, 3, 1.0);      // not that of the scene's default class
  mesh->inertia = mjMESH_INERTIA_SHELL;  // the other kinds refuse meshes that are open or thin
  mjs_setFloat(mesh->uservert, vertices.data(), static_cast<int>(vertices.size()));
  mjs_setInt(mesh->userface, faces.data(), static_cast<int>(faces.size()));
  return mesh;
}

void add_mesh(mjSpec* spec, const std::string& name, const Facets& facets) {
  std::vector<int> faces;
  for (const auto& face : facets.faces) faces.insert(faces.end(), face.begin(), face.end());
  mjsMesh* mesh = add_mesh(spec, name, flattened(facets.vertices), faces);
  const std::vector<float> normals = flattened(facets.normals);
  mjs_setFloat(mesh->usernormal, normals.data(), static_cast<int>(normals.size()));
  mjs_setInt(mesh->userfacenormal, faces.data(), static_cast<int>(faces.size()));
}

mjvGeom box_geom(const Eigen::Vector3d& half_m, const Eigen::Vector3d& centre_world,
                 const Eigen::Matrix3d& R_world_box) {
  const Eigen::Matrix<mjtNum, 3, 3, Eigen::RowMajor> rotation = R_world_box;
  mjvGeom geom;
  mjv_initGeom(&geom, mjGEOM_BOX, half_m.data(), centre_world.data(), rotation.data(), nullptr);
  return geom;
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
