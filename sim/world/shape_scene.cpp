// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#include "sim/world/shape_scene.hpp"

#include "core/error.hpp"
#include "sim/world/facets.hpp"

#include <fmt/format.h>

#include <map>
#include <optional>
#include <string>
#include <utility>

namespace mapscore::sim {
namespace {

std::vector<Triangle> rectangle(double half_x, double half_y) {
  const Eigen::Vector3d a(-half_x, -half_y, 0), b(half_x, -half_y, 0), c(half_x, half_y, 0),
      d(-half_x, half_y, 0);
  return {{a, b, c}, {a, c, d}};
}

/// What stands for a shape where it is not drawn by a primitive of the renderer.
Facets drawn_facets(const Shape& shape) {
  if (is_round(shape.kind)) return facets_of(shape.kind, shape.size, kFacetToleranceM);
  Facets facets = flat_facets(
      shape.kind == ShapeKind::plane ? rectangle(shape.size.x(), shape.size.y()) : shape.triangles);
  if (facets.vertices.size() == 3) {  // MuJoCo wants four
    facets.vertices.push_back(facets.vertices.front());
    facets.normals.push_back(facets.normals.front());
  }
  return facets;
}

/// Shapes of one form share a mesh.
std::string form_of(const Shape& shape, std::size_t index) {
  if (shape.kind == ShapeKind::mesh) return fmt::format("mesh {}", index);
  return fmt::format("{} {:a} {:a} {:a}", name_of(shape.kind), shape.size.x(), shape.size.y(),
                     shape.size.z());
}

/// The meshes that shapes are drawn by, added to a model as they are asked for.
class Meshes {
 public:
  Meshes() : spec_(mj_makeSpec()) {}

  /// Number of the mesh for a shape; none where it has no area.
  std::optional<int> add(const Shape& shape, std::size_t index) {
    const std::string form = form_of(shape, index);
    if (const auto known = numbers_.find(form); known != numbers_.end()) return known->second;
    const Facets facets = drawn_facets(shape);
    if (facets.faces.empty()) return std::nullopt;
    const int number = static_cast<int>(numbers_.size());
    add_mesh(spec_.get(), std::to_string(number), facets);
    numbers_.emplace(form, number);
    return number;
  }

  ModelPtr compile() {
    ModelPtr model(mj_compile(spec_.get(), nullptr));
    if (!model)
      throw Error(
          fmt::format("shapes: MuJoCo refuses a mesh of them: {}; mend the recording's "
                      "truth/",
                      one_line(mjs_getError(spec_.get()))));
    return model;
  }

 private:
  SpecPtr spec_;
  std::map<std::string, int> numbers_;
};

/// In half grey, half the colour of the class.
mjvGeom geom_of(const Shape& shape, const ClassTable& table) {
  constexpr float kGrey = 0.75f;
  mjvGeom geom =
      box_geom(shape.size, shape.T_world_shape.translation(), shape.T_world_shape.linear());
  const ClassId id = table.class_of(shape.instance);
  const Colour& colour = table.classes.at(id).colour;
  const std::uint8_t bytes[3] = {colour.r, colour.g, colour.b};
  for (int channel = 0; channel < 3; ++channel)
    geom.rgba[channel] = id == kBackground
                             ? kGrey
                             : 0.5f * kGrey + 0.5f * static_cast<float>(bytes[channel]) / 255.0f;
  geom.rgba[3] = 1.0f;
  geom.segid = shape.instance;
  return geom;
}

}  // namespace

ShapeScene scene_of_shapes(std::vector<Shape> shapes, const ClassTable& table) {
  ShapeScene scene;
  Meshes meshes;
  std::vector<std::optional<int>> drawn_by;
  for (Shape& shape : shapes) {
    const bool box = shape.kind == ShapeKind::box;
    const std::optional<int> mesh = box ? std::nullopt : meshes.add(shape, scene.shapes.size());
    if (!box && !mesh) continue;
    scene.drawn.geoms.push_back(geom_of(shape, table));
    scene.drawn.geoms.back().objid = static_cast<int>(scene.shapes.size());
    drawn_by.push_back(mesh);
    scene.shapes.push_back(std::move(shape));
  }
  scene.model = meshes.compile();
  for (std::size_t i = 0; i < drawn_by.size(); ++i) {
    if (!drawn_by[i]) continue;
    const int mesh =
        mj_name2id(scene.model.get(), mjOBJ_MESH, std::to_string(*drawn_by[i]).c_str());
    draw_mesh(*scene.model, mesh, scene.shapes[i].T_world_shape, scene.drawn.geoms[i]);
  }
  return scene;
}

}  // namespace mapscore::sim
