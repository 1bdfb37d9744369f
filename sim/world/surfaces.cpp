// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#include "sim/world/surfaces.hpp"

#include "core/error.hpp"
#include "sim/world/mujoco_session.hpp"

#include <fmt/format.h>

#include <cstdint>
#include <utility>

namespace mapscore::sim {
namespace {

/// The surface of a height field, in its geom's frame. A cell is cut along the diagonal from (row,
/// column) to (row + 1, column + 1), as MuJoCo draws it.
std::vector<Triangle> height_field_triangles(const mjModel& model, int id) {
  const mjtNum* size = model.hfield_size + 4 * id;  // half x, half y, elevation, base
  const float* elevation = model.hfield_data + model.hfield_adr[id];
  const int rows = model.hfield_nrow[id], columns = model.hfield_ncol[id];
  std::vector<Triangle> triangles;
  const auto top = [&](int row, int column) -> Eigen::Vector3d {
    return {size[0] * (2.0 * column / (columns - 1) - 1.0),
            size[1] * (2.0 * row / (rows - 1) - 1.0),
            size[2] * static_cast<double>(elevation[row * columns + column])};
  };
  const auto below = [&](const Eigen::Vector3d& p) -> Eigen::Vector3d {
    return {p.x(), p.y(), -size[3]};
  };
  const auto add_quad = [&](const Eigen::Vector3d& a, const Eigen::Vector3d& b,
                            const Eigen::Vector3d& c, const Eigen::Vector3d& d) {
    triangles.push_back({a, b, c});
    triangles.push_back({a, c, d});
  };
  const auto add_side = [&](const Eigen::Vector3d& a, const Eigen::Vector3d& b) {
    add_quad(below(a), below(b), b, a);
  };
  for (int r = 0; r + 1 < rows; ++r)
    for (int c = 0; c + 1 < columns; ++c)
      add_quad(top(r, c), top(r, c + 1), top(r + 1, c + 1), top(r + 1, c));
  for (int c = 0; c + 1 < columns; ++c) {
    add_side(top(0, c), top(0, c + 1));
    add_side(top(rows - 1, c + 1), top(rows - 1, c));
  }
  for (int r = 0; r + 1 < rows; ++r) {
    add_side(top(r + 1, 0), top(r, 0));
    add_side(top(r, columns - 1), top(r + 1, columns - 1));
  }
  add_quad(below(top(0, 0)), below(top(rows - 1, 0)), below(top(rows - 1, columns - 1)),
           below(top(0, columns - 1)));
  return triangles;
}

ShapeKind kind_of(const mjModel& model, int geom, const std::string& scene_file) {
  static constexpr std::pair<int, ShapeKind> kKinds[] = {
      {mjGEOM_PLANE, ShapeKind::plane},       {mjGEOM_SPHERE, ShapeKind::sphere},
      {mjGEOM_CAPSULE, ShapeKind::capsule},   {mjGEOM_ELLIPSOID, ShapeKind::ellipsoid},
      {mjGEOM_CYLINDER, ShapeKind::cylinder}, {mjGEOM_BOX, ShapeKind::box},
      {mjGEOM_HFIELD, ShapeKind::mesh},       {mjGEOM_MESH, ShapeKind::mesh},
      {mjGEOM_SDF, ShapeKind::mesh}};
  for (const auto& [type, kind] : kKinds)
    if (type == model.geom_type[geom]) return kind;
  throw Error(
      fmt::format("{}: geom {}: MuJoCo's geom type {} has no exact surface here; use a "
                  "primitive, a mesh or a height field, or move it to group 3",
                  scene_file, geom, model.geom_type[geom]));
}

/// 72 bytes each.
constexpr std::int64_t kMostTriangles = 20'000'000;

std::int64_t triangle_count(const mjModel& model, int geom) {
  const int asset = model.geom_dataid[geom], type = model.geom_type[geom];
  if (asset < 0) return 0;
  if (type == mjGEOM_HFIELD)
    return std::int64_t{2} * model.hfield_nrow[asset] * model.hfield_ncol[asset];
  return type == mjGEOM_MESH || type == mjGEOM_SDF ? model.mesh_facenum[asset] : 0;
}

}  // namespace

std::vector<Triangle> mesh_triangles(const mjModel& model, int mesh) {
  const float* vertices = model.mesh_vert + 3 * model.mesh_vertadr[mesh];
  const int* faces = model.mesh_face + 3 * model.mesh_faceadr[mesh];
  const auto vertex = [&](int i) {
    return Eigen::Map<const Eigen::Vector3f>(vertices + 3 * i).cast<double>().eval();
  };
  std::vector<Triangle> triangles(model.mesh_facenum[mesh]);
  for (std::size_t f = 0; f < triangles.size(); ++f) {
    const int* face = faces + 3 * f;
    triangles[f] = {vertex(face[0]), vertex(face[1]), vertex(face[2])};
  }
  return triangles;
}

void refuse_countless_triangles(const mjModel& model, const DrawnScene& drawn,
                                const std::string& scene_file) {
  std::int64_t count = 0;
  for (const mjvGeom& geom : drawn.geoms) count += triangle_count(model, geom.objid);
  if (count > kMostTriangles)
    throw Error(
        fmt::format("{}: its meshes and height fields have {} triangles, {} can be kept; "
                    "take coarser ones, or move some to group 3",
                    scene_file, count, kMostTriangles));
}

Shape surface_of(const mjModel& model, const mjData& data, int geom,
                 const std::string& scene_file) {
  Shape shape;
  shape.kind = kind_of(model, geom, scene_file);
  shape.name = element_name(model, mjOBJ_GEOM, geom);
  shape.T_world_shape = geom_pose(data, geom);
  if (shape.kind != ShapeKind::mesh) {
    const mjtNum* size = model.geom_size + 3 * geom;
    shape.size = {size[0], size[1], shape.kind == ShapeKind::plane ? 0.0 : size[2]};
  } else if (model.geom_type[geom] == mjGEOM_HFIELD) {
    shape.triangles = height_field_triangles(model, model.geom_dataid[geom]);
  } else if (model.geom_dataid[geom] >= 0) {
    shape.triangles = mesh_triangles(model, model.geom_dataid[geom]);
  }
  return shape;
}

}  // namespace mapscore::sim
