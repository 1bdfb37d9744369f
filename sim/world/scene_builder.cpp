// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#include "sim/world/scene_builder.hpp"

#include "core/error.hpp"
#include "sim/world/facets.hpp"
#include "sim/world/robot_cameras.hpp"

#include <fmt/format.h>

#include <array>
#include <set>

namespace mapscore::sim {
namespace {

[[noreturn]] void refuse(const std::filesystem::path& file, const char* reason) {
  throw Error(fmt::format("{}: MuJoCo refuses it: {}; mend the MJCF there", file.string(),
                          one_line(reason)));
}

SpecPtr parse(const std::filesystem::path& file, const char* what) {
  if (!std::filesystem::is_regular_file(file)) {
    throw Error(fmt::format("{}: no such {} file; check the path", file.string(), what));
  }
  std::array<char, 1024> reason{};
  SpecPtr spec(mj_parseXML(file.c_str(), nullptr, reason.data(), static_cast<int>(reason.size())));
  if (!spec) refuse(file, reason.data());
  spec->compiler.fusestatic = 0;  // bodies are objects here, and the robot hangs on one
  return spec;
}

/// Meshes are named by what they look like, to the last bit.
std::string facets_name(const Shape& shape) {
  return fmt::format("mapscore/{}/{:a}/{:a}/{:a}", name_of(shape.kind), shape.size.x(),
                     shape.size.y(), shape.size.z());
}

std::vector<float> flattened(const std::vector<Eigen::Vector3d>& points) {
  std::vector<float> values;
  values.reserve(3 * points.size());
  for (const Eigen::Vector3d& p : points) {
    for (int axis = 0; axis < 3; ++axis) values.push_back(static_cast<float>(p[axis]));
  }
  return values;
}

void add_mesh(mjSpec* spec, const std::string& name, const Facets& facets) {
  mjsMesh* mesh = mjs_addMesh(spec, nullptr);
  mjs_setName(mesh->element, name.c_str());
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

/// The compiler moves a mesh to its centre of mass and main axes: v_asset = mesh_pos + R(mesh_quat)
/// v.
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

}  // namespace

SceneBuilder::SceneBuilder(const std::filesystem::path& scene, const std::filesystem::path& robot)
    : scene_(scene),
      robot_(robot),
      spec_(parse(scene, "scene")),
      robot_spec_(parse(robot, "robot")) {
  mjsBody* base = mjs_findBody(robot_spec_.get(), "base_footprint");
  if (!base) {
    throw Error(
        fmt::format("{}: no body `base_footprint`; name the robot's root so", robot.string()));
  }
  mjsFrame* frame = mjs_addFrame(mjs_findBody(spec_.get(), "world"), nullptr);
  if (!mjs_attach(frame->element, base->element, kRobotPrefix, "")) {
    throw Error(fmt::format("{}: cannot be attached to {}: {}", robot.string(), scene.string(),
                            one_line(mjs_getError(spec_.get()))));
  }
}

ModelPtr SceneBuilder::compile() {
  ModelPtr model(mj_compile(spec_.get(), nullptr));
  if (!model) refuse(scene_, mjs_getError(spec_.get()));
  return model;
}

void SceneBuilder::add_facets(const std::vector<Shape>& shapes) {
  std::set<std::string> names;
  for (const Shape& shape : shapes) {
    const std::string name = facets_name(shape);
    if (!is_round(shape.kind) || !names.insert(name).second) continue;
    add_mesh(spec_.get(), name, facets_of(shape.kind, shape.size, kFacetToleranceM));
  }
}

void draw_by_facets(const mjModel& model, const std::vector<Shape>& shapes, DrawnScene& drawn) {
  for (std::size_t i = 0; i < shapes.size(); ++i) {
    if (!is_round(shapes[i].kind)) continue;
    const int mesh = mj_name2id(&model, mjOBJ_MESH, facets_name(shapes[i]).c_str());
    if (mesh >= 0) draw_mesh(model, mesh, shapes[i].T_world_shape, drawn.geoms[i]);
  }
}

}  // namespace mapscore::sim
