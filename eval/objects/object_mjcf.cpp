// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#include "eval/objects/object_mjcf.hpp"

#include "core/error.hpp"
#include "eval/recording/pose_text.hpp"
#include "files/text.hpp"

#include <fmt/format.h>

#include <filesystem>

namespace mapscore::eval {
namespace {

const SemanticClass& class_of(const MapObject& object, const ClassTable& table) {
  if (object.class_id == kBackground || object.class_id >= table.classes.size())
    throw Error(fmt::format("object {}: class {} is not in the table; remove the object", object.id,
                            object.class_id));
  return table.classes[object.class_id];
}

enum class ModelKind { box, mesh, body };

ModelKind kind_of(const MapObject& object) {
  if (object.model.empty()) return ModelKind::box;
  const std::string ending = std::filesystem::path(object.model).extension().string();
  if (ending == ".obj" || ending == ".stl" || ending == ".msh") return ModelKind::mesh;
  if (ending == ".xml") return ModelKind::body;
  throw Error(
      fmt::format("object {}: model '{}'; give a mesh (.obj, .stl, .msh) or an MJCF (.xml), "
                  "or none for its box",
                  object.id, shown(object.model)));
}

std::string asset_of(const MapObject& object) {
  const std::string file = xml_quoted(object.model);
  switch (kind_of(object)) {
    case ModelKind::mesh:
      return fmt::format("    <mesh name=\"model_{}\" file={}/>\n", object.id, file);
    case ModelKind::body:
      return fmt::format("    <model name=\"model_{}\" file={}/>\n", object.id, file);
    case ModelKind::box:
      break;
  }
  return {};
}

std::string geom_of(const MapObject& object, const Colour& colour, double least_size_m) {
  const ModelKind kind = kind_of(object);
  if (kind == ModelKind::body)
    return fmt::format("<attach model=\"model_{0}\" prefix=\"object_{0}/\"/>", object.id);
  const std::string rgba =
      fmt::format("{:.4g} {:.4g} {:.4g} 1", colour.r / 255.0, colour.g / 255.0, colour.b / 255.0);
  if (kind == ModelKind::mesh)
    return fmt::format("<geom type=\"mesh\" mesh=\"model_{}\" rgba=\"{}\"/>", object.id, rgba);
  const Eigen::Vector3d half = 0.5 * object.box.size_m.cwiseMax(least_size_m);
  return fmt::format("<geom type=\"box\" size=\"{} {} {}\" rgba=\"{}\"/>", half.x(), half.y(),
                     half.z(), rgba);
}

}  // namespace

std::string object_mjcf(const ObjectFile& file, const ClassTable& table, double least_size_m) {
  const Pose T_world_map = file.T_world_map();
  std::string assets, bodies;
  for (const MapObject& object : file.objects) {
    const SemanticClass& c = class_of(object, table);
    const PoseNumbers pose = numbers_of(T_world_map * object.box.T_frame_box);
    assets += asset_of(object);
    bodies += fmt::format(
        "    <body name={} pos=\"{} {} {}\" quat=\"{} {} {} {}\">\n      {}\n    </body>\n",
        xml_quoted(fmt::format("{}_{}", c.name, object.id)), pose[0], pose[1], pose[2], pose[6],
        pose[3], pose[4], pose[5], geom_of(object, c.colour, least_size_m));
  }
  if (!assets.empty()) assets = "  <asset>\n" + assets + "  </asset>\n";
  return "<mujoco model=\"objects\">\n" + assets + "  <worldbody>\n" + bodies +
         "  </worldbody>\n</mujoco>\n";
}

std::string object_ply(const std::vector<MapObject>& objects, const ClassTable& table) {
  // Two triangles a face, counter-clockwise from outside; bit n of a corner: its side on axis n.
  static constexpr int kTriangles[12][3] = {{0, 4, 6}, {0, 6, 2}, {1, 3, 7}, {1, 7, 5},
                                            {0, 1, 5}, {0, 5, 4}, {2, 6, 7}, {2, 7, 3},
                                            {0, 2, 3}, {0, 3, 1}, {4, 5, 7}, {4, 7, 6}};
  std::string text = fmt::format(
      "ply\nformat ascii 1.0\nelement vertex {}\nproperty float x\nproperty float y\n"
      "property float z\nproperty uchar red\nproperty uchar green\nproperty uchar blue\n"
      "property uint object\nelement face {}\nproperty list uchar int vertex_indices\nend_header\n",
      8 * objects.size(), 12 * objects.size());
  for (const MapObject& object : objects) {
    const Colour colour = class_of(object, table).colour;
    for (const Eigen::Vector3d& p : object.box.corners())
      text += fmt::format("{:.6g} {:.6g} {:.6g} {} {} {} {}\n", p.x(), p.y(), p.z(), colour.r,
                          colour.g, colour.b, object.id);
  }
  for (std::size_t n = 0; n < objects.size(); ++n)
    for (const auto& triangle : kTriangles)
      text += fmt::format("3 {} {} {}\n", 8 * n + static_cast<std::size_t>(triangle[0]),
                          8 * n + static_cast<std::size_t>(triangle[1]),
                          8 * n + static_cast<std::size_t>(triangle[2]));
  return text;
}

}  // namespace mapscore::eval
