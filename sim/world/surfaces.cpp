// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#include "sim/world/surfaces.hpp"

#include "core/error.hpp"
#include "sim/world/mujoco_pose.hpp"

#include <fmt/format.h>

#include <cstdint>

namespace mapscore::sim {
namespace {

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

/// The surface of one height field, in its geom's frame.
class HeightField {
 public:
  HeightField(const mjModel& model, int id)
      : size_(model.hfield_size + 4 * id),
        elevation_(model.hfield_data + model.hfield_adr[id]),
        rows_(model.hfield_nrow[id]),
        columns_(model.hfield_ncol[id]) {}

  std::vector<Triangle> triangles() const {
    std::vector<Triangle> result;
    append_top(result);
    for (int c = 0; c + 1 < columns_; ++c) {
      append_side(result, top(0, c), top(0, c + 1));
      append_side(result, top(rows_ - 1, c + 1), top(rows_ - 1, c));
    }
    for (int r = 0; r + 1 < rows_; ++r) {
      append_side(result, top(r + 1, 0), top(r, 0));
      append_side(result, top(r, columns_ - 1), top(r + 1, columns_ - 1));
    }
    append_quad(result, below(top(0, 0)), below(top(rows_ - 1, 0)),
                below(top(rows_ - 1, columns_ - 1)), below(top(0, columns_ - 1)));
    return result;
  }

 private:
  Eigen::Vector3d top(int row, int column) const {
    return {size_[0] * (2.0 * column / (columns_ - 1) - 1.0),
            size_[1] * (2.0 * row / (rows_ - 1) - 1.0),
            size_[2] * static_cast<double>(elevation_[row * columns_ + column])};
  }
  Eigen::Vector3d below(const Eigen::Vector3d& p) const { return {p.x(), p.y(), -size_[3]}; }

  /// A cell is cut along the diagonal from (row, column) to (row + 1, column + 1), as MuJoCo draws
  /// it.
  void append_top(std::vector<Triangle>& result) const {
    for (int r = 0; r + 1 < rows_; ++r) {
      for (int c = 0; c + 1 < columns_; ++c) {
        append_quad(result, top(r, c), top(r, c + 1), top(r + 1, c + 1), top(r + 1, c));
      }
    }
  }
  void append_side(std::vector<Triangle>& result, const Eigen::Vector3d& a,
                   const Eigen::Vector3d& b) const {
    append_quad(result, below(a), below(b), b, a);
  }
  static void append_quad(std::vector<Triangle>& result, const Eigen::Vector3d& a,
                          const Eigen::Vector3d& b, const Eigen::Vector3d& c,
                          const Eigen::Vector3d& d) {
    result.push_back({a, b, c});
    result.push_back({a, c, d});
  }

  const mjtNum* size_;  ///< half x, half y, elevation, base
  const float* elevation_;
  int rows_, columns_;
};

ShapeKind kind_of(const mjModel& model, int geom, const std::string& scene_file) {
  switch (model.geom_type[geom]) {
    case mjGEOM_PLANE:
      return ShapeKind::plane;
    case mjGEOM_SPHERE:
      return ShapeKind::sphere;
    case mjGEOM_CAPSULE:
      return ShapeKind::capsule;
    case mjGEOM_ELLIPSOID:
      return ShapeKind::ellipsoid;
    case mjGEOM_CYLINDER:
      return ShapeKind::cylinder;
    case mjGEOM_BOX:
      return ShapeKind::box;
    case mjGEOM_HFIELD:
    case mjGEOM_MESH:
    case mjGEOM_SDF:
      return ShapeKind::mesh;
    default:
      break;
  }
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
  if (const char* name = mj_id2name(&model, mjOBJ_GEOM, geom)) shape.name = name;
  shape.T_world_shape = geom_pose(data, geom);
  if (shape.kind != ShapeKind::mesh) {
    const mjtNum* size = model.geom_size + 3 * geom;
    shape.size = {size[0], size[1], shape.kind == ShapeKind::plane ? 0.0 : size[2]};
  } else if (model.geom_type[geom] == mjGEOM_HFIELD) {
    shape.triangles = HeightField(model, model.geom_dataid[geom]).triangles();
  } else if (model.geom_dataid[geom] >= 0) {
    shape.triangles = mesh_triangles(model, model.geom_dataid[geom]);
  }
  return shape;
}

}  // namespace mapscore::sim
